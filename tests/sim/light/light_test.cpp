#include "sim/light/light.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/light/sky.h"
#include "sim/light/sun.h"
#include "sim/sweep/sweep.h"
#include "tests/support/bit_worlds.h"

namespace espalier {
namespace {

using sim::Voxel;

TEST(Light, IsTheSameEveryWay) {
  const auto bits = tests::randomBits({61, 40, 53}, 0.01, 11);
  const sim::LightSensor sensor(
      bits, {sim::makeSky({.directions = 90}).directions, sim::makeSun(sim::SunArc{}).directions});
  std::mt19937 random(3);
  std::vector<Voxel> places{{0, 0, 0}, {60, 39, 52}, {0, 0, 0}};
  for (int i = 0; i < 500; ++i)
    places.emplace_back(static_cast<int>(random() % 61), static_cast<int>(random() % 40),
                        static_cast<int>(random() % 53));
  const auto rays = sensor.byRays(bits, places);
  sim::ClearAhead ahead;
  for (const auto& other : {sensor.bySweep(bits, places), sensor.byOpenRays(bits, places, ahead)}) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      ASSERT_EQ(rays[i].sky.sum, other[i].sky.sum);
      ASSERT_EQ(rays[i].sun.sum, other[i].sun.sum);
      ASSERT_EQ(rays[i].sky.toward, other[i].sky.toward);
      ASSERT_EQ(rays[i].sun.toward, other[i].sun.toward);
    }
  }
  for (std::size_t i = 0; i < 50; ++i) {
    const sim::Outlook plain = sim::lookOut(bits, places[i], sim::makeSky({.directions = 90}).directions);
    ASSERT_EQ(rays[i].sky.sum, plain.sum);
    ASSERT_EQ(rays[i].sky.toward, plain.toward);
  }
}

/// Whether two answers are the same to the last bit.
bool same(const std::vector<sim::Light>& a, const std::vector<sim::Light>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const sim::Light& one, const sim::Light& other) {
                      return one.sky.sum == other.sky.sum && one.sky.toward == other.sky.toward &&
                             one.sun.sum == other.sun.sum && one.sun.toward == other.sun.toward;
                    });
}

// A plant grows in an open world, and few places or many ask: whatever way is taken then, and whoever keeps
// the bricks, the answer is that of the rays.
TEST(Light, OfAWorldThatFillsIsThatOfItsRays) {
  const Voxel size(330, 290, 310);
  sim::BitVolume bits(size);
  tests::addBox(bits, {0, 0, 0}, {size.x - 1, 2, size.z - 1});
  tests::addBox(bits, {60, 3, 150}, {65, 200, 309});
  sim::Bricks filled(bits);
  const sim::LightSensor sensor(
      bits, {sim::makeSky({.directions = 64}).directions, sim::makeSun(sim::SunArc{}).directions});
  std::mt19937 random(5);
  const auto inCrown = [&] {
    const auto around = [&](int middle) { return middle - 90 + static_cast<int>(random() % 180); };
    return Voxel(around(160), around(150), around(155));
  };
  sim::ClearAhead kept, scanned;
  for (const int count : {1, 3, 60, 1, 2, 40, 5, 0, 300}) {
    std::vector<Voxel> places;
    for (int i = 0; i < count; ++i) places.push_back(inCrown());
    const auto rays = sensor.byRays(bits, places);
    ASSERT_TRUE(same(sensor.at(bits, places, kept, &filled), rays)) << count;
    ASSERT_TRUE(same(sensor.at(bits, places, scanned), rays)) << count;
    EXPECT_EQ(kept.known(), scanned.known());
    for (int i = 0; i < 5 * count; ++i) {
      const Voxel v = inCrown();
      bits.set(v);
      filled.add(v);
    }
  }
  EXPECT_TRUE(kept.known());
}

TEST(Light, IsWhateverTheMapSays) {
  const auto bits = tests::randomBits({33, 21, 18}, 0.02, 12);
  const auto sky = sim::makeSky({.directions = 64}).directions;
  const sim::LightSensor sensor(bits, {sky, {}});
  const Voxel few[] = {{4, 5, 6}};
  const auto map = sim::sweepExposure(bits, sky);
  sim::ClearAhead ahead;
  EXPECT_EQ(sensor.at(bits, few, ahead)[0].sky.sum, map.values[map.index(few[0])]);
}

}  // namespace
}  // namespace espalier
