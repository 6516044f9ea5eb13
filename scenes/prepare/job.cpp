#include "scenes/prepare/job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "rules/growth/random_tree.h"
#include "scenes/import/mesh_import.h"
#include "scenes/lights.h"
#include "scenes/prepare/unknown_regions.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/random.h"

namespace espalier::scenes {
namespace {

std::vector<sim::TiledMesh> readMeshes(const Scene& scene) {
  for (const SceneMesh& spec : scene.meshes) {
    if (spec.optional && !std::filesystem::exists(spec.file)) {
      throw MeshMissing(fmt::format("{}: the mesh {} is not there", scene.file.string(), spec.file.string()));
    }
  }
  std::vector<sim::TiledMesh> meshes;
  for (const SceneMesh& spec : scene.meshes) {
    sim::Mesh mesh =
        placeMesh(importMesh(spec.file, spec.regions_from), spec.scale, spec.rotate_deg, spec.translate_m);
    mesh.name = spec.name;
    if (spec.colour) {
      for (sim::Material& material : mesh.materials) material.colour = *spec.colour;
    }
    meshes.push_back({std::move(mesh), spec.solid});
  }
  return meshes;
}

/// The voxel size that gives the longest side of the bounds this many voxels.
double voxelFor(int resolution, const WorldSpec& spec, const std::vector<sim::TiledMesh>& meshes) {
  sim::Vec3 extent(0.0);
  if (spec.bounds_m) {
    extent = (*spec.bounds_m)[1] - (*spec.bounds_m)[0];
  } else {
    sim::Vec3 low(INFINITY), high(-INFINITY);
    for (const auto& tiled : meshes) {
      for (const sim::Vec3& v : tiled.mesh.vertices_m) {
        low = glm::min(low, v);
        high = glm::max(high, v);
      }
    }
    extent = high - low + 2.0 * spec.margin_m;
  }
  return std::max({extent.x, extent.y, extent.z}) / resolution;
}

sim::Frame frameFor(const Scene& scene, const std::vector<sim::TiledMesh>& meshes) {
  const WorldSpec& spec = scene.world;
  const double voxel_m = spec.voxel_m ? *spec.voxel_m : voxelFor(spec.resolution.value_or(160), spec, meshes);
  if (!spec.bounds_m) return sim::frameAround(meshes, voxel_m, spec.margin_m);
  const auto& [low, high] = *spec.bounds_m;
  // A thousandth of a voxel too much is a rounding of the file's decimals, not another voxel.
  const sim::Vec3 count = glm::ceil((high - low) / voxel_m - 1e-3);
  if (std::max({count.x, count.y, count.z}) > 16000.0) {
    throw sim::InputError(
        fmt::format("{}: world: {:.0f} x {:.0f} x {:.0f} voxels; expected at most 16000 a side, as "
                    "with a voxel of {:.3g} m",
                    scene.file.string(), count.x, count.y, count.z,
                    std::max({high.x - low.x, high.y - low.y, high.z - low.z}) / 16000.0));
  }
  return {low + 0.5 * voxel_m, voxel_m, sim::Voxel(count)};
}

/// Seeds in the open voxels right above a region, drawn without putting two in one place.
std::vector<sim::Vec3> scatter(const sim::World& world, const Scatter& spec, std::uint64_t seed,
                               std::size_t plant) {
  std::vector<sim::Voxel> open;
  for (const sim::TiledVoxel& tiled : world.surfaces()) {
    const sim::Voxel above = tiled.voxel + sim::Voxel(0, 1, 0);
    if (world.part(tiled.surface.part).region == spec.region && sim::contains(world.frame().size, above) &&
        !world.occupied().at(above)) {
      open.push_back(above);
    }
  }
  if (open.size() < static_cast<std::size_t>(spec.count)) {
    throw sim::InputError(fmt::format("scatter: region '{}' has {} places that look up; expected at least {}",
                                      spec.region, open.size(), spec.count));
  }
  sim::Draws draws({seed, static_cast<std::uint32_t>(plant), 0, 0}, sim::Purpose::scatter);
  std::vector<sim::Vec3> seeds;
  for (int i = 0; i < spec.count; ++i) {  // Fisher and Yates, as far as needed
    const int pick = draws.whole(i, static_cast<int>(open.size()) - 1);
    std::swap(open[static_cast<std::size_t>(i)], open[static_cast<std::size_t>(pick)]);
    seeds.emplace_back(open[static_cast<std::size_t>(i)]);
  }
  return seeds;
}

void requireCamerasInTheOpen(const Job& job) {
  for (const NamedCamera& camera : job.scene.cameras) {
    const sim::PartId part =
        job.world.partAt(sim::voxelAt(sim::voxelFromWorld(job.world.frame(), camera.camera.eye_m)));
    if (part == sim::kFree) continue;
    throw sim::InputError(fmt::format("camera '{}' stands inside '{}' ({}); move its eye into the open",
                                      camera.name, job.world.part(part).object, job.world.part(part).region));
  }
}

sim::Planting plant(Job& job, const PlantSpec& spec, std::size_t number) {
  job.rules.push_back(rules::makeRandomTree(spec.rules, job.world.frame().voxel_m));
  sim::Planting planting{spec.name, job.rules.back().get(), {}};
  for (const SeedSpec& seed : spec.seeds) {
    planting.seeds_vx.push_back(sim::voxelFromWorld(job.world.frame(), seed.at_m));
  }
  if (spec.scatter) {
    const auto seeds = scatter(job.world, *spec.scatter, job.scene.seed, number);
    planting.seeds_vx.insert(planting.seeds_vx.end(), seeds.begin(), seeds.end());
  }
  return planting;
}

}  // namespace

Job prepareJob(Scene scene) {
  std::vector<sim::TiledMesh> meshes = readMeshes(scene);
  const std::string where = scene.file.string() + ":";
  try {
    std::vector<sim::FillReport> fills;
    sim::Sky sky;
    sim::Sun sun;
    std::optional<sim::World> world;
    sim::parallelInvoke(
        [&] {
          const sim::Frame frame = frameFor(scene, meshes);
          world.emplace(sim::buildWorld(frame, meshes, scene.world.layers, &fills));
        },
        [&] {
          sky = sim::makeSky(skySettings(scene.sky));
          sun = makeSun(scene.sun);
        });
    const auto random_sky = randomSky(scene.sky, scene.seed);
    Job job{std::move(scene), std::move(meshes), std::move(fills), std::move(*world), {}, {},
            std::move(sky),   random_sky,        std::move(sun)};
    requireRegionsToScatterOver(job.scene, job.world);
    for (std::size_t i = 0; i < job.scene.plants.size(); ++i) {
      job.plantings.push_back(plant(job, job.scene.plants[i], i));
    }
    requireCamerasInTheOpen(job);
    return job;
  } catch (const sim::InputError& error) {
    if (std::string_view(error.what()).starts_with(where)) throw;
    throw sim::InputError(where + " " + error.what());
  }
}

sim::GrowthSettings growthSettings(const Job& job) {
  sim::GrowthSettings settings;
  settings.iterations = job.scene.iterations;
  settings.seed = job.scene.seed;
  settings.sky = sim::receivedBy(job.sky);
  settings.random_sky = job.random_sky;
  settings.weighting = job.sky.weighting;
  settings.sun = job.sun.directions;
  settings.sky_table = sim::makeSkyTable(9, 36, sim::backgroundOf(job.sky.weighting));  // cells of 10 degrees
  for (const ImageSpec& image : job.scene.images) {
    settings.record_attempts = settings.record_attempts || image.kind == ImageKind::attempts;
  }
  return settings;
}

}  // namespace espalier::scenes
