#include "scenes/prepare/site.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "rules/growth/voxel_widths.h"
#include "scenes/import/world_of.h"
#include "scenes/lights.h"
#include "scenes/prepare/in_scene.h"
#include "scenes/prepare/unit_hints.h"
#include "sim/base/error.h"
#include "sim/base/faces.h"
#include "sim/base/parallel.h"
#include "sim/tile/emission.h"

namespace espalier::scenes {
namespace {

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
    extent = high - low + 2.0 * spec.margin_m.value_or(0.0);
  }
  return std::max({extent.x, extent.y, extent.z}) / resolution;
}

sim::Frame frameOf(const std::array<sim::Vec3, 2>& bounds_m, double voxel_m) {
  const auto& [low, high] = bounds_m;
  // A thousandth of a voxel too much is a rounding of the file's decimals, not another voxel.
  const sim::Vec3 count = glm::ceil((high - low) / voxel_m - 1e-3);
  if (std::max({count.x, count.y, count.z}) > 16000.0) {
    throw sim::InputError(fmt::format(
        "world: {:.0f} x {:.0f} x {:.0f} voxels; expected at most 16000 a side, as "
        "with a voxel of {:.3g} m",
        count.x, count.y, count.z, std::max({high.x - low.x, high.y - low.y, high.z - low.z}) / 16000.0));
  }
  return {low + 0.5 * voxel_m, voxel_m, sim::Voxel(count)};
}

sim::World worldFor(const Scene& scene, const std::vector<sim::TiledMesh>& meshes,
                    std::vector<sim::FillReport>& fills) {
  const WorldSpec& spec = scene.world;
  const double voxel_m = spec.voxel_m ? *spec.voxel_m : voxelFor(spec.resolution.value_or(160), spec, meshes);
  const auto layers = [&](const sim::Frame& frame) { return layersFor(scene, frame); };
  if (!spec.bounds_m) return worldAround(meshes, voxel_m, spec.margin_m, layers, &fills);
  const sim::Frame frame = frameOf(*spec.bounds_m, voxel_m);
  return sim::buildWorld(frame, meshes, layers(frame), &fills);
}

/// The scene's meshes in its own order.
std::vector<const sim::Mesh*> inOrder(const Scene& scene, const SiteFiles& files) {
  std::vector<const sim::Mesh*> all;
  std::size_t tiled = 0, shapes = 0;
  for (const SceneMesh& spec : scene.meshes)
    all.push_back(spec.tiled ? &files.meshes[tiled++].mesh : &files.shapes[shapes++]);
  return all;
}

/// Where there is no world to be had, a mesh in another unit may be why.
template <typename Work>
void withUnitHints(const Scene& scene, const SiteFiles& files, Work work) {
  try {
    inScene(scene, scene.world.place, work);
  } catch (const PlacedError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& hint : unitHints(scene, inOrder(scene, files), WorldMade::no))
      problems.push_back(std::move(hint));
    throw PlacedError(std::move(problems));
  }
}

}  // namespace

Site makeSite(const Scene& scene) {
  return makeSite(scene, readSiteFiles(scene));
}

Site makeSite(const Scene& scene, SiteFiles&& files) {
  std::vector<sim::FillReport> fills;
  std::optional<sim::World> world;
  sim::Sky sky;
  sim::Sun sun;
  withUnitHints(scene, files, [&] {
    sim::parallelInvoke([&] { world.emplace(worldFor(scene, files.meshes, fills)); },
                        [&] {
                          sky = sim::makeSky(skySettings(scene.sky));
                          sun = makeSun(scene.sun);
                        });
  });
  for (Problem& hint : unitHints(scene, inOrder(scene, files), WorldMade::yes))
    files.warnings.push_back(std::move(hint));
  Site made{
      std::move(files), std::move(fills), std::move(*world), std::move(sky), randomSky(scene.sky, scene.seed),
      std::move(sun)};
  findRegions(scene, made);
  return made;
}

Scene forLight(Scene scene) {
  scene.plants.clear();
  scene.attractors.clear();
  scene.fields.clear();
  scene.sky.background = {};
  scene.world.layers = 0;
  if (!scene.sky.accuracy) scene.sky.accuracy = SkySpec::kMapError;
  return scene;
}

Site makeSiteForLight(Scene scene) {
  return makeSite(forLight(std::move(scene)));
}

const sim::Mesh& meshNamed(const Site& site, const std::string& name) {
  for (const sim::TiledMesh& tiled : site.meshes) {
    if (tiled.mesh.name == name) return tiled.mesh;
  }
  for (const sim::Mesh& shape : site.shapes) {
    if (shape.name == name) return shape;
  }
  throw sim::InputError(fmt::format("no mesh is called {}", inQuotes(name)));
}

std::string leakOf(const std::string& mesh, const sim::InsideDoubt& doubt) {
  return fmt::format(
      "the mesh '{}' leaks: for {:.2g} % of its inside lines along the axes contradict each "
      "other and a vote decides, which is close for {:.2g} %",
      mesh, 100.0 * doubt.doubtful, 100.0 * doubt.undecided);
}

int layersFor(const Scene& scene, const sim::Frame& frame) {
  int layers = scene.world.layers;
  Gathering wrong(scene.file);
  for (const PlantSpec& plant : scene.plants) {
    const auto needed = rules::layersNeeded(*plant.rules, frame.voxel_m, glm::length(sim::Vec3(frame.size)));
    if (needed.layers > kMostLayers) {
      wrong.add(problemAt(
          plant.rules_place, scene.file,
          fmt::format("{} at a voxel of {:.4g} m, which takes {} boundary layers; expected at most {}{}",
                      needed.asked_by, frame.voxel_m, needed.layers, kMostLayers,
                      std::isfinite(needed.asked_m)
                          ? fmt::format(", as with a voxel of {:.4g} m", needed.asked_m / (kMostLayers - 1))
                          : "")));
    }
    layers = std::max(layers, needed.layers);
  }
  wrong.end();
  return layers;
}

void requireCamerasInTheOpen(const Scene& scene, const sim::World& world) {
  Gathering wrong(scene.file);
  for (const NamedCamera& camera : scene.cameras) {
    const sim::PartId part =
        world.partAt(sim::voxelAt(sim::voxelFromWorld(world.frame(), camera.camera.eye_m)));
    if (part == sim::kFree) continue;
    wrong.add(problemAt(
        camera.eye_place, scene.file,
        fmt::format("camera '{}' stands inside '{}' ({}); move its eye into the open{}", camera.name,
                    world.part(part).object, world.part(part).region, sim::orLeaveHollow(world.part(part)))));
  }
  wrong.end();
}

void requireLampsInTheOpen(const Scene& scene, const Site& site) {
  const sim::BitVolume& occupied = site.world.occupied();
  const auto isOpen = [&](sim::Voxel v) {
    return std::any_of(sim::kFaceNormals.begin(), sim::kFaceNormals.begin() + sim::kFaces,
                       [&](sim::Voxel normal) { return !occupied.at(v + normal); });
  };
  Gathering wrong(scene.file);
  for (const SceneMesh& spec : scene.meshes) {
    const auto tiled = std::find_if(site.meshes.begin(), site.meshes.end(),
                                    [&](const sim::TiledMesh& mesh) { return mesh.mesh.name == spec.name; });
    if (tiled == site.meshes.end()) continue;
    const auto lamps =
        sim::emissionOf(site.world.frame(), std::span(&*tiled, 1), [](sim::Voxel) { return 1.0f; });
    const auto opens = [&](const sim::EmittingVoxel& lamp) { return isOpen(lamp.voxel); };
    if (lamps.empty() || std::any_of(lamps.begin(), lamps.end(), opens)) continue;
    const sim::PartId part = site.world.partAt(lamps.front().voxel);
    wrong.add(problemAt(spec.place, scene.file,
                        fmt::format("mesh '{}' sends out light, and none gets out: it lies inside of '{}'; "
                                    "expected it in the open",
                                    spec.name, site.world.part(part).object)));
  }
  wrong.end();
}

}  // namespace espalier::scenes
