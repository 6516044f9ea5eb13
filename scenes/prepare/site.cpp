#include "scenes/prepare/site.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "rules/growth/voxel_widths.h"
#include "scenes/clean_text.h"
#include "scenes/import/mesh_import.h"
#include "scenes/import/points_reader.h"
#include "scenes/import/skeleton_reader.h"
#include "scenes/import/world_of.h"
#include "scenes/lights.h"
#include "scenes/prepare/in_scene.h"
#include "scenes/prepare/unit_hints.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"

namespace espalier::scenes {
namespace {

/// Files that meshes were read from.
struct MeshFiles {
  std::vector<sim::InputFile> files;
  std::vector<std::filesystem::path> paths;
};

/// Adds a mesh's files, called from the scene's file as the mesh is.
void addFiles(const SceneMesh& spec, const std::vector<sim::InputFile>& read, MeshFiles& to) {
  const std::filesystem::path told =
      spec.told.empty() ? spec.file.filename() : std::filesystem::path(spec.told);
  for (const sim::InputFile& file : read) {
    sim::InputFile named = file;
    named.name = file.kind == "mesh" ? cleanText(told.generic_string())
                                     : cleanText((told.parent_path() / file.name).generic_string());
    to.paths.push_back(file.kind == "mesh" ? spec.file : spec.file.parent_path() / file.name);
    if (std::find(to.files.begin(), to.files.end(), named) == to.files.end())
      to.files.push_back(std::move(named));
  }
}

/// Adds a file that stands alone, called as the scene's file calls it.
void addFile(const std::filesystem::path& path, const std::string& told, sim::InputFile read, MeshFiles& to) {
  if (!told.empty()) read.name = told;
  to.paths.push_back(path);
  if (std::find(to.files.begin(), to.files.end(), read) == to.files.end())
    to.files.push_back(std::move(read));
}

/// Those that stand in the world, and those that do not.
struct Meshes {
  std::vector<sim::TiledMesh> tiled;
  std::vector<sim::Mesh> shapes;
};

Meshes readMeshes(const Scene& scene, MeshFiles& files, std::vector<Problem>& warnings) {
  for (const SceneMesh& spec : scene.meshes) {
    std::error_code unknown;  // what cannot be looked at is there, and an error when it is read
    if (spec.optional &&
        std::filesystem::status(spec.file, unknown).type() == std::filesystem::file_type::not_found) {
      throw MeshMissing(fmt::format("{}: the mesh {} is not there", scene.file.string(), spec.file.string()));
    }
  }
  Meshes meshes;
  for (const SceneMesh& spec : scene.meshes) {
    MeshSources read;
    sim::Mesh mesh = placeMesh(importMesh(spec.file, spec.regions_from, std::nullopt, &read), spec.placement);
    addFiles(spec, read.files, files);
    for (Problem& warning : read.warnings) {  // of materials, which nobody sees under a colour of the scene's
      if (spec.tiled && !spec.colour &&
          std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
        warnings.push_back(std::move(warning));
    }
    mesh.name = spec.name;
    if (spec.colour) {
      for (sim::Material& material : mesh.materials) {
        material.colour = *spec.colour;
        material.texture.reset();
      }
    }
    if (spec.tiled) {
      meshes.tiled.push_back({std::move(mesh), spec.solid.value_or(false), !spec.solid});
    } else {
      mesh.uvs = {};  // nobody sees it
      mesh.normals = {};
      for (sim::Material& material : mesh.materials) material.texture.reset();
      meshes.shapes.push_back(std::move(mesh));
    }
  }
  return meshes;
}

std::vector<std::vector<sim::Vec3>> readListed(const Scene& scene, MeshFiles& files) {
  std::vector<std::vector<sim::Vec3>> all;
  forEachTable(scene, [&](const PointTable& table, const std::string&) {
    all.emplace_back();
    if (table.file.empty()) return;
    sim::InputFile read;
    all.back() = readPoints(table.file, table.type, read);
    addFile(table.file, table.told, std::move(read), files);
  });
  return all;
}

std::vector<std::vector<FileTree>> readPlaced(const Scene& scene, MeshFiles& files) {
  std::vector<std::vector<FileTree>> all;
  for (const PlantSpec& plant : scene.plants) {
    all.emplace_back();
    if (!plant.skeleton) continue;
    const SkeletonSpec& spec = *plant.skeleton;
    sim::InputFile read;
    all.back() = readSkeletons(spec.file, read);
    placeSkeletons(all.back(), spec.placement);
    addFile(spec.file, spec.told, std::move(read), files);
  }
  return all;
}

std::vector<FieldVolume> readFields(const Scene& scene, MeshFiles& files, std::vector<Problem>& warnings) {
  std::vector<sim::InputFile> read;
  std::vector<FieldVolume> fields = readFieldGrids(scene, read, warnings);
  for (sim::InputFile& file : read) {
    if (std::find(files.files.begin(), files.files.end(), file) == files.files.end())
      files.files.push_back(std::move(file));
  }
  for (const FieldSpec& field : scene.fields) {
    if (!field.file.empty()) files.paths.push_back(field.file);
  }
  return fields;
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
    extent = high - low + 2.0 * spec.margin_m.value_or(0.0);
  }
  return std::max({extent.x, extent.y, extent.z}) / resolution;
}

sim::Frame frameOf(const std::filesystem::path& scene, const std::array<sim::Vec3, 2>& bounds_m,
                   double voxel_m) {
  const auto& [low, high] = bounds_m;
  // A thousandth of a voxel too much is a rounding of the file's decimals, not another voxel.
  const sim::Vec3 count = glm::ceil((high - low) / voxel_m - 1e-3);
  if (std::max({count.x, count.y, count.z}) > 16000.0) {
    throw sim::InputError(
        fmt::format("{}: world: {:.0f} x {:.0f} x {:.0f} voxels; expected at most 16000 a side, as "
                    "with a voxel of {:.3g} m",
                    scene.string(), count.x, count.y, count.z,
                    std::max({high.x - low.x, high.y - low.y, high.z - low.z}) / 16000.0));
  }
  return {low + 0.5 * voxel_m, voxel_m, sim::Voxel(count)};
}

sim::World worldFor(const Scene& scene, const std::vector<sim::TiledMesh>& meshes,
                    std::vector<sim::FillReport>& fills) {
  const WorldSpec& spec = scene.world;
  const double voxel_m = spec.voxel_m ? *spec.voxel_m : voxelFor(spec.resolution.value_or(160), spec, meshes);
  const auto layers = [&](const sim::Frame& frame) { return layersFor(scene, frame); };
  if (!spec.bounds_m) return worldAround(meshes, voxel_m, spec.margin_m, layers, &fills);
  const sim::Frame frame = frameOf(scene.file, *spec.bounds_m, voxel_m);
  return sim::buildWorld(frame, meshes, layers(frame), &fills);
}

/// The scene's meshes in its own order.
std::vector<const sim::Mesh*> inOrder(const Scene& scene, const Meshes& meshes) {
  std::vector<const sim::Mesh*> all;
  std::size_t tiled = 0, shapes = 0;
  for (const SceneMesh& spec : scene.meshes)
    all.push_back(spec.tiled ? &meshes.tiled[tiled++].mesh : &meshes.shapes[shapes++]);
  return all;
}

/// As inScene; where there is no world to be had, a mesh in another unit may be why.
template <typename Work>
auto withUnitHints(const Scene& scene, const Meshes& meshes, Work work) {
  try {
    return inScene(scene, work);
  } catch (const sim::InputError& error) {
    const std::vector<Problem> hints = unitHints(scene, inOrder(scene, meshes), WorldMade::no);
    if (hints.empty()) throw;
    std::vector<std::string> lines{error.what()};
    for (const Problem& hint : hints) lines.push_back(format(hint));
    throw ManyLines(std::move(lines));
  }
}

}  // namespace

Site makeSite(const Scene& scene) {
  MeshFiles files;
  std::vector<Problem> warnings;
  Meshes meshes = readMeshes(scene, files, warnings);
  std::vector<std::vector<sim::Vec3>> listed_m = readListed(scene, files);
  std::vector<std::vector<FileTree>> skeletons = readPlaced(scene, files);
  std::vector<FieldVolume> fields = readFields(scene, files, warnings);
  Site made = withUnitHints(scene, meshes, [&]() -> Site {
    std::vector<FacingReport> facings = findFacing(meshes.tiled);
    std::vector<sim::FillReport> fills;
    std::optional<sim::World> world;
    sim::Sky sky;
    sim::Sun sun;
    sim::parallelInvoke([&] { world.emplace(worldFor(scene, meshes.tiled, fills)); },
                        [&] {
                          sky = sim::makeSky(skySettings(scene.sky));
                          sun = makeSun(scene.sun);
                        });
    for (Problem& hint : unitHints(scene, inOrder(scene, meshes), WorldMade::yes))
      warnings.push_back(std::move(hint));
    return {std::move(meshes.tiled), std::move(meshes.shapes),
            std::move(listed_m),     std::move(skeletons),
            std::move(fields),       std::move(facings),
            std::move(fills),        std::move(*world),
            std::move(sky),          randomSky(scene.sky, scene.seed),
            std::move(sun),          std::move(files.files),
            std::move(files.paths),  std::move(warnings)};
  });
  findRegions(scene, made);
  return made;
}

Site makeSiteForLight(Scene scene) {
  scene.plants.clear();
  scene.attractors.clear();
  scene.fields.clear();
  scene.world.layers = 0;
  if (!scene.sky.accuracy) scene.sky.accuracy = SkySpec::kMapError;
  return makeSite(scene);
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
  for (const PlantSpec& plant : scene.plants) {
    const auto needed = rules::layersNeeded(*plant.rules, frame.voxel_m, glm::length(sim::Vec3(frame.size)));
    if (needed.layers > kMostLayers) {
      const Place& at = plant.rules_place;
      const std::string place =
          at.path ? fmt::format("{}:{}:{}", *at.path, at.line, at.column) : scene.file.string();
      throw sim::InputError(
          fmt::format("{}: {} at a voxel of {:.4g} m, which takes {} boundary layers; expected at most {}{}",
                      place, needed.asked_by, frame.voxel_m, needed.layers, kMostLayers,
                      std::isfinite(needed.asked_m)
                          ? fmt::format(", as with a voxel of {:.4g} m", needed.asked_m / (kMostLayers - 1))
                          : ""));
    }
    layers = std::max(layers, needed.layers);
  }
  return layers;
}

void requireCamerasInTheOpen(const Scene& scene, const sim::World& world) {
  for (const NamedCamera& camera : scene.cameras) {
    const sim::PartId part =
        world.partAt(sim::voxelAt(sim::voxelFromWorld(world.frame(), camera.camera.eye_m)));
    if (part == sim::kFree) continue;
    throw sim::InputError(fmt::format("{}: camera '{}' stands inside '{}' ({}); move its eye into the open{}",
                                      scene.file.string(), camera.name, world.part(part).object,
                                      world.part(part).region, sim::orLeaveHollow(world.part(part))));
  }
}

}  // namespace espalier::scenes
