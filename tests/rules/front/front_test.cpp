#include "rules/front/front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "rules/front/colonize.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "tests/rules/front/points.h"

namespace espalier {
namespace {

using rules::Acts;
using rules::colonize;
using rules::Colony;
using rules::FrontRules;
using sim::Vec3;

const FrontRules kRules{0.1, 1.0, 0.15};

std::vector<Vec3> crown(int count) {
  return tests::inBox(11, count, {0, 3, 0}, {2, 2, 2});
}
const std::vector<Vec3> kStart{{0, 0.5, 0}};

TEST(Front, IsAnOutTree) {
  const Colony colony = colonize(crown(3000), {{{0, 0.5, 0}, {1, 0.5, 0}}}, kRules, 1000);
  EXPECT_EQ(colony.fates.waiting, 0U);
  ASSERT_GT(colony.parent.size(), 1000U);
  std::size_t roots = 0;
  for (std::size_t n = 0; n < colony.parent.size(); ++n) {
    ASSERT_LT(colony.parent[n], static_cast<std::int32_t>(n));
    if (colony.parent[n] < 0) {
      ++roots;
      continue;
    }
    const auto p = static_cast<std::size_t>(colony.parent[n]);
    ASSERT_NEAR(glm::length(colony.position[n] - colony.position[p]), kRules.step, 1e-12);
    ASSERT_TRUE(colony.parent[p] < 0 || colony.born[n] > colony.born[p]);
  }
  EXPECT_EQ(roots, 2U);
}

TEST(Front, IsTheSameOnAnyNumberOfThreads) {
  const std::vector<Vec3> attractors = crown(20000);
  std::vector<Colony> colonies(3);
  const int threads[] = {1, 2, 5};
  for (std::size_t i = 0; i < 3; ++i) {
    const sim::Shaken shaken;
    sim::onThreads(threads[i], [&] { colonies[i] = colonize(attractors, kStart, kRules, 60); });
  }
  EXPECT_GT(colonies[0].position.size(), 5000U);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_EQ(colonies[0].position, colonies[i].position);
    EXPECT_EQ(colonies[0].parent, colonies[i].parent);
  }
}

TEST(Front, DoesNotDependOnTheOrderOfTheAttractors) {
  std::vector<Vec3> attractors = crown(2000);
  for (const Acts acts : {Acts::on_nearest_node, Acts::on_every_node}) {
    FrontRules rules = kRules;
    rules.acts = acts;
    const Colony one = colonize(attractors, kStart, rules, 200);
    std::reverse(attractors.begin(), attractors.end());
    std::rotate(attractors.begin(), attractors.begin() + 700, attractors.end());
    EXPECT_EQ(one.position, colonize(attractors, kStart, rules, 200).position);
    attractors.back().x += 0.01;  // the control
    EXPECT_NE(one.position, colonize(attractors, kStart, rules, 200).position);
  }
}

std::vector<Vec3> scaled(std::vector<Vec3> places, double by) {
  for (Vec3& at : places) at *= by;
  return places;
}

TEST(Front, ScalesWithItsInputs) {
  const Colony one = colonize(crown(3000), kStart, kRules, 300);
  for (const double by : {1024.0, 1000.0}) {
    const Colony other = colonize(scaled(crown(3000), by), scaled(kStart, by),
                                  {kRules.step * by, kRules.influence * by, kRules.kill * by}, 300);
    ASSERT_EQ(one.parent, other.parent);
    if (by == 1024.0) {
      EXPECT_EQ(scaled(one.position, by), other.position);
    } else {
      for (std::size_t n = 0; n < one.position.size(); ++n)
        ASSERT_LT(glm::length(one.position[n] - other.position[n] / by), 1e-5 * kRules.step);
    }
  }
}

std::vector<Vec3> turned(std::vector<Vec3> places) {
  for (Vec3& at : places) at = {at.z, at.y, -at.x};
  return places;
}
std::vector<Vec3> tipped(std::vector<Vec3> places) {
  for (Vec3& at : places) at = {-at.y, at.z, at.x};
  return places;
}

TEST(Front, TurnsByARightAngleToTheBit) {
  const std::vector<Vec3> start{{0, 1.5, 0}};  // in reach, as a trunk knows what is up
  const Colony one = colonize(crown(3000), start, kRules, 300);
  EXPECT_EQ(turned(one.position), colonize(turned(crown(3000)), turned(start), kRules, 300).position);
  EXPECT_EQ(tipped(one.position), colonize(tipped(crown(3000)), tipped(start), kRules, 300).position);
}

TEST(Front, IsNotStalledByOppositeAttractors) {
  const Colony pair = colonize({{{-3, 0, 0}, {3, 0, 0}}}, {{{0, 0, 0}}}, {0.5, 10.0, 0.6}, 1000);
  EXPECT_EQ(pair.fates.reached, 2U);
  EXPECT_LT(pair.iterations, 20);
  // Three that pull one node every way, and a step that is longer than the way.
  const Colony over =
      colonize({{{0.2, 0, 0}, {-0.2, 0, 0}, {0, 0.1, 0}}}, {{{0, 0, 0}}}, {1.0, 10.0, 0.01}, 1000);
  EXPECT_EQ(over.fates.waiting, 0U);
  EXPECT_EQ(over.fates.given_up, 3U);
  EXPECT_LT(over.iterations, 10);
}

TEST(Front, EndsWhateverTheRules) {
  for (std::uint64_t stream = 0; stream < 40; ++stream) {
    sim::Draws draws({stream}, sim::Purpose::custom);
    const FrontRules rules{draws.uniform(0.05, 1.5), draws.uniform(0.1, 5.0), draws.uniform(0.0, 1.0)};
    const Colony colony = colonize(tests::inBox(stream, 200, {0, 3, 0}, {2, 2, 2}), kStart, rules, 100'000);
    EXPECT_LT(colony.iterations, 2000) << rules.step << " " << rules.influence << " " << rules.kill;
  }
}

TEST(Front, GrowsATrunkUntilTheCrownIsInReach) {
  const std::vector<Vec3> high = tests::inBox(5, 100, {0, 20, 0}, {2, 2, 2});
  const Colony colony = colonize(high, {{{0, 0, 0}}}, {0.5, 1.5, 0.6}, 1000);
  EXPECT_GT(colony.fates.reached, 50U);
  for (std::size_t n = 1; n < 20; ++n) {
    EXPECT_EQ(colony.position[n].x, 0.0);
    EXPECT_EQ(colony.position[n].y, 0.5 * static_cast<double>(n));
  }
  // Beside it, it turns to it; below ground, down.
  const Colony beside = colonize(high, {{{30, 20, 0}}}, {0.5, 1.5, 0.6}, 1000);
  EXPECT_GT(beside.fates.reached, 50U);
  const Colony below =
      colonize(tests::inBox(5, 100, {0, -20, 0}, {2, 2, 2}), {{{0, 0, 0}}}, {0.5, 1.5, 0.6}, 1000);
  EXPECT_EQ(below.position[5], Vec3(0, -2.5, 0));
}

TEST(Front, StepsOntoAttractorsAndUsesEachOnce) {
  const std::vector<Vec3> attractors = crown(500);
  const Colony colony = colonize(attractors, kStart, {0.3, 1.5, 0.0, Acts::on_nearest_node, true}, 1000);
  EXPECT_EQ(colony.fates.taken, 500U);
  std::vector<Vec3> stood(colony.position.begin() + 1, colony.position.end()), all = attractors;
  const auto before = [](Vec3 a, Vec3 b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  std::erase_if(stood, [](Vec3 at) { return at.x == 0.0 && at.z == 0.0; });  // the trunk
  std::sort(stood.begin(), stood.end(), before);
  std::sort(all.begin(), all.end(), before);
  EXPECT_EQ(stood, all);
}

TEST(Front, AnAttractorThatIsLetGoIsTakenByTheNextNode) {
  const std::vector<Vec3> attractors{{0, 1, 0}};
  rules::Front front = rules::frontOf(attractors);
  const FrontRules rules{0.5, 2.0, 0.1};
  rules::join(front, {{rules::NewNode{kStart[0]}}}, rules);
  ASSERT_EQ(front.pulls.count[0], 1);
  rules::giveUp(front, 0, rules);
  EXPECT_EQ(front.pulls.count[0], 0);
  EXPECT_EQ(front.pulls.y[0], 0);
  rules::join(front, {{rules::NewNode{Vec3(0, 0, 0)}}}, rules);  // farther than the first, but it comes
  EXPECT_EQ(front.pulls.count[1], 1);
  // Where none can come to it, it is given up.
  for (std::int32_t node = 1; node < rules::kMostLetGo; ++node) {
    rules::giveUp(front, node, rules);
    rules::join(front, {{rules::NewNode{kStart[0]}}}, rules);
  }
  EXPECT_EQ(rules::fatesOf(front.attractors.fate).given_up, 1U);
  EXPECT_EQ(front.pulls.count.back(), 0);
}

TEST(Front, RefusesWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto grow = [](std::vector<Vec3> attractors, std::vector<Vec3> starts, FrontRules rules) {
    return colonize(attractors, starts, rules, 10);
  };
  EXPECT_THROW(grow({}, kStart, kRules), sim::InputError);
  EXPECT_THROW(grow(crown(3), {}, kRules), sim::InputError);
  EXPECT_THROW(grow({{nan, 0, 0}}, kStart, kRules), sim::InputError);
  EXPECT_THROW(grow(crown(3), kStart, {0.0, 1.0, 0.1}), sim::InputError);
  EXPECT_THROW(grow(crown(3), kStart, {-1.0, 1.0, 0.1}), sim::InputError);
  EXPECT_THROW(grow(crown(3), kStart, {1.0, nan, 0.1}), sim::InputError);
  EXPECT_THROW(grow(crown(3), kStart, {1.0, 1.0, -0.1}), sim::InputError);
  EXPECT_NO_THROW(grow(crown(3), kStart, {1.0, std::numeric_limits<double>::infinity(), 0.1}));
}

}  // namespace
}  // namespace espalier
