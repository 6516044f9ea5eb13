#include <fmt/format.h>

#include <algorithm>

#include "rules/growth/laid_measure.h"
#include "rules/growth/make_process.h"
#include "sim/base/parallel.h"
#include "sim/grow/grow.h"
#include "sim/tile/build_world.h"
#include "tests/bench/rows.h"

namespace espalier::bench {
namespace {

using sim::Vec3;

constexpr double kFloorVoxel_m = 0.08;

rules::Element slab(const char* name, double width_m, double depth_m, double share) {
  rules::Element element;
  element.name = name;
  element.pose = rules::Pose::surface;
  element.share = share;
  element.thick = {0.05, true};
  element.polygons_metres = true;
  const double x = 0.5 * width_m, y = 0.5 * depth_m;
  element.polygons = {{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}};
  return element;
}

/// The library's, as values.
rules::RuleSet paving() {
  rules::RuleSet rules;
  rules.propagate = rules::Propagate::diffusion;
  rules.diffusion.around = rules::Around::edges;
  rules.diffusion.gap_min = {0.008, true};
  rules.diffusion.gap_max = {0.06, true};
  rules.diffusion.off = {0.01, true};
  rules.diffusion.rounds = 100'000;
  rules.elements = {slab("slab", 0.616, 0.408, 4.0), slab("square", 0.408, 0.408, 2.0),
                    slab("sett", 0.2, 0.2, 1.0)};
  return rules;
}

sim::TiledMesh floorOf(double side_m) {
  sim::TiledMesh floor;
  floor.mesh.name = "floor";
  floor.mesh.regions = {"floor"};
  floor.mesh.materials = {{"sand"}};
  floor.mesh.vertices_m = {{0, 0, 0}, {0, 0, side_m}, {side_m, 0, side_m}, {side_m, 0, 0}};
  floor.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  floor.mesh.region = floor.mesh.material = {0, 0};
  return floor;
}

/// Seconds a tile.
double layOn(double side_m, std::optional<Target> target, Report& report) {
  const std::vector<sim::TiledMesh> meshes{floorOf(side_m)};
  const auto rules = std::make_shared<const rules::RuleSet>(paving());
  sim::Growth growth;
  std::uint64_t state = 0;
  rules::LaidMeasure laid;
  std::vector<double> seconds;
  for (int run = 0; run < 3; ++run) {
    sim::World world = sim::buildWorld(sim::frameAround(meshes, kFloorVoxel_m, 0.4), meshes, 1);
    const Vec3 middle(0.5 * side_m, 0.1, 0.5 * side_m);
    seconds.push_back(secondsOf([&] {
      const auto surface = sim::surfaceOf(world.frame(), meshes);
      sim::GrowthSettings settings;
      settings.iterations = 1;
      growth = sim::grow(world,
                         {{"paving", rules::makeProcess(rules, world.frame(), surface),
                           sim::seedsAt(world.frame(), {sim::voxelFromWorld(world.frame(), middle)})}},
                         settings);
    }));
    state = sim::stateHash(world, growth);
    if (run == 0)
      laid = rules::measureLaid(rules, growth.plants, sim::surfaceOf(world.frame(), meshes), world);
  }
  std::sort(seconds.begin(), seconds.end());
  const auto tiles = static_cast<double>(growth.plants.front().elements.size());
  const double mm = 1000.0 * kFloorVoxel_m;
  report.note(fmt::format("  {:.0f} m: {} tiles on {:.1f} % of it, joints of {:.3f} mm, give or take {:.2g}",
                          side_m, tiles, 100.0 * laid.covered_vx2 / laid.surface_vx2,
                          laid.joints.mean_vx * mm, laid.joints.deviation_vx * mm));
  report.add({"10", fmt::format("    {} tiles", tiles), seconds[1], "s", state, target});
  return seconds[1] / tiles;
}

}  // namespace

void benchLaying(Report& report) {
  report.title("10. Diffusion: a square floor paved from its middle with slabs of three sizes");
  const double few = layOn(14.0, std::nullopt, report);
  const double many = layOn(43.5, Target{2.0, false}, report);
  const double most = layOn(100.0, std::nullopt, report);
  report.add(
      {"10", "    a tile among most of them over one among few", most / few, "times", 0, Target{1.5, false}});
  report.add({"10", "    tiles a second, of 10,000", 1.0 / many, "tiles/s", 0});
}

}  // namespace espalier::bench
