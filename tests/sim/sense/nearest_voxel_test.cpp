#include "sim/sense/nearest_voxel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/bit_worlds.h"

namespace espalier::sim {
namespace {

/// Told voxel by voxel.
std::optional<double> slowly(const BitVolume& bits, Voxel from, int most) {
  std::optional<double> nearest;
  for (int y = 0; y < bits.size().y; ++y) {
    for (int z = 0; z < bits.size().z; ++z) {
      for (int x = 0; x < bits.size().x; ++x) {
        if (!bits.at({x, y, z})) continue;
        const double distance = glm::length(Vec3(Voxel(x, y, z) - from));
        if (distance <= most) nearest = std::min(nearest.value_or(distance), distance);
      }
    }
  }
  return nearest;
}

TEST(NearestVoxel, IsTheOneThatLookingAtEveryVoxelFinds) {
  std::mt19937 random(3);
  for (const double chance : {0.0, 0.00005, 0.001, 0.05, 1.0}) {
    const Voxel size(150, 21, 34);
    const BitVolume bits = tests::randomBits(size, chance, 5);
    for (int i = 0; i < 60; ++i) {
      const auto within = [&](int length) {
        return static_cast<int>(random() % static_cast<unsigned>(length + 20)) - 10;
      };
      const Voxel from(within(size.x), within(size.y), within(size.z));
      const int most = i % 3 == 0 ? 200 : i % 3 == 1 ? 17 : 0;
      EXPECT_EQ(distanceToNearest(bits, from, most), slowly(bits, from, most))
          << from.x << ' ' << from.y << ' ' << from.z << " within " << most << " of " << chance;
    }
  }
}

TEST(NearestVoxel, LooksNoFartherThanItIsAsked) {
  BitVolume bits(Voxel(200, 3, 3));
  bits.set({150, 1, 1});
  EXPECT_EQ(distanceToNearest(bits, {10, 1, 1}, 140), 140.0);
  EXPECT_EQ(distanceToNearest(bits, {10, 1, 1}, 139), std::nullopt);
  EXPECT_EQ(distanceToNearest(bits, {150, 1, 1}, 0), 0.0);
}

}  // namespace
}  // namespace espalier::sim
