#include "sim/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "sim/base/error.h"

namespace espalier {
namespace {

using sim::Draws;
using sim::Purpose;
using sim::RandomKey;
using sim::Slots;
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
  const auto add = [&](RandomKey key, Purpose purpose, unsigned item, unsigned trial) {
    first.insert(Slots(key, purpose, item, trial).bits(0));
  };
  add({1, 0, 0, 0}, Purpose::trial, 0, 0);
  add({1ull << 40, 0, 0, 0}, Purpose::trial, 0, 0);
  add({1, 1, 0, 0}, Purpose::trial, 0, 0);
  add({1, 1u << 31, 0, 0}, Purpose::trial, 0, 0);
  add({1, 0, 1, 0}, Purpose::trial, 0, 0);
  add({1, 0, 65'536, 0}, Purpose::trial, 0, 0);
  add({1, 0, (1u << 24) - 1, (1u << 24) - 1}, Purpose::trial, 0, 0);
  add({1, 0, 0, 1}, Purpose::trial, 0, 0);
  add({1, 0, 0, 0}, Purpose::element, 0, 0);
  add({1, 0, 0, 0}, Purpose::trial, 1, 0);
  add({1, 0, 0, 0}, Purpose::trial, 65'535, 0);
  add({1, 0, 0, 0}, Purpose::trial, 0, 1);
  add({1, 0, 0, 0}, Purpose::trial, 0, 65'535);
  EXPECT_EQ(first.size(), 13u);
}

TEST(Random, NoStreamRunsIntoAnother) {
  // The last number of every field's neighbours is still its own.
  std::set<std::uint32_t> numbers;
  for (const unsigned trial : {0u, 1u, 65'535u}) {
    for (const unsigned item : {0u, 1u, 65'535u}) {
      for (const auto purpose : {Purpose::trial, Purpose::branch_age}) {
        for (unsigned slot = 0; slot < Slots::kSlots; ++slot)
          numbers.insert(Slots({7, 3, 65'535, 9}, purpose, item, trial).bits(slot));
      }
    }
  }
  EXPECT_GT(numbers.size(),
            18u * Slots::kSlots - 10u);  // but for a chance of one in 25 that two fall together
  Draws draws({1, 2, 3, 4}, Purpose::trial);
  for (unsigned i = 0; i < Slots::kSlots; ++i) draws.bits();
  EXPECT_THROW(draws.bits(), sim::BrokenContract);
  EXPECT_THROW(Slots({}, Purpose::trial, 0, 65'536), sim::BrokenContract);
  EXPECT_THROW(Slots({}, Purpose::trial, 65'536, 0), sim::BrokenContract);
  EXPECT_THROW(Slots({0, 0, 1u << 24, 0}, Purpose::trial), sim::BrokenContract);
  EXPECT_THROW(Slots({0, 0, 0, 1u << 24}, Purpose::trial), sim::BrokenContract);
}

TEST(Random, ASlotHoldsTheSameNumberInAnyOrder) {
  Slots forth({5, 6, 7, 8}, Purpose::element, 2, 3), back = forth;
  std::vector<std::uint32_t> a(64), b(64);
  for (unsigned i = 0; i < 64; ++i) a[i] = forth.bits(i);
  for (unsigned i = 64; i-- > 0;) b[i] = back.bits(i);
  EXPECT_EQ(a, b);
}

TEST(Random, StreamsTellRunsPlantingsAndPlantsApart) {
  const std::set<std::uint64_t> streams = {sim::streamOf(1),          sim::streamOf(2),
                                           sim::streamOf(1, "ivy"),   sim::streamOf(1, "vine"),
                                           sim::streamOf(1, "", 1),   sim::streamOf(1, "ivy", 1),
                                           sim::streamOf(1, "ivy", 2)};
  EXPECT_EQ(streams.size(), 7u);
  EXPECT_EQ(sim::streamOf(1, "ivy", 2), sim::streamOf(1, "ivy", 2));
}

TEST(Random, WholeNumbersCoverTheirRangeEvenly) {
  int count[3] = {};
  for (unsigned i = 0; i < 3000; ++i) {
    const int n = Draws({3, 1, 4, 1}, Purpose::trial, 0, i).whole(1, 3);
    ASSERT_GE(n, 1);
    ASSERT_LE(n, 3);
    ++count[n - 1];
  }
  for (const int c : count) EXPECT_NEAR(c, 1000, 120);  // 4 sigma
}

TEST(Random, TheSphereIsEven) {
  Vec3 sum(0.0), squares(0.0);
  constexpr unsigned kPoints = 3000;
  for (unsigned i = 0; i < kPoints; ++i) {
    const Vec3 p = Draws({2, 7, 1, 8}, Purpose::trial, 0, i).onSphere();
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
  const Vec3 axis = glm::normalize(Vec3(1, 2, -2));
  double mean = 0.0;
  for (unsigned i = 0; i < 2000; ++i) {
    const double c = glm::dot(Draws({5, 5, 5, 5}, Purpose::trial, 0, i).inCone(axis, 0.8), axis);
    ASSERT_GE(c, 0.8 - 1e-12);
    mean += c / 2000.0;
  }
  EXPECT_NEAR(mean, 0.9, 0.006);  // a cap is even in height
}

TEST(Random, TheUnitCircleIsCosineAndSine) {
  for (int i = -4000; i <= 4000; ++i) {
    const double turns = i / 1000.0;
    const glm::dvec2 p = sim::unitCircle(turns);
    const double angle = 2.0 * std::numbers::pi * (turns - std::floor(turns));
    EXPECT_NEAR(p.x, std::cos(angle), 2e-15);
    EXPECT_NEAR(p.y, std::sin(angle), 2e-15);
    EXPECT_NEAR(glm::length(p), 1.0, 3e-16);
  }
  EXPECT_EQ(sim::unitCircle(0.25), glm::dvec2(0.0, 1.0));
  EXPECT_EQ(sim::unitCircle(0.5), glm::dvec2(-1.0, 0.0));
}

}  // namespace
}  // namespace espalier
