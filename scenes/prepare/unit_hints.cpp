#include "scenes/prepare/unit_hints.h"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/inspect/mesh_shape.h"

namespace espalier::scenes {
namespace {

constexpr double kSmall_m = 0.3;

std::string tooLarge(const SceneMesh& mesh, const MeshShape& shape) {
  std::string cures;
  for (const UnitReading& reading : likelyUnits(shape.longest())) {
    if (reading.unit == LengthUnit::m) continue;
    cures +=
        fmt::format("{}'unit: {}', which makes it {}", cures.empty() ? "" : ", or ", nameOf(reading.unit),
                    sizeText(shape.size() * (reading.longest_m / shape.longest())));
  }
  if (cures.empty()) return "";
  return fmt::format(
      "the mesh {} is {} large, as if its file counted another unit than metres; expected {}, "
      "or 'unit: m' where it is right",
      inQuotes(mesh.name), sizeText(shape.size()), cures);
}

std::string tooSmall(const Scene& scene, const MeshShape& all) {
  constexpr int kFew_vx = 16;
  const double longest = all.longest();
  bool other_unit = false;
  for (const SceneMesh& mesh : scene.meshes) {
    if (!mesh.tiled || !mesh.placement.unit) continue;
    if (mesh.placement.unit == LengthUnit::m) return "";
    other_unit = true;
  }
  if (!scene.world.voxel_m || longest >= kSmall_m || longest >= kFew_vx * *scene.world.voxel_m) return "";
  return fmt::format(
      "all that stands in the world is {} large, {:.2g} voxels of {:.4g} m; expected smaller "
      "voxels, or {}",
      sizeText(all.size()), longest / *scene.world.voxel_m, *scene.world.voxel_m,
      other_unit ? "another unit" : "a scale for its meshes, or 'unit: m' where it is right");
}

}  // namespace

std::vector<Problem> unitHints(const Scene& scene, const std::vector<const sim::Mesh*>& meshes,
                               WorldMade made) {
  std::vector<Problem> hints;
  MeshShape all;
  const SceneMesh* first = nullptr;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const SceneMesh& spec = scene.meshes[i];
    const MeshShape shape = shapeOf(*meshes[i]);
    if (spec.tiled) {
      if (!first) first = &spec;
      all.low = glm::min(all.low, shape.low);
      all.high = glm::max(all.high, shape.high);
    }
    if (spec.placement.unit || shape.longest() < kLarge_m) continue;
    if (made == WorldMade::yes && !isTooHighForAHouse(shape, UpAxis::y)) continue;
    if (auto text = tooLarge(spec, shape); !text.empty())
      hints.push_back(problemAt(spec.place, scene.file, std::move(text)));
  }
  if (!first) return hints;
  if (auto text = tooSmall(scene, all); !text.empty())
    hints.push_back(problemAt(first->place, scene.file, std::move(text)));
  return hints;
}

}  // namespace espalier::scenes
