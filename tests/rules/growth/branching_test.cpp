#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/colonies.h"

/// Where limbs of colonization leave each other, and what their orders are.
namespace espalier {
namespace {

using sim::Vec3;
using tests::crown;
using tests::grown;
using tests::leafyTree;
using tests::open;
using tests::tree;

/// Angles in degrees between each segment and the one before it, of those that go on and of those that
/// branch.
struct Turns {
  std::vector<double> on, branch;
};
Turns turnsOf(const sim::Skeleton& skeleton) {
  Turns turns;
  std::vector<bool> sent(skeleton.parent.size());
  for (std::size_t n = 1; n < sent.size(); ++n) {
    const auto p = static_cast<std::size_t>(skeleton.parent[n]);
    const bool branches = sent[p];
    sent[p] = true;
    if (skeleton.parent[p] == sim::kNoNode) continue;
    const Vec3 before =
        skeleton.position_vx[p] - skeleton.position_vx[static_cast<std::size_t>(skeleton.parent[p])];
    const Vec3 now = skeleton.position_vx[n] - skeleton.position_vx[p];
    const double cosine = glm::dot(before, now) / glm::length(before) / glm::length(now);
    (branches ? turns.branch : turns.on)
        .push_back(std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / 3.14159265358979);
  }
  return turns;
}

TEST(Colonization, KeepsToItsBranchingAngles) {
  rules::RuleSet rules = tree();
  rules.colonization.branching.angle_min_deg = 35.0;
  rules.colonization.branching.angle_max_deg = 70.0;
  sim::World world = open();
  const sim::Growth growth = grown(world, rules, {{32, 2, 32}}, crown(600));
  const Turns turns = turnsOf(growth.plants[0].skeleton);
  ASSERT_GT(turns.branch.size(), 40U);
  EXPECT_GT(*std::min_element(turns.branch.begin(), turns.branch.end()), 35.0 - 1e-6);
  EXPECT_LT(*std::max_element(turns.branch.begin(), turns.branch.end()), 70.0 + 1e-6);
  EXPECT_LT(*std::max_element(turns.on.begin(), turns.on.end()), 70.0 + 1e-6);
  sim::World other = open();
  const Turns plain = turnsOf(grown(other, tree(), {{32, 2, 32}}, crown(600)).plants[0].skeleton);
  EXPECT_LT(*std::min_element(plain.branch.begin(), plain.branch.end()), 34.0);
  EXPECT_GT(*std::max_element(plain.branch.begin(), plain.branch.end()), 75.0);
}

TEST(Colonization, BranchesWhereItMay) {
  rules::RuleSet rules = tree();
  rules.colonization.branching.above = {20.0};
  rules.colonization.branching.most = 1;
  sim::World world = open();
  const sim::Growth growth = grown(world, rules, {{32, 2, 32}}, crown(600));
  const sim::Skeleton& skeleton = growth.plants[0].skeleton;
  std::vector<int> sent(skeleton.parent.size());
  for (std::size_t n = 1; n < sent.size(); ++n) ++sent[static_cast<std::size_t>(skeleton.parent[n])];
  std::size_t forks = 0;
  for (std::size_t n = 0; n < sent.size(); ++n) {
    if (skeleton.position_vx[n].y < 22.0) {
      EXPECT_LE(sent[n], 1);
    }
    EXPECT_LE(sent[n], 2);
    forks += sent[n] > 1 ? 1 : 0;
  }
  EXPECT_GT(forks, 20U);
}

TEST(Colonization, TellsTrunkBranchesAndTwigsApart) {
  rules::RuleSet rules = tree(), branches = tree(), twigs = leafyTree();
  branches.colonization.step = {1.5};
  twigs.colonization.step = {1.0};
  twigs.bias = {};
  rules.branches = std::make_shared<rules::RuleSet>(branches);
  rules.twigs = std::make_shared<rules::RuleSet>(twigs);
  sim::World world = open();
  const sim::Growth growth = grown(world, rules, {{32, 2, 32}}, crown(300));
  const sim::Plant& plant = growth.plants[0];
  const std::vector<float>& order = *sim::find(plant.skeleton, "order");
  std::array<int, 3> count{};
  std::vector<bool> sent(order.size());
  for (std::size_t n = 1; n < order.size(); ++n) {
    const auto p = static_cast<std::size_t>(plant.skeleton.parent[n]);
    EXPECT_EQ(order[n], order[p] + (sent[p] ? 1.0f : 0.0f));
    sent[p] = true;
    const double step = glm::distance(plant.skeleton.position_vx[n], plant.skeleton.position_vx[p]);
    const double expected[] = {2.0, 1.5, 1.0};
    const auto o = static_cast<std::size_t>(std::min(2.0f, order[n]));
    EXPECT_NEAR(step, expected[o], 1e-3);
    ++count[o];
  }
  EXPECT_GT(count[0], 5);
  EXPECT_GT(count[1], 20);
  EXPECT_GT(count[2], 50);
  EXPECT_GT(plant.elements.size(), 20U);
  for (const sim::PlacedElement& leaf : plant.elements)
    EXPECT_GE(order[static_cast<std::size_t>(leaf.node)], 2.0f);
}

}  // namespace
}  // namespace espalier
