#include "sim/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace espalier {
namespace {

using sim::Draws;
using sim::Purpose;
using sim::Vec3;

// Random123's known-answer vector for Philox4x32-10 with counter and key 0.
TEST(Random, IsPhilox) {
  Draws draws({0, 0, 0, 0}, static_cast<Purpose>(0));
  EXPECT_EQ(draws.bits(), 0x6627e8d5u);
  EXPECT_EQ(draws.bits(), 0xe169c58du);
  EXPECT_EQ(draws.bits(), 0xbc57ac4cu);
  EXPECT_EQ(draws.bits(), 0x9b00dbd8u);
}

TEST(Random, EveryPartOfTheKeyCounts) {
  std::set<std::uint32_t> first;
  const auto add = [&](sim::RandomKey key, Purpose purpose, std::uint32_t trial) {
    first.insert(Draws(key, purpose, trial).bits());
  };
  add({1, 0, 0, 0}, Purpose::tip, 0);
  add({1ull << 40, 0, 0, 0}, Purpose::tip, 0);
  add({1, 1, 0, 0}, Purpose::tip, 0);
  add({1, 0, 1, 0}, Purpose::tip, 0);
  add({1, 0, 0, 1}, Purpose::tip, 0);
  add({1, 0, 0, 0}, Purpose::branch, 0);
  add({1, 0, 0, 0}, Purpose::tip, 1);
  add({1, 0, 0, 0}, Purpose::tip, 59'999);
  EXPECT_EQ(first.size(), 8u);
}

TEST(Random, WholeNumbersCoverTheirRangeEvenly) {
  Draws draws({3, 1, 4, 1}, Purpose::tip);
  int count[3] = {};
  for (int i = 0; i < 3000; ++i) {
    const int n = draws.whole(1, 3);
    ASSERT_GE(n, 1);
    ASSERT_LE(n, 3);
    ++count[n - 1];
  }
  for (const int c : count) EXPECT_NEAR(c, 1000, 120);  // 4 sigma
}

TEST(Random, TheSphereIsEven) {
  Draws draws({2, 7, 1, 8}, Purpose::tip);
  Vec3 sum(0.0), squares(0.0);
  constexpr int kPoints = 3000;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 p = draws.onSphere();
    ASSERT_NEAR(glm::length(p), 1.0, 1e-12);
    sum += p;
    squares += p * p;
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(sum[axis] / kPoints, 0.0, 0.045);
    EXPECT_NEAR(squares[axis] / kPoints, 1.0 / 3.0, 0.025);
  }
}

TEST(Random, AConeHoldsItsPoints) {
  Draws draws({5, 5, 5, 5}, Purpose::tip);
  const Vec3 axis = glm::normalize(Vec3(1, 2, -2));
  double mean = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double c = glm::dot(draws.inCone(axis, 0.8), axis);
    ASSERT_GE(c, 0.8 - 1e-12);
    mean += c / 2000.0;
  }
  EXPECT_NEAR(mean, 0.9, 0.006);  // a cap is even in height
}

}  // namespace
}  // namespace espalier
