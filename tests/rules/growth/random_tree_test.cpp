#include "rules/growth/make_process.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/grow/grow.h"
#include "sim/sense/proximity.h"
#include "tests/support/crossings.h"
#include "tests/support/lively.h"
#include "tests/support/plain_tiling.h"
#include "tests/support/plots.h"

namespace espalier {
namespace {

using rules::RuleSet;
using sim::Outcome;
using sim::Vec3;
using sim::Voxel;

/// Greene's figure 4, with fewer trials.
RuleSet vine() {
  RuleSet rules;
  rules.name = "vine";
  rules.random_tree.wander_deg = 30.0;
  rules.random_tree.trials_min = 30;
  rules.random_tree.trials_max = 60;
  rules.bias.up = 0.08;
  rules.require.proximity_max = {3.0};
  rules.prefer = {true, {1.5}};
  rules.light = {0.8, 0.2, 1.8};
  rules::Element leaf;
  leaf.polygons = {{{0, .32, .04}, {-.23, .13, -.01}, {-.36, .44, -.11}, {-.24, .76, -.11}, {0, .99, -.06}},
                   {{0, .32, .04}, {0, .99, -.06}, {.28, .76, -.13}, {.41, .45, -.13}, {.25, .13, -.02}}};
  leaf.per_segment = 1.5;
  rules.elements = {leaf};
  return rules;
}

using tests::brightSettings;

sim::Growth growIn(sim::World& world, const RuleSet& rules, const std::vector<Vec3>& seeds,
                   sim::GrowthSettings s) {
  return sim::grow(world, tests::planting(world, rules, seeds), s);
}

std::size_t segments(const sim::Growth& growth) {
  std::size_t sum = 0;
  for (const auto& plant : growth.plants) sum += static_cast<std::size_t>(plant.skeleton.size()) - 1;
  return sum;
}

std::size_t leaves(const sim::Growth& growth) {
  std::size_t sum = 0;
  for (const auto& plant : growth.plants) sum += plant.elements.size();
  return sum;
}

std::uint64_t of(const sim::OutcomeCounts& counts, Outcome outcome) {
  return counts[static_cast<std::size_t>(outcome)];
}

const std::vector<Vec3> kBothSides = {{12, 2, 23}, {30, 2, 23}, {20, 2, 16}};

TEST(RandomTree, GrowsAlongTheWall) {
  sim::World world = tests::wallPlot();
  const auto growth = growIn(world, vine(), kBothSides, brightSettings(20));
  EXPECT_GT(segments(growth), 150u);
  EXPECT_GT(leaves(growth), 100u);
  for (const auto& plant : growth.plants) {
    for (std::size_t i = 1; i < plant.skeleton.parent.size(); ++i) {
      const Vec3 from = plant.skeleton.position_vx[static_cast<std::size_t>(plant.skeleton.parent[i])];
      EXPECT_NEAR(glm::distance(from, plant.skeleton.position_vx[i]), 2.4, 1e-3);
      EXPECT_LE(plant.skeleton.columns.at("proximity_vx")[i], 3.0f);
    }
  }
}

TEST(RandomTree, PrefersTheProximityThatItIsTold) {
  std::map<double, double> mean;
  for (const double wanted : {1.2, 1.9, 2.6}) {
    sim::World world = tests::wallPlot();
    RuleSet rules = vine();
    rules.prefer.proximity = {wanted};
    rules.elements.clear();
    const auto growth = growIn(world, rules, kBothSides, brightSettings(10));
    for (const auto& plant : growth.plants) {
      for (std::size_t i = 1; i < plant.skeleton.parent.size(); ++i) {
        mean[wanted] += plant.skeleton.columns.at("proximity_vx")[i] / static_cast<double>(segments(growth));
      }
    }
  }
  // Where the best places are taken the next best are: the mean leans to the middle.
  EXPECT_NEAR(mean[1.2], 1.2, 0.35);
  EXPECT_NEAR(mean[1.9], 1.9, 0.2);
  EXPECT_NEAR(mean[2.6], 2.6, 0.35);
}

TEST(RandomTree, NothingIntersectsButAtItsAttachment) {
  sim::World world = tests::wallPlot();
  const sim::BitVolume before = world.occupied();
  const auto growth = growIn(world, vine(), kBothSides, brightSettings(18));
  for (const auto& plant : growth.plants) {
    std::vector<Voxel> voxels;
    for (std::size_t i = 1; i < plant.skeleton.parent.size(); ++i) {
      voxels.clear();
      const Vec3 from = plant.skeleton.position_vx[static_cast<std::size_t>(plant.skeleton.parent[i])];
      sim::tileSegment(from, plant.skeleton.position_vx[i], voxels);
      for (const Voxel v : voxels) {
        EXPECT_FALSE(before.at(v));                   // never in the scene
        EXPECT_EQ(world.partAt(v), plant.stem_part);  // nor in another plant; its leaves give way
      }
    }
    std::vector<Voxel> tiled;
    for (const auto& e : plant.elements) {
      for (const auto& polygon : plant.shapes[0].polygons) {
        std::vector<Vec3> corners;
        for (const Vec3 c : polygon) corners.push_back(sim::placed(e, c));
        tiled.clear();
        tests::tilePolygon(corners, tiled);
        for (const Voxel v : tiled) {
          EXPECT_FALSE(before.at(v));
          EXPECT_TRUE(world.occupied().at(v));  // by whoever came first
        }
      }
    }
  }
  EXPECT_EQ(tests::crossings(growth.plants), 0u);
  EXPECT_EQ(tests::piercings(growth.plants), 0u);
}

TEST(RandomTree, TheSameBytesOnAnyNumberOfThreads) {
  std::set<std::uint64_t> hashes;
  for (const int threads : {1, 2, 5}) {
    sim::onThreads(threads, [&] {
      sim::World world = tests::wallPlot();
      const auto growth = growIn(world, vine(), kBothSides, brightSettings(20));
      hashes.insert(sim::stateHash(world, growth));
    });
  }
  ASSERT_EQ(hashes.size(), 1u);
  // The state itself, so that a change of behaviour, of compiler or of processor shows: change it on purpose
  // only.
  EXPECT_EQ(*hashes.begin(), 0x109d4dec9a73dc94u);
}

TEST(RandomTree, GrowsAlikeUnderGreenesRandomRays) {
  sim::World even_world = tests::wallPlot(), random_world = tests::wallPlot();
  auto s = brightSettings(20);
  const auto even = growIn(even_world, vine(), kBothSides, s);
  s.light.random_sky = sim::RandomSky{};
  const auto random = growIn(random_world, vine(), kBothSides, s);
  EXPECT_NE(sim::stateHash(even_world, even), sim::stateHash(random_world, random));
  for (std::size_t i = 0; i < even.plants.size(); ++i) {
    EXPECT_GT(random.plants[i].skeleton.size(), even.plants[i].skeleton.size() / 2);
    EXPECT_LT(random.plants[i].skeleton.size(), even.plants[i].skeleton.size() * 2);
    EXPECT_NEAR(random.plants[i].skeleton.columns.at("sky_exposure")[1],
                even.plants[i].skeleton.columns.at("sky_exposure")[1], 0.15f);
  }
}

TEST(RandomTree, AnotherSeedIsAnotherPlant) {
  std::set<std::uint64_t> hashes;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    sim::World world = tests::wallPlot();
    auto s = brightSettings(8);
    s.seed = seed;
    const auto growth = growIn(world, vine(), kBothSides, s);
    hashes.insert(sim::stateHash(world, growth));
  }
  EXPECT_EQ(hashes.size(), 3u);
}

TEST(RandomTree, PassingThroughEndsAtTheWorldsRim) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    sim::World world({Vec3(0.0), 0.04, {20, 20, 20}});
    RuleSet rules;
    rules.random_tree.length = {1.0};
    rules.random_tree.wander_deg = 180.0;
    rules.random_tree.branch_angle_deg = 90.0;
    rules.random_tree.trials_min = 15;
    rules.random_tree.trials_max = 30;
    rules.require.clear = false;
    sim::GrowthSettings s = brightSettings(60);
    s.seed = seed;
    const auto growth = growIn(world, rules, {{10, 1, 10}}, s);  // voxels beyond the rim would throw
    EXPECT_GT(segments(growth), 1000u);
    std::vector<Voxel> voxels;
    for (const auto& plant : growth.plants) {
      for (std::size_t i = 1; i < plant.skeleton.parent.size(); ++i) {
        const Vec3 from = plant.skeleton.position_vx[static_cast<std::size_t>(plant.skeleton.parent[i])];
        sim::tileSegment(from, plant.skeleton.position_vx[i], voxels);
        EXPECT_TRUE(sim::contains(world.frame().size, sim::voxelAt(plant.skeleton.position_vx[i])));
      }
    }
    EXPECT_TRUE(std::all_of(voxels.begin(), voxels.end(), [&](Voxel v) { return world.occupied().at(v); }));
  }
}

// The sun's arc leans to +z: behind the wall, at -z, there is less than 30 per cent.
TEST(RandomTree, StopsInTheDark) {
  RuleSet rules = vine();
  rules.require.exposure_min = 0.5;
  rules.elements.clear();  // so that nothing but the wall makes it dark
  sim::World world = tests::wallPlot();
  const auto growth = growIn(world, rules, {{12, 2, 23}, {20, 2, 16}}, brightSettings(15));
  EXPECT_GT(growth.plants[0].skeleton.size(), 40);
  EXPECT_LT(growth.plants[1].skeleton.size(), 10);
  EXPECT_GT(of(sim::total(growth).sites, Outcome::too_dark), 0u);
  for (const auto& plant : growth.plants) {  // nothing grew from a node that was too dark
    for (std::size_t i = 1; i < plant.skeleton.parent.size(); ++i)
      EXPECT_GE(plant.skeleton.columns.at("exposure")[i], 0.5f);
  }
}

TEST(RandomTree, LightMakesLeavesMoreAndLarger) {
  std::map<double, double> mean_scale, per_segment;
  for (const double boost : {1.0, 1.8}) {
    RuleSet rules = vine();
    rules.light.boost = boost;
    rules.elements[0].trials = 200;
    sim::World world = tests::wallPlot();
    const auto growth = growIn(world, rules, {{12, 2, 23}}, brightSettings(9));
    double scale = 0.0;
    for (const auto& e : growth.plants[0].elements) scale += e.scale;
    mean_scale[boost] = scale / static_cast<double>(leaves(growth));
    per_segment[boost] = static_cast<double>(leaves(growth)) / static_cast<double>(segments(growth));
  }
  EXPECT_NEAR(mean_scale[1.0], 1.0, 1e-9);
  EXPECT_GT(mean_scale[1.8], 1.3);
  EXPECT_GT(per_segment[1.8], 1.1 * per_segment[1.0]);
}

TEST(RandomTree, DimTipsRest) {
  RuleSet rules = vine();
  rules.light = {0.0, 1.0, 4.0};
  sim::World world = tests::wallPlot();
  const auto growth = growIn(world, rules, {{12, 2, 23}}, brightSettings(12));
  EXPECT_GT(of(sim::total(growth).sites, Outcome::resting), of(sim::total(growth).sites, Outcome::grown) / 4);
}

TEST(RandomTree, RegionsForbidOrRuleForThemselves) {
  {
    RuleSet rules = vine();
    rules.regions["brick"] = {true, nullptr};
    sim::World world = tests::wallPlot();
    const auto growth = growIn(world, rules, {{12, 2, 26}}, brightSettings(25));
    EXPECT_GT(of(sim::total(growth).sites, Outcome::forbidden), 0u);
    for (const Vec3 p : growth.plants[0].skeleton.position_vx) EXPECT_LT(p.y, 8.0);
  }
  {
    RuleSet bare = vine();
    bare.elements.clear();
    RuleSet rules = vine();
    rules.regions["brick"] = {false, std::make_shared<RuleSet>(bare)};
    sim::World world = tests::wallPlot();
    const auto growth = growIn(world, rules, {{12, 2, 23}}, brightSettings(15));
    for (const auto& e : growth.plants[0].elements) {
      const auto from = growth.plants[0].skeleton.parent[static_cast<std::size_t>(e.node)];
      const auto nearness = world.nearnessAt(
          sim::voxelAt(growth.plants[0].skeleton.position_vx[static_cast<std::size_t>(from)]));
      ASSERT_TRUE(nearness);
      EXPECT_EQ(world.part(nearness->part).region, "soil");
    }
  }
}

TEST(RandomTree, BranchesLeaveAtTheirAngleAndAge) {
  RuleSet rules = vine();
  rules.elements.clear();
  rules.random_tree.wander_deg = 0.0;
  rules.random_tree.branch_angle_deg = 60.0;
  rules.bias.up = 0.0;
  rules.require.proximity_max = {rules::kNoLimit};
  rules.prefer.has_proximity = false;
  sim::World world({Vec3(0.0), 0.04, {120, 120, 120}});
  auto s = brightSettings(7);
  const auto growth = growIn(world, rules, {{60, 60, 60}}, s);
  const auto& skeleton = growth.plants[0].skeleton;
  std::set<int> ages;
  int straight = 0, branches = 0;
  for (std::size_t i = 1; i < skeleton.parent.size(); ++i) {
    const auto parent = static_cast<std::size_t>(skeleton.parent[i]);
    if (skeleton.parent[parent] == sim::kNoNode) continue;
    const auto grandparent = static_cast<std::size_t>(skeleton.parent[parent]);
    const Vec3 before = glm::normalize(skeleton.position_vx[parent] - skeleton.position_vx[grandparent]);
    const Vec3 now = glm::normalize(skeleton.position_vx[i] - skeleton.position_vx[parent]);
    const double degrees = std::acos(std::clamp(glm::dot(before, now), -1.0, 1.0)) * 180.0 / 3.14159265358979;
    if (degrees < 1.0) {
      ++straight;
    } else {
      EXPECT_NEAR(degrees, 60.0, 1e-2);
      ++branches;
      ages.insert(skeleton.born[i] - skeleton.born[parent]);
    }
  }
  EXPECT_GT(straight, 5);
  EXPECT_GT(branches, 5);
  EXPECT_EQ(*ages.begin(), 1);
  EXPECT_LE(*ages.rbegin(), 3);
  EXPECT_GE(ages.size(), 2u);
}

TEST(RandomTree, UpBiasOfOneGrowsStraightUp) {
  RuleSet rules = vine();
  rules.elements.clear();
  rules.bias.up = 1.0;
  rules.require.proximity_max = {rules::kNoLimit};
  rules.random_tree.branch_age_min = rules.random_tree.branch_age_max = 100;
  sim::World world({Vec3(0.0), 0.04, {20, 60, 20}});
  const auto growth = growIn(world, rules, {{10, 2, 10}}, brightSettings(10));
  ASSERT_EQ(growth.plants[0].skeleton.size(), 11);
  EXPECT_NEAR(growth.plants[0].skeleton.position_vx.back().y, 2.0 + 10 * 2.4, 10.0 / 4096);
}

TEST(RandomTree, TwistWindsAboutTheCentreOfMass) {
  const auto turning = [](double twist) {
    RuleSet rules = vine();
    rules.elements.clear();
    rules.bias.up = 0.3;
    rules.bias.twist = twist;
    rules.random_tree.branch_age_min = rules.random_tree.branch_age_max = 100;
    sim::World world({Vec3(0.0), 0.04, {40, 90, 40}});
    tests::addBox(world, "column", {17, 0, 17}, {23, 89, 23});
    world.setLayers(4);
    const auto growth = growIn(world, rules, {{20, 2, 25}}, brightSettings(45));
    double turned = 0.0;
    const auto& p = growth.plants[0].skeleton.position_vx;
    for (std::size_t i = 1; i < p.size(); ++i) {
      const glm::dvec2 a(p[i - 1].x - 20, p[i - 1].z - 20), b(p[i].x - 20, p[i].z - 20);
      turned += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
    }
    return turned;
  };
  EXPECT_GT(std::abs(turning(0.2)), 3.0);        // at least half a turn
  EXPECT_LT(turning(0.2) * turning(-0.2), 0.0);  // the other sign, the other way
}

TEST(RandomTree, AFlatWorldStaysFlat) {
  RuleSet rules = vine();
  rules.elements.clear();
  rules.require.proximity_max = {rules::kNoLimit};
  rules.prefer.has_proximity = false;
  sim::World world({Vec3(0.0), 0.04, {60, 60, 1}});
  auto s = brightSettings(10);
  s.record_attempts = true;
  const auto growth = growIn(world, rules, {{30, 30, 0}}, s);
  EXPECT_GT(segments(growth), 20u);
  for (const auto& a : growth.attempts) EXPECT_EQ(a.to_vx.z, 0.0);
  const auto taken =
      std::count_if(growth.attempts.begin(), growth.attempts.end(), [](const auto& a) { return a.taken; });
  EXPECT_EQ(static_cast<std::size_t>(taken), segments(growth));
}

TEST(RandomTree, LengthsInMetresFollowTheVoxel) {
  RuleSet rules = vine();
  rules.random_tree.length = {0.12, true};
  sim::World world = tests::wallPlot();
  const auto growth = growIn(world, rules, {{12, 2, 23}}, brightSettings(3));
  EXPECT_NEAR(
      glm::distance(growth.plants[0].skeleton.position_vx[0], growth.plants[0].skeleton.position_vx[1]), 3.0,
      1e-3);
  rules.random_tree.length = {100.0, true};
  EXPECT_THROW(rules::makeProcess(std::make_shared<RuleSet>(rules), 0.04), sim::InputError);
}

TEST(RandomTree, SeedsInsideSomethingOrOutsideAreRefused) {
  sim::World world = tests::wallPlot();
  EXPECT_THROW(growIn(world, vine(), {{5, 0, 5}}, brightSettings(1)), sim::InputError);
  EXPECT_THROW(growIn(world, vine(), {{5, 500, 5}}, brightSettings(1)), sim::InputError);
}

TEST(RandomTree, StopsWhenAsked) {
  sim::World world = tests::wallPlot();
  std::stop_source source;
  auto s = brightSettings(50);
  s.stop = source.get_token();
  int iterations = 0;
  s.progress = [&](const sim::GrowthProgress&) {
    if (++iterations == 3) source.request_stop();
  };
  EXPECT_THROW(growIn(world, vine(), kBothSides, s), sim::Stopped);
  EXPECT_EQ(iterations, 3);
}

}  // namespace
}  // namespace espalier
