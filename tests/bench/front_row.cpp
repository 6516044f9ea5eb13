#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rules/front/colonize.h"
#include "rules/growth/front_memory.h"
#include "rules/growth/make_process.h"
#include "sim/base/hasher.h"
#include "sim/base/random.h"
#include "sim/grow/grow.h"
#include "sim/light/sky.h"
#include "sim/light/sun.h"
#include "tests/bench/dome.h"
#include "tests/bench/kd_tree_peer.h"
#include "tests/bench/rows.h"

namespace espalier::bench {
namespace {

using sim::Vec3;

constexpr rules::FrontRules kRules{0.1, 2.5, 0.1};
constexpr int kNoLimit = 100'000;
constexpr double kVoxel_m = 6.0 / 400;
constexpr double kHalf_m = 6.2, kBelow_m = 0.3;  // of the world, around the root

std::uint64_t hashOf(const std::vector<Vec3>& places) {
  sim::Hasher hasher;
  hasher.add(places);
  return hasher.digest();
}

enum class Around { nothing, boxes };

sim::World worldAround(Around around) {
  const auto voxels = [](double metres) { return static_cast<int>(std::lround(metres / kVoxel_m)); };
  const sim::Voxel size(voxels(2.0 * kHalf_m), voxels(8.6), voxels(2.0 * kHalf_m));
  sim::World world({Vec3(0.0), kVoxel_m, size});
  if (around == Around::nothing) return world;
  const sim::PartId part = world.addPart({"boxes", "boxes", sim::PartKind::scene, -1});
  std::vector<sim::TiledVoxel> edit;
  for (int box = 0; box < 40; ++box) {
    sim::Draws draws({7, static_cast<std::uint32_t>(box)}, sim::Purpose::custom);
    const int x0 = draws.whole(50, size.x - 80), y0 = draws.whole(100, size.y - 80),
              z0 = draws.whole(50, size.z - 80);
    for (int y = y0; y < y0 + 24; ++y) {
      for (int z = z0; z < z0 + 24; ++z) {
        for (int x = x0; x < x0 + 24; ++x) edit.push_back({{x, y, z}, {part, sim::Colour(0.5f), 1.0f}});
      }
    }
  }
  world.occupy(edit);
  return world;
}

rules::RuleSet tree() {
  rules::RuleSet rules;
  rules.propagate = rules::Propagate::colonization;
  rules.colonization.attractors = "dome";
  rules.colonization.step = {kRules.step, true};
  rules.colonization.influence = {kRules.influence, true};
  rules.colonization.kill = {kRules.kill, true};
  return rules;
}

sim::Growth growIn(sim::World& world, const rules::RuleSet& rules, const std::vector<Vec3>& attractors) {
  const Vec3 root(kHalf_m, kBelow_m, kHalf_m);
  sim::GrowthSettings settings;
  settings.iterations = kNoLimit;
  settings.light.sky = skyOf(64);
  settings.light.sun = sim::makeSun({20.0, 180.0, 24}).directions;
  auto& places = sim::column<Vec3>(settings.commons[rules::attractorsNamed("dome")], rules::kAttractorPlace);
  for (const Vec3& at : attractors) {
    const Vec3 at_vx = sim::voxelFromWorld(world.frame(), at + root);
    if (world.partAt(sim::voxelAt(at_vx)) == sim::kFree) places.push_back(at_vx);
  }
  return sim::grow(world,
                   {{"tree", rules::makeProcess(std::make_shared<rules::RuleSet>(rules), kVoxel_m),
                     sim::seedsAt(world.frame(), {sim::voxelFromWorld(world.frame(), root)})}},
                   settings);
}

/// The median of five runs, each in a world that is made before the clock starts, after one that warms up.
double secondsToGrow(Around around, const rules::RuleSet& rules, const std::vector<Vec3>& attractors,
                     sim::Growth& growth) {
  std::vector<double> seconds;
  for (int run = 0; run < 6; ++run) {
    sim::World world = worldAround(around);
    seconds.push_back(secondsOf([&] { growth = growIn(world, rules, attractors); }));
  }
  seconds.erase(seconds.begin());
  std::sort(seconds.begin(), seconds.end());
  return seconds[seconds.size() / 2];
}

void benchOne(int count, double bare_target_s, double world_target_s, Report& report) {
  const std::vector<Vec3> attractors = dome(count);
  const Vec3 start(0.0);
  rules::Colony colony;
  const double bare = medianSeconds([&] {
    colony = rules::colonize(attractors, {&start, 1}, kRules, kNoLimit);
  });
  const std::uint64_t state = hashOf(colony.position);
  const std::string row = fmt::format("{} attractors", count);
  report.note(fmt::format("  {}: {} nodes in {} iterations, {} attractors left", row, colony.position.size(),
                          colony.iterations, colony.fates.waiting));
  const auto target = [](double s) { return s > 0.0 ? std::optional(Target{1e3 * s, false}) : std::nullopt; };
  report.add({"8", "    the front bare", 1e3 * bare, "ms", state, target(bare_target_s)});
  sim::Growth growth;
  const double world = secondsToGrow(Around::nothing, tree(), attractors, growth);
  report.add({"8", "    as a process in a world", 1e3 * world, "ms",
              hashOf(growth.plants[0].skeleton.position_vx), target(world_target_s)});
  if (count > 100'000) return;
  rules::RuleSet sensing = tree();
  sensing.bias.light = 0.1;
  sensing.require.exposure_min = 0.01;
  const double among = secondsToGrow(Around::boxes, sensing, attractors, growth);
  report.add({"8", "    among obstacles and in the light, over that", among / world, "times",
              hashOf(growth.plants[0].skeleton.position_vx), Target{2.0, false}});
}

}  // namespace

void benchFront(int most_attractors, Report& report) {
  report.title(
      "8. Space colonization: a dome of 6 m, step 0.1, influence 2.5, kill 0.1 m, until nothing is in reach; "
      "worlds of 827 x 573 x 827 voxels");
  struct Size {
    int count;
    double bare_s, world_s;
  };
  for (const Size size : {Size{1000, 0.005, 0.01}, Size{10'000, 0.05, 0.1}, Size{100'000, 0.5, 1.0},
                          Size{1'000'000, 0.0, 8.0}}) {
    if (size.count <= most_attractors) benchOne(size.count, size.bare_s, size.world_s, report);
  }
  const std::vector<Vec3> attractors = dome(100'000);
  const Vec3 start(0.0);
  std::optional<rules::Colony> peer;
  rules::Colony ours;
  const double ours_s = secondsOf([&] { ours = rules::colonize(attractors, {&start, 1}, kRules, kNoLimit); });
  const double peer_s = secondsOf([&] { peer = colonizeByKdTree(attractors, start, kRules, kNoLimit); });
  if (!peer) return report.note("  a kd-tree anew in each iteration: no nanoflann here");
  report.add({"8", "  a kd-tree of nodes anew in each iteration (nanoflann), 100,000 attractors",
              1e3 * peer_s, "ms", hashOf(peer->position)});
  if (peer->position != ours.position) report.note("    its nodes differ");
  report.add(
      {"8", "    over the front's", peer_s / ours_s, "times", hashOf(ours.position), Target{10.0, true}});
}

}  // namespace espalier::bench
