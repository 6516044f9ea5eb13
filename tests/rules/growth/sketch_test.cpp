#include <gtest/gtest.h>

#include <algorithm>

#include "rules/growth/apices.h"
#include "rules/growth/make_process.h"
#include "rules/growth/scene_lines.h"
#include "sim/grow/grow.h"
#include "sim/sense/peaks.h"
#include "sim/tile/build_world.h"
#include "tests/support/lively.h"
#include "tests/support/meshes.h"

/// What limbs make of lines, regions, ages and places.
namespace espalier::rules {
namespace {

using sim::Vec3;

/// Lines to follow in a world of so many voxels a side, voxel 1 m; each a region of its own.
sim::World sketch(const std::vector<std::pair<Vec3, Vec3>>& lines, int side = 64) {
  sim::TiledMesh tiled{tests::emptyMesh("sketch")};
  tiled.guide = true;
  tiled.mesh.regions.clear();
  for (const auto& [from, to] : lines) {
    tiled.lines.push_back({from, to, static_cast<std::uint32_t>(tiled.mesh.regions.size())});
    tiled.mesh.regions.push_back("line " + std::to_string(tiled.mesh.regions.size()));
  }
  return sim::buildWorld({Vec3(0.0), 1.0, sim::Voxel(side)}, {tiled}, 4);
}

/// The gist of the library's line tracker (rules/library/line_tracker.yaml).
RuleSet tracker() {
  RuleSet single;
  single.require.proximity_max = {0.3};
  single.prefer = {true, {0.0}};
  RuleSet fork = single;
  single.random_tree.wander_deg = 60.0;
  single.random_tree.length = {tests::range(1.4, 1.9)};
  single.random_tree.trials_min = single.random_tree.trials_max = 600;
  fork.random_tree.wander_deg = 125.0;
  fork.random_tree.length = {tests::range(4.5, 5.5)};
  fork.random_tree.fork_min = 2;
  fork.random_tree.fork_max = 5;
  fork.random_tree.fork_angle_deg = 45.0;
  fork.random_tree.trials_min = fork.random_tree.trials_max = 2500;
  fork.otherwise = std::make_shared<const RuleSet>(single);
  return fork;
}

sim::Plant grown(sim::World& world, const RuleSet& rules, Vec3 seed, int iterations = 200,
                 sim::Commons commons = {}) {
  sim::GrowthSettings settings = tests::brightSettings(iterations);
  settings.commons = std::move(commons);
  return sim::grow(world, tests::planting(world, rules, {seed}), settings).plants[0];
}

std::vector<int> limbsOf(const sim::Plant& plant) {
  std::vector<int> limbs(plant.skeleton.parent.size(), 0);
  for (const sim::NodeId parent : plant.skeleton.parent) {
    if (parent != sim::kNoNode) ++limbs[static_cast<std::size_t>(parent)];
  }
  return limbs;
}

Vec3 firstWay(const sim::Plant& plant) {
  const auto& at = plant.skeleton.position_vx;
  return at.size() < 2 ? Vec3(0.0) : glm::normalize(at[1] - at[0]);
}

TEST(Fork, BranchesWhereLinesForkAndNowhereElse) {
  for (const double angle : {-0.8, -0.5, 0.0, 0.4}) {
    sim::World world = sketch({{{32, 2, 32}, {32, 30, 32}},
                               {{32, 30, 32}, {54, 44 - 20 * angle, 32}},
                               {{32, 30, 32}, {10, 44 + 20 * angle, 40}}});
    const sim::Plant plant = grown(world, tracker(), {32, 3, 32});
    const std::vector<int> limbs = limbsOf(plant);
    int branchings = 0;
    for (std::size_t n = 0; n < limbs.size(); ++n) {
      if (limbs[n] < 2) continue;
      ++branchings;
      EXPECT_EQ(limbs[n], 2);
      EXPECT_LT(glm::distance(plant.skeleton.position_vx[n], Vec3(32, 30, 32)), 3.5) << angle;
    }
    EXPECT_EQ(branchings, 1) << angle;
  }
}

TEST(Fork, NothingGrowsWhereFewerLimbsFindRoom) {
  sim::World world = sketch({{{32, 2, 32}, {32, 60, 32}}});
  RuleSet alone = tracker();
  alone.otherwise = nullptr;
  EXPECT_EQ(grown(world, alone, {32, 3, 32}).skeleton.size(), 1);
}

TEST(Fork, NoTipForksSoonBehindAFork) {
  RuleSet star;
  star.random_tree.fork_min = 2;
  star.random_tree.fork_max = 3;
  star.random_tree.fork_angle_deg = 50.0;
  star.random_tree.wander_deg = 100.0;
  star.random_tree.length = {3.0};
  RuleSet single = star;
  single.random_tree.fork_min = single.random_tree.fork_max = 1;
  star.otherwise = std::make_shared<const RuleSet>(single);
  const auto leastApart = [&](int apart) {
    star.random_tree.fork_apart = apart;
    sim::World world({Vec3(0.0), 1.0, sim::Voxel(64)});
    const sim::Plant plant = grown(world, star, {32, 32, 32}, 7);
    const std::vector<int> limbs = limbsOf(plant);
    int least = 100;
    for (std::size_t n = 1; n < limbs.size(); ++n) {
      if (limbs[n] < 2) continue;
      int segments = 1;
      sim::NodeId at = plant.skeleton.parent[n];
      while (at != sim::kNoNode && limbs[static_cast<std::size_t>(at)] < 2) {
        at = plant.skeleton.parent[static_cast<std::size_t>(at)];
        ++segments;
      }
      if (at != sim::kNoNode) least = std::min(least, segments);
    }
    return least;
  };
  EXPECT_EQ(leastApart(0), 1);
  EXPECT_EQ(leastApart(2), 3);
  // What may lay one alone goes on by itself.
  star.random_tree.fork_min = 1;
  star.otherwise = nullptr;
  EXPECT_EQ(leastApart(0), 1);
  EXPECT_EQ(leastApart(2), 3);
}

TEST(Fork, LimbsOfOneForkWantNoVoxelOfEachOthers) {
  // Ahead of where the lines part, so that limbs would run side by side at first.
  sim::World world =
      sketch({{{32, 2, 32}, {32, 30, 32}}, {{32, 30, 32}, {44, 44, 32}}, {{32, 30, 32}, {20, 44, 32}}});
  RuleSet eager = tracker();
  eager.random_tree.fork_angle_deg = 8.0;
  eager.random_tree.fork_max = 8;
  eager.require.proximity_max = {0.6};
  const sim::Plant plant = grown(world, eager, {32, 3, 32}, 60);
  const sim::Skeleton& s = plant.skeleton;
  std::vector<std::vector<int>> born(s.parent.size());
  for (std::size_t n = 1; n < s.parent.size(); ++n)
    born[static_cast<std::size_t>(s.parent[n])].push_back(s.born[n]);
  int forks = 0;
  for (const std::vector<int>& limbs : born) {
    if (limbs.size() < 2) continue;
    ++forks;
    EXPECT_EQ(limbs.front(), limbs.back()) << "none had to wait for another";
  }
  EXPECT_GE(forks, 3);
}

TEST(Lines, AreSensedExactly) {
  sim::World world({Vec3(0.0), 0.5, sim::Voxel(64)});
  const std::vector<LineEnds> lines{{{10.2, 20.0, 30.4}, {50.2, 20.0, 30.4}}, {{40, 40, 40}, {40, 40, 40}}};
  const sim::Commons commons{{kSceneLines, columnsOf(lines)}};
  const LinesNear near(commons, {30, 24, 30}, 6.0);
  EXPECT_EQ(near.nearest({30, 23, 30.4}, 5.0), Vec3(30, 20, 30.4));
  EXPECT_EQ(near.nearest({8.2, 20, 30.4}, 5.0), Vec3(10.2, 20, 30.4)) << "no farther than its end";
  EXPECT_FALSE(near.nearest({30, 23, 30.4}, 3.0));
  EXPECT_EQ(LinesNear(commons, {40, 41, 40}, 2.0).nearest({40, 41, 40}, 2.0), Vec3(40, 40, 40));
  EXPECT_FALSE(LinesNear({}, {40, 41, 40}, 2.0).nearest({40, 41, 40}, 2.0));

  // A limb that must end by the line keeps to it.
  RuleSet rules;
  rules.random_tree.branch_age_min = rules.random_tree.branch_age_max = 1000;
  rules.random_tree.wander_deg = 180.0;
  rules.random_tree.length = {2.0};
  rules.senses = {{"line", SenseSpec::Measure::nearness, "lines", {1.0}}};
  rules.require.along = {{"line", 0.6, kNoLimit}};
  const sim::Plant plant = grown(world, rules, {11, 20, 30.4}, 12, commons);
  ASSERT_GT(plant.skeleton.size(), 4);
  for (const Vec3 at : plant.skeleton.position_vx)
    EXPECT_LT(glm::length(Vec3(0.0, at.y - 20.0, at.z - 30.4)), 0.4 + 1e-6);
  // And a bias by the distance leads there.
  RuleSet to = rules;
  to.require.along.clear();
  to.random_tree.wander_deg = 0.0;
  to.senses = {{"line", SenseSpec::Measure::distance, "lines", {12.0}}};
  to.bias.senses = {{"line", 1.0}};
  sim::World other({Vec3(0.0), 0.5, sim::Voxel(64)});
  const Vec3 way = firstWay(grown(other, to, {30, 26, 30.4}, 1, commons));
  EXPECT_NEAR(way.y, -1.0, 1e-3);
}

TEST(Fork, ManyLimbsLeaveOneNodeApart) {
  sim::World world({Vec3(0.0), 1.0, sim::Voxel(64)});
  RuleSet star;
  star.random_tree.fork_min = star.random_tree.fork_max = 5;
  star.random_tree.fork_angle_deg = 50.0;
  star.random_tree.wander_deg = 100.0;
  star.random_tree.length = {5.0};
  const sim::Plant plant = grown(world, star, {32, 32, 32}, 2);
  const sim::Skeleton& s = plant.skeleton;
  const std::vector<int> limbs = limbsOf(plant);
  EXPECT_EQ(limbs[0], 1) << "a seed has one site";
  const auto forked = std::find(limbs.begin() + 1, limbs.end(), 5);
  ASSERT_NE(forked, limbs.end());
  std::vector<Vec3> ways;
  for (std::size_t n = 1; n < limbs.size(); ++n) {
    if (s.parent[n] == forked - limbs.begin())
      ways.push_back(glm::normalize(s.position_vx[n] - s.position_vx[static_cast<std::size_t>(s.parent[n])]));
  }
  for (std::size_t i = 0; i < ways.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_LE(glm::dot(ways[i], ways[k]), 0.6428 + 1e-3);
  }
}

RuleSet straight(Vec3 way, double amount = 1.0) {
  RuleSet rules;
  rules.random_tree.branch_age_min = rules.random_tree.branch_age_max = 1000;
  rules.random_tree.wander_deg = 0.0;
  rules.bias.towards = {{std::nullopt, way, amount}};
  return rules;
}

TEST(Towards, LeadsAlongWaysAndToPlaces) {
  sim::World world({Vec3(10, 0, 0), 0.5, sim::Voxel(64)});
  EXPECT_NEAR(glm::dot(firstWay(grown(world, straight({3, 0, 4}), {32, 32, 32}, 1)), Vec3(0.6, 0, 0.8)), 1.0,
              1e-3);
  RuleSet to = straight({1, 0, 0});
  to.bias.towards = {{Vec3(10 + 0.5 * 60, 0.5 * 32, 0.5 * 32), std::nullopt, 1.0}};  // voxel (60, 32, 32)
  sim::World other({Vec3(10, 0, 0), 0.5, sim::Voxel(64)});
  EXPECT_NEAR(firstWay(grown(other, to, {32, 32, 32}, 1)).x, 1.0, 1e-3);
  to.bias.towards[0].amount = -1.0;
  sim::World third({Vec3(10, 0, 0), 0.5, sim::Voxel(64)});
  EXPECT_NEAR(firstWay(grown(third, to, {32, 32, 32}, 1)).x, -1.0, 1e-3);
}

TEST(Light, BelowZeroLeadsAwayFromIt) {
  sim::World world({Vec3(0.0), 0.04, sim::Voxel(40)});
  RuleSet rules = straight({1, 0, 0});
  rules.bias.towards.clear();
  rules.bias.light = -1.0;
  EXPECT_LT(firstWay(grown(world, rules, {20, 20, 20}, 1)).y, -0.99);
}

TEST(Apex, LimbsTurnAwayFromTheNearestOne) {
  sim::World world = sketch({{{4, 20, 32}, {16, 32, 32}}, {{16, 32, 32}, {28, 20, 32}}});
  const std::vector<sim::PartId> parts{1, 2};
  const sim::Commons commons{{kApices, columnsOf(sim::peaksOf(world, parts, 3))}};
  RuleSet rules = straight({1, 0, 0});
  rules.bias.towards.clear();
  rules.bias.apex = -1.0;
  const Vec3 seed(10, 24, 32);
  EXPECT_NEAR(
      glm::dot(firstWay(grown(world, rules, seed, 1, commons)), glm::normalize(seed - Vec3(16, 32, 32))), 1.0,
      0.02);
  rules.bias.apex = 1.0;
  rules.bias.apex_of = "line 1";  // whose top is beside
  sim::World again = sketch({{{4, 20, 32}, {16, 32, 32}}, {{16, 32, 32}, {28, 20, 32}}});
  EXPECT_GT(firstWay(grown(again, rules, seed, 1, commons)).y, 0.6);
  sim::World without = sketch({{{4, 20, 32}, {16, 32, 32}}});
  EXPECT_NE(firstWay(grown(without, rules, seed, 1)), Vec3(0.0))
      << "where nobody knows of one, nothing pulls";
}

TEST(Require, ALimbEndsAfterSoManySegmentsNearARegion) {
  sim::World world = sketch({{{32, 2, 32}, {32, 30, 32}}, {{32, 30, 32}, {32, 60, 32}}});
  RuleSet rules = straight({0, 1, 0});
  rules.regions["line 1"].rules = [&] {
    auto few = std::make_shared<RuleSet>(rules);
    few->require.in_region_max = 4;
    return few;
  }();
  const sim::Plant plant = grown(world, rules, {32, 3, 32});
  const auto second = std::count_if(plant.skeleton.position_vx.begin(), plant.skeleton.position_vx.end(),
                                    [](Vec3 at) { return at.y > 30.5; });
  EXPECT_EQ(second, 5) << "the node where the limb comes in, and four segments";
}

TEST(Require, AgesAreIterations) {
  const auto segments = [](int first, int last) {
    sim::World world({Vec3(0.0), 1.0, sim::Voxel(64)});
    RuleSet rules = straight({0, 1, 0});
    rules.require.age_min = first;
    rules.require.age_max = last;
    return grown(world, rules, {32, 3, 32}, 10).skeleton;
  };
  EXPECT_EQ(segments(0, 3).size(), 5);
  const sim::Skeleton late = segments(4, kNoAge);
  EXPECT_EQ(late.size(), 7);
  EXPECT_EQ(late.born[1], 4);
}

}  // namespace
}  // namespace espalier::rules
