#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "rules/growth/make_process.h"
#include "sim/base/parallel.h"
#include "sim/grow/grow.h"
#include "sim/sweep/lanes.h"
#include "sim/tile/tiling.h"
#include "tests/bench/peers.h"
#include "tests/bench/rows.h"
#include "tests/bench/vine_wall.h"

namespace espalier::bench {
namespace {

/// Figure 4's vine with every bias, every requirement, ranges, senses, and a table of the sky.
rules::RuleSet withEverything(rules::RuleSet rules) {
  const auto range = [](double low, double high) {
    rules::Value value(low);
    value.kind = rules::Value::Kind::range;
    value.high = high;
    return value;
  };
  rules.random_tree.length.value = range(2.0, 8.0);
  rules.random_tree.wander_deg = range(10.0, 40.0);
  rules.random_tree.branch_angle_deg = range(40.0, 70.0);
  rules.bias.up = range(0.02, 0.1);
  rules.bias.gravity = 0.02;
  rules.bias.light = range(0.05, 0.15);
  rules.bias.brightest = rules::Brightest::table;
  rules.bias.away = 0.02;
  rules.bias.toward = range(0.05, 0.1);
  rules.bias.twist = range(-0.2, 0.2);
  using Measure = rules::SenseSpec::Measure;
  rules.senses = {{"crowd", Measure::density, "others", {6.0}},
                  {"gap", Measure::distance, "others", {12.0}},
                  {"rise", Measure::height, "scene", {6.0}}};
  rules.bias.senses = {{"crowd", -0.02}, {"gap", -0.02}};
  rules.require.senses = {{"crowd", -rules::kNoLimit, 0.9}, {"rise", 0.0, rules::kNoLimit}};
  rules.require.along = {{"crowd", -rules::kNoLimit, 0.95}};
  return rules;
}

/// Figure 4's vine, turned to the brightest spot and away from what other plants are near.
rules::RuleSet heliotropicAndShy(rules::RuleSet rules) {
  rules.bias.light = 0.1;
  rules.bias.brightest = rules::Brightest::table;
  using Measure = rules::SenseSpec::Measure;
  rules.senses = {{"crowd", Measure::density, "others", {6.0}}, {"gap", Measure::distance, "others", {12.0}}};
  rules.bias.senses = {{"crowd", -0.05}, {"gap", -0.05}};
  rules.require.senses = {{"crowd", -rules::kNoLimit, 0.9}};
  return rules;
}

struct Grown {
  std::size_t segments = 0, elements = 0, inside = 0;
  std::uint64_t trials = 0, state = 0;
  double cpu_s = 0.0, wall_s = 0.0;
  std::vector<sim::Voxel> nodes;  ///< of all plants
};

/// Segments that cross a voxel of the scene.
std::size_t segmentsInside(const sim::BitVolume& scene, const sim::Growth& growth) {
  std::size_t inside = 0;
  std::vector<sim::Voxel> voxels;
  for (const sim::Plant& plant : growth.plants) {
    const sim::Skeleton& s = plant.skeleton;
    for (std::size_t i = 1; i < s.parent.size(); ++i) {
      voxels.clear();
      sim::tileSegment(s.position_vx[static_cast<std::size_t>(s.parent[i])], s.position_vx[i], voxels);
      inside += std::any_of(voxels.begin(), voxels.end(), [&](sim::Voxel v) { return scene.at(v); });
    }
  }
  return inside;
}

/// Grows until there are so many segments, or nothing grows any more.
Grown growOn(sim::World& world, const rules::RuleSet& rules, double segments) {
  const sim::BitVolume scene = world.occupied();
  const std::vector<sim::Planting> plantings = {
      {"vine", rules::makeProcess(std::make_shared<rules::RuleSet>(rules), world.frame().voxel_m),
       seedsOn(world)}};
  Grown grown;
  sim::GrowthSettings settings = settingsFor();
  settings.progress = [&](const sim::GrowthProgress& progress) { grown.segments = progress.segments; };
  const double cpu_s = cpuSeconds();
  const auto began = std::chrono::steady_clock::now();
  sim::Growing growing(world, plantings, settings);
  while (static_cast<double>(grown.segments) < segments && growing.step()) {
  }
  grown.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  grown.cpu_s = cpuSeconds() - cpu_s;
  const sim::Growth growth = growing.take();
  for (const sim::Plant& plant : growth.plants) {
    grown.elements += plant.elements.size();
    for (const sim::Vec3 at : plant.skeleton.position_vx) grown.nodes.push_back(sim::voxelAt(at));
  }
  for (const std::uint64_t count : sim::total(growth).trials) grown.trials += count;
  grown.inside = segmentsInside(scene, growth);
  grown.state = sim::stateHash(world, growth);
  return grown;
}

/// The brightest spots of a table of the sky, from nodes all over a grown wall.
void addSkyTables(const sim::World& world, const Grown& grown, Report& report, const char* row) {
  constexpr std::size_t kTips = 600;
  std::vector<sim::Voxel> tips;
  for (std::size_t i = 0; i < kTips; ++i) tips.push_back(grown.nodes[i * grown.nodes.size() / kTips]);
  const sim::SkyTable table = settingsFor().sky_table();
  const sim::SkySensor sensor(world.opaque(), table);
  std::vector<sim::Vec3> ways(kTips);
  const double seconds = medianSeconds([&] {
    sim::ClearAhead clear;  // as if nothing were known of the iteration before
    const sim::SkyInside sky(sensor, world.opaque(), clear, &world.opaqueBricks());
    sim::parallelFor(kTips, 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ways[i] = sky.brightest(tips[i]);
    });
  });
  report.add({row, fmt::format("tables of the sky of {} cells from {} tips, ms", table.cells.size(), kTips),
              1e3 * seconds, "", grown.state, Target{10.0, false}});
}

}  // namespace

void benchSegments(double most_segments, Report& report) {
  constexpr const char* kRow = "5 growth";
  const rules::RuleSet figure_four = figureFour();
  report.title(
      "5. Growth on plain walls of 2 cm voxels, figure 4's rules (segments of 2.4 voxel widths, leaves), sky "
      "of "
      "128 and sun of 48 directions, light included");
  for (double segments = 1e4; segments <= most_segments; segments *= 10.0) {
    sim::World world = wallFor(segments);
    const Grown g = growOn(world, figure_four, segments);
    const auto count = static_cast<double>(g.segments);
    report.note(fmt::format("{} x {} x {} voxels: {} segments, {} leaves, {} trials", world.frame().size.x,
                            world.frame().size.y, world.frame().size.z, g.segments, g.elements, g.trials));
    report.add({kRow, "  segments a CPU second", count / g.cpu_s, "", g.state,
                Target{sim::lanes::level().starts_with("AVX3") ? 50'000.0 : 20'000.0}});
    report.add({kRow, "  trials a segment", static_cast<double>(g.trials) / count, "", g.state});
    report.add({kRow, "  segments that cross the wall", static_cast<double>(g.inside), "", g.state,
                Target{0.0, false}});
  }

  constexpr double kSegments = 3e4;
  const auto onOneThread = [&](const rules::RuleSet& rules) {
    sim::World world = wallFor(kSegments);
    Grown grown;
    sim::onThreads(1, [&] { grown = growOn(world, rules, kSegments); });
    return grown;
  };
  report.title("   The same wall of 30,000 segments in other ways");
  sim::World wall = wallFor(kSegments);
  const Grown all_threads = growOn(wall, figure_four, kSegments);
  const Grown one_thread = onOneThread(figure_four);
  const auto speed = [](const Grown& g) { return static_cast<double>(g.segments) / g.cpu_s; };
  report.add({kRow, fmt::format("{} threads: a second of one thread over theirs", sim::threadCount()),
              one_thread.wall_s / all_threads.wall_s, "times", all_threads.state});
  report.add({kRow, "one thread, segments a CPU second", speed(one_thread), "", one_thread.state});
  const Grown everything = onOneThread(withEverything(figure_four));
  report.add({kRow, "every bias and requirement, segments of 2 to 8 voxel widths", speed(everything), "",
              everything.state});
  report.add({kRow, "  a trial's time over that of figure 4's",
              everything.cpu_s / static_cast<double>(everything.trials) *
                  static_cast<double>(one_thread.trials) / one_thread.cpu_s,
              "times", everything.state, Target{2.0, false}});
  const Grown turned = onOneThread(heliotropicAndShy(figure_four));
  report.add({kRow, "  a segment's time with heliotropism and neighbourhood over figure 4's",
              speed(one_thread) / speed(turned), "times", turned.state, Target{2.0, false}});
  addSkyTables(wall, all_threads, report, kRow);
  const std::string best = sim::lanes::level();
  for (const std::string& level : sim::lanes::levels()) {
    sim::lanes::useLevel(level);
    const Grown g = onOneThread(figure_four);
    report.add({kRow, fmt::format("segments a CPU second by {}", level), speed(g), "", g.state});
  }
  sim::lanes::useLevel(best);
  if (const auto ivy = ivyGenNodes()) {
    report.add({kRow, "IvyGen in Blender, one candidate a node: nodes a CPU second", ivy->nodes / ivy->cpu_s,
                "", 0});
  } else {
    report.note("  IvyGen: no blender here");
  }
}

}  // namespace espalier::bench
