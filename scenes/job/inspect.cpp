#include "scenes/job/inspect.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "scenes/job/expose.h"
#include "scenes/job/starter_scene.h"
#include "sim/base/error.h"
#include "sim/base/memory.h"

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

/// `foretell`: what a job would take.
template <typename Foretell>
VoxelChoice choiceOf(double voxel_m, Foretell foretell) {
  VoxelChoice choice{voxel_m, {}, {}};
  try {
    choice.foretold = foretell();
  } catch (const ManyLines& error) {
    choice.refused = error.lines().front();
  } catch (const sim::InputError& error) {
    choice.refused = error.what();
  }
  return choice;
}

/// Of a world of another voxel size. The files, which took so long to read, are lent to it: a job has them in
/// memory once.
VoxelChoice otherChoice(Scene scene, const RunOptions& options, SiteFiles& files, Clock::duration reading,
                        double voxel_m) {
  scene.world.voxel_m = voxel_m;
  std::optional<Site> site;
  VoxelChoice choice = choiceOf(voxel_m, [&] {
    const Clock::time_point began = Clock::now();
    sim::releaseFreed();
    site.emplace(makeSite(forLight(scene), std::move(files)));
    sim::releaseFreed();
    return foretellExpose(scene, options, *site, Clock::now() - began + reading);
  });
  if (site) files = std::move(static_cast<SiteFiles&>(*site));
  return choice;
}

}  // namespace

InScene sceneWith(std::vector<Inspection> meshes, const std::filesystem::path& scene_file) {
  constexpr double kAlong = 200.0;
  std::vector<SceneMesh> lines;
  std::vector<sim::Mesh> placed;
  std::chrono::duration<double> reading(0.0);
  sim::Vec3 low(INFINITY), high(-INFINITY);
  for (auto& [mesh, as_placed, reading_s] : meshes) {
    if (mesh.from_origin_m > kFarthest_m) {
      throw sim::InputError(
          fmt::format("{}: it lies {:.3g} m from the origin, farther than a scene reaches; expected {:.0f} m "
                      "at most: move it in "
                      "the program that it comes from",
                      mesh.file.string(), mesh.from_origin_m, kFarthest_m));
    }
    lines.push_back(mesh.line);
    placed.push_back(std::move(as_placed));
    reading += std::chrono::duration<double>(reading_s);
    low = glm::min(low, mesh.low_m);
    high = glm::max(high, mesh.high_m);
  }
  const sim::Vec3 size = high - low;
  const double voxel_m = roundVoxel(std::max({size.x, size.y, size.z}), kAlong);
  InScene result;
  StarterScene starter = starterScene(lines, std::move(placed), {low, high}, voxel_m, scene_file);
  result.text = starter.text;
  RunOptions options;
  options.pictures = false;
  const Clock::duration before = std::chrono::duration_cast<Clock::duration>(reading);
  VoxelChoice same;
  SiteFiles files;
  {
    Site site = std::move(starter.site);  // its world is given back before others are made
    sim::releaseFreed();
    same = choiceOf(voxel_m,
                    [&] { return foretellExpose(starter.scene, options, site, before + starter.tiling); });
    files = std::move(static_cast<SiteFiles&>(site));
  }
  const auto other = [&](double wide) {
    return otherChoice(starter.scene, options, files, before, wide * voxel_m);
  };
  VoxelChoice coarser = other(2.0);
  result.choices = {std::move(coarser), std::move(same), other(0.5)};
  return result;
}

}  // namespace espalier::scenes
