#include "tests/rules/front/definition.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/rules/front/points.h"

namespace espalier {
namespace {

using rules::Acts;
using rules::FrontRules;
using sim::Vec3;

void expectTheDefinition(const std::vector<Vec3>& attractors, const std::vector<Vec3>& starts,
                         const FrontRules& rules, int iterations, std::size_t least = 2,
                         const std::vector<int>& waves = {}, std::size_t least_joins = 0) {
  const rules::Colony fast = rules::colonize(attractors, starts, rules, iterations, waves);
  tests::Definition plain(attractors, starts, rules, waves);
  int done = 0;
  while (done < iterations && plain.step()) ++done;
  ASSERT_EQ(fast.position.size(), plain.nodes.size()) << "after " << fast.iterations << " and " << done;
  for (std::size_t n = 0; n < plain.nodes.size(); ++n) {
    ASSERT_EQ(fast.position[n], plain.nodes[n]) << "node " << n << " of " << plain.nodes.size();
    ASSERT_EQ(fast.parent[n], plain.parent[n]) << "node " << n;
    ASSERT_EQ(fast.joins[n], plain.joins[n]) << "node " << n;
  }
  EXPECT_GE(plain.nodes.size() -
                static_cast<std::size_t>(std::count(plain.joins.begin(), plain.joins.end(), rules::kNobody)),
            least_joins);
  EXPECT_GE(plain.nodes.size(), least);
  std::size_t waiting = static_cast<std::size_t>(std::count(plain.waits.begin(), plain.waits.end(), true));
  for (const int wave : waves) waiting += wave > plain.wave ? 1 : 0;
  EXPECT_EQ(fast.fates.waiting, waiting);
}

const Vec3 kCrown{0, 5, 0}, kHalf{3, 3, 3};

TEST(FrontDefinition, IsMetNodeForNode) {
  for (const int count : {1, 2, 3, 10, 60, 400}) {
    for (std::uint64_t stream = 0; stream < 3; ++stream) {
      SCOPED_TRACE(::testing::Message() << count << " attractors, stream " << stream);
      expectTheDefinition(tests::inBox(stream, count, kCrown, kHalf), {{0, 0, 0}}, {0.2, 2.5, 0.3}, 300);
    }
  }
}

TEST(FrontDefinition, IsMetByTwoThousandAttractors) {
  expectTheDefinition(tests::inBox(7, 2000, kCrown, kHalf), {{0, 1, 0}}, {0.2, 1.5, 0.25}, 200, 2500);
}

TEST(FrontDefinition, IsMetByTreesThatCompete) {
  expectTheDefinition(tests::inBox(1, 500, kCrown, kHalf), {{-2, 0, 0}, {2, 0, 0}, {0, 9, 1}},
                      {0.25, 1.5, 0.3}, 200, 500);
}

// Where a step is longer than twice the kill distance, attractors can be stepped over to and fro.
TEST(FrontDefinition, IsMetWhereStepsAreTooLong) {
  for (const double kill : {0.0, 0.05, 0.2})
    expectTheDefinition(tests::inBox(2, 150, kCrown, kHalf), {{0, 0, 0}}, {0.6, 3.0, kill}, 400, 300);
}

TEST(FrontDefinition, IsMetInEachReading) {
  const std::vector<Vec3> attractors = tests::inBox(3, 120, kCrown, kHalf);
  for (const Acts acts : {Acts::on_nearest_node, Acts::on_every_node}) {
    for (const bool onto : {false, true}) {
      for (const bool repeated : {false, true}) {
        if (acts == Acts::on_every_node && repeated && !onto) continue;  // too many: below
        SCOPED_TRACE(::testing::Message() << "every " << (acts == Acts::on_every_node) << " onto " << onto
                                          << " repeated " << repeated);
        expectTheDefinition(attractors, {{0, 0, 0}, {1, 1, 0}}, {0.3, 2.0, 0.35, acts, onto, repeated}, 200,
                            90);
      }
    }
  }
  expectTheDefinition(tests::inBox(4, 8, kCrown, kHalf), {{0, 0, 0}},
                      {0.5, 4.0, 0.5, Acts::on_every_node, false, true}, 25, 100);
}

std::vector<int> wavesOf(std::size_t count, std::size_t in_first, std::size_t in_second) {
  std::vector<int> waves(count, 2);
  std::fill_n(waves.begin(), in_first + in_second, 1);
  std::fill_n(waves.begin(), in_first, 0);
  return waves;
}

// Where attractors pull all around them, in space and in a plane.
TEST(FrontDefinition, IsMetByVeinsThatMeet) {
  for (std::uint64_t stream = 0; stream < 3; ++stream) {
    for (const double height : {3.0, 0.0}) {
      SCOPED_TRACE(::testing::Message() << "stream " << stream << ", height " << height);
      const auto attractors = tests::inBox(stream, 60, {0, 3, 0}, {3, height, 3});
      for (const double kill : {0.15, 0.3}) {
        FrontRules rules{0.25, 4.0, kill, Acts::on_all_neighbours};
        expectTheDefinition(attractors, {{0, 0, 0}, {0.4, 1, 0}}, rules, 80, 100, {}, 10);
      }
    }
  }
}

TEST(FrontDefinition, IsMetByAttractorsThatComeInWaves) {
  const auto attractors = tests::inBox(5, 80, {0, 3, 0}, {3, 0, 3});
  const std::vector<int> waves = wavesOf(80, 10, 20);
  for (const Acts acts : {Acts::on_nearest_node, Acts::on_all_neighbours})
    expectTheDefinition(attractors, {{0, 2, 0}}, {0.25, 5.0, 0.3, acts}, 120, 100, waves);
}

// On a lattice many are equally near.
TEST(FrontDefinition, IsMetWhereManyAreEquallyNear) {
  std::vector<Vec3> lattice;
  for (int x = -4; x <= 4; ++x) {
    for (int y = 1; y <= 6; ++y) {
      for (int z = -4; z <= 4; ++z) lattice.emplace_back(x, y, z);
    }
  }
  for (const Acts acts : {Acts::on_nearest_node, Acts::on_every_node})
    expectTheDefinition(lattice, {{0, 0, 0}, {0.5, 0, 0}}, {0.5, 2.5, 0.5, acts}, 100, 400);
}

}  // namespace
}  // namespace espalier
