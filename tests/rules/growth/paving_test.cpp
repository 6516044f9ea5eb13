#include "rules/growth/diffusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/parallel.h"
#include "tests/support/laid_grounds.h"

namespace espalier::rules {
namespace {

using namespace tests;
using sim::Vec3;

TEST(Paving, FillsAFloorAroundWhatStandsThere) {
  LaidGround ground({sheet(5.0, 4.0), box({1.03, 0, 0.9}, {2.1, 0.2, 1.77}, "kerb"),
                     box({3.2, 0, 2.5}, {4.11, 0.3, 3.4}, "kerb")});
  RuleSet rules = paving();
  rules.regions["kerb"] = {true, nullptr};
  const sim::Growth growth = ground.grow(rules, {{2.6, 0.1, 2.0}});
  expectNoCrossing(growth);
  const LaidMeasure measure = measured(ground, rules, growth);
  const double beds_m2 = 1.07 * 0.87 + 0.91 * 0.9;
  EXPECT_NEAR(measure.surface_vx2 * kLaidVoxel_m * kLaidVoxel_m, 20.0 - beds_m2, 0.5);
  EXPECT_GT(measure.covered_vx2, 0.8 * measure.surface_vx2);
  EXPECT_NEAR(measure.joints.mean_vx, 0.2, 0.02);
  EXPECT_LT(measure.joints.deviation_vx, 0.05);
  EXPECT_GT(measure.joints.length_vx, 0.6 * measure.joints.rims_vx);
  // Nothing in the kerbs or over the edge; every slab on the floor.
  const sim::Frame& frame = ground.world.frame();
  for (const auto& corners : footprints(growth)) {
    for (const Vec3 corner : corners) {
      const Vec3 at_m = sim::worldFromVoxel(frame, corner);
      const double off_m = rules.diffusion.off.number * kLaidVoxel_m + 1e-9;
      EXPECT_NEAR(at_m.y, 0.0, 1e-6);
      EXPECT_TRUE(at_m.x > -off_m && at_m.x < 5.0 + off_m && at_m.z > -off_m && at_m.z < 4.0 + off_m);
      EXPECT_FALSE(at_m.x > 1.031 && at_m.x < 2.099 && at_m.z > 0.901 && at_m.z < 1.769);
    }
  }
}

TEST(Paving, LeavesTheSameJointEverywhere) {
  LaidGround ground({sheet(4.0, 4.0)});
  const RuleSet rules = paving();
  const sim::Growth growth = ground.grow(rules, {{2.0, 0.1, 2.0}});
  const auto feet = footprints(growth);
  double least = 1e9;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const auto flat = [](const std::vector<Vec3>& corners) {
        std::vector<glm::dvec2> points;
        for (const Vec3 c : corners) points.emplace_back(c.x, c.z);
        return hullOf(points);
      };
      least = std::min(least, distance(flat(feet[i]), flat(feet[k])));
    }
  }
  EXPECT_NEAR(least, 0.2, 3e-5);
  const LaidMeasure measure = measured(ground, rules, growth);
  EXPECT_NEAR(measure.joints.mean_vx, 0.2, 1e-4);
  EXPECT_LT(measure.joints.deviation_vx, 1e-3);
  EXPECT_GT(measure.covered_vx2, 0.85 * measure.surface_vx2);
}

TEST(Paving, GoesOnOverSeams) {
  // Two boxes side by side, in one plane: their sides are no walls, and their rims no end.
  LaidGround ground({box({0, -0.2, 0}, {2, 0, 1.5}, "floor"), box({0.4, -0.2, 1.5}, {1.6, 0, 3}, "floor")});
  const RuleSet rules = paving();
  const sim::Growth growth = ground.grow(rules, {{1.0, 0.1, 0.7}});
  const LaidMeasure measure = measured(ground, rules, growth);
  EXPECT_GT(measure.covered_vx2, 0.75 * measure.surface_vx2);
  bool across = false;
  for (const auto& corners : footprints(growth)) {
    double low = 1e9, high = -1e9;
    for (const Vec3 corner : corners) {
      const double z = sim::worldFromVoxel(ground.world.frame(), corner).z;
      low = std::min(low, z);
      high = std::max(high, z);
    }
    across = across || (low < 1.45 && high > 1.55);
  }
  EXPECT_TRUE(across);
}

TEST(Paving, NeedsNoGapAndTurnsByRightAngles) {
  RuleSet rules = paving();
  rules.elements = {slab("brick", 5.2, 2.6)};
  rules.diffusion.gap_min = {0.0};
  LaidGround without({sheet(3.0, 3.0)});
  const sim::Growth close = without.grow(rules, {{1.5, 0.1, 1.5}});
  expectNoCrossing(close);
  LaidMeasure measure = measured(without, rules, close);
  EXPECT_GT(measure.covered_vx2, 0.85 * measure.surface_vx2);
  rules.diffusion.gap_min = {0.2};
  rules.diffusion.turn_deg = 180.0;
  for (const double step_deg : {90.0, 0.0}) {
    LaidGround ground({sheet(3.0, 3.0)});
    rules.diffusion.turn_step_deg = step_deg;
    const sim::Growth growth = ground.grow(rules, {{1.5, 0.1, 1.5}});
    expectNoCrossing(growth);
    measure = measured(ground, rules, growth);
    EXPECT_GT(measure.covered_vx2, (step_deg > 0.0 ? 0.7 : 0.35) * measure.surface_vx2) << step_deg;
  }
}

TEST(Paving, BeginsBesideASeedThatHasNoRoom) {
  LaidGround ground({sheet(3.0, 3.0), box({-0.2, 0, 0}, {0, 1.0, 3.0}, "wall")});
  RuleSet rules = paving();
  rules.regions["wall"] = {true, nullptr};
  const sim::Growth growth = ground.grow(rules, {{0.08, 0.1, 1.5}});
  EXPECT_GT(elementsOf(growth), 20u);
}

}  // namespace
}  // namespace espalier::rules
