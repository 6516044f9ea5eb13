#include "scenes/job/inspect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/job/expose.h"
#include "scenes/job/starter_scene.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

/// Voxels in steps of 1, 2, 5 and 10, of which about `many` lie along a length.
double roundVoxel(double length_m, double many) {
  const double about = length_m / many;
  const double power = std::pow(10.0, std::floor(std::log10(about)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (about <= step * power * 1.0001) return step * power;
  }
  return 10.0 * power;
}

VoxelChoice choiceOf(Scene scene, const SiteFiles& files, Clock::duration reading, double voxel_m) {
  scene.world.voxel_m = voxel_m;
  scene.plants.clear();
  VoxelChoice choice{voxel_m, {}, {}};
  try {
    RunOptions options;
    options.pictures = false;
    choice.foretold = foretellExpose(scene, options, files, reading);
  } catch (const ManyLines& error) {
    choice.refused = error.lines().front();
  } catch (const sim::InputError& error) {
    choice.refused = error.what();
  }
  return choice;
}

}  // namespace

InScene sceneWith(const std::vector<Inspected>& meshes, const std::filesystem::path& scene_file) {
  constexpr double kAlong = 200.0;
  std::vector<SceneMesh> lines;
  sim::Vec3 low(INFINITY), high(-INFINITY);
  for (const Inspected& mesh : meshes) {
    if (mesh.from_origin_m > kFarthest_m) {
      throw sim::InputError(
          fmt::format("{}: it lies {:.3g} m from the origin, farther than a scene reaches; expected {:.0f} m "
                      "at most: move it in "
                      "the program that it comes from",
                      mesh.file.string(), mesh.from_origin_m, kFarthest_m));
    }
    lines.push_back(mesh.line);
    low = glm::min(low, mesh.low_m);
    high = glm::max(high, mesh.high_m);
  }
  const sim::Vec3 size = high - low;
  const double voxel_m = roundVoxel(std::max({size.x, size.y, size.z}), kAlong);
  InScene result;
  const StarterScene starter = starterScene(lines, {low, high}, voxel_m, scene_file);
  result.text = starter.text;
  for (const double wide : {2.0, 1.0, 0.5})
    result.choices.push_back(choiceOf(starter.scene, starter.files, starter.reading, wide * voxel_m));
  return result;
}

}  // namespace espalier::scenes
