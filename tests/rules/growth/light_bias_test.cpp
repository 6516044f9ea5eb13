#include <gtest/gtest.h>

#include "rules/growth/make_process.h"
#include "sim/grow/grow.h"
#include "sim/light/sky.h"
#include "tests/support/plots.h"

namespace espalier {
namespace {

using sim::Vec3;

/// The way of the first segment in a tunnel along x with an open end on either side, a little nearer to the
/// one at x = 60, where a limb grows straight to the light.
Vec3 wayInTunnel(rules::Brightest brightest) {
  sim::World world({Vec3(0.0), 0.04, {61, 24, 21}});
  tests::addBox(world, "floor", {0, 0, 0}, {60, 0, 20});
  tests::addBox(world, "wall", {0, 1, 0}, {60, 12, 1});
  tests::addBox(world, "wall", {0, 1, 19}, {60, 12, 20});
  tests::addBox(world, "roof", {0, 13, 0}, {60, 14, 20});
  rules::RuleSet rules;
  rules.bias.light = 1.0;
  rules.bias.brightest = brightest;
  const auto rule = rules::makeProcess(std::make_shared<rules::RuleSet>(rules), 0.04);
  sim::GrowthSettings settings;
  settings.iterations = 1;
  settings.light.sky = sim::makeSky({.directions = 1000}).directions;
  settings.sky_table = [] { return sim::makeSkyTable(18, 72, sim::backgroundOf(sim::Weighting::uniform)); };
  const auto growth =
      sim::grow(world, {{"vine", rule, sim::seedsAt(world.frame(), {sim::Vec3(31, 5, 10)})}}, settings);
  const auto& nodes = growth.plants[0].skeleton.position_vx;
  return nodes.size() < 2 ? Vec3(0.0) : glm::normalize(nodes[1] - nodes[0]);
}

TEST(LightBias, FollowsTheMomentBetweenTwoOpeningsAndTheTableToOne) {
  EXPECT_GT(wayInTunnel(rules::Brightest::table).x, 0.95);
  EXPECT_LT(wayInTunnel(rules::Brightest::moment).x, 0.8);
  EXPECT_GT(wayInTunnel(rules::Brightest::moment).y, 0.5);
}

}  // namespace
}  // namespace espalier
