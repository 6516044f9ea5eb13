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

std::optional<Voxel> byAsking(const BitVolume& volume, Voxel from) {
  std::optional<Voxel> best;
  const auto distance = [&](Voxel v) {
    const Voxel way = v - from;
    return way.x * way.x + way.y * way.y + way.z * way.z;
  };
  for (int y = 0; y < volume.size().y; ++y) {
    for (int z = 0; z < volume.size().z; ++z) {
      for (int x = 0; x < volume.size().x; ++x) {
        const Voxel v(x, y, z);
        if (volume.at(v) && (!best || distance(v) < distance(*best))) best = v;
      }
    }
  }
  return best;
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

TEST(NearestSet, IsTheOneThatAskingAllOfThemFinds) {
  std::mt19937 random(3);
  const Voxel size(150, 23, 31);
  const auto below = [&](int most) { return static_cast<int>(random() % static_cast<unsigned>(most)); };
  const auto somewhere = [&] { return Voxel(below(size.x), below(size.y), below(size.z)); };
  for (const int count : {1, 5, 200, 9000}) {
    BitVolume volume(size);
    for (int i = 0; i < count; ++i) volume.set(somewhere());
    for (int i = 0; i < 25; ++i) {
      const Voxel from = somewhere();
      EXPECT_EQ(nearestSet(volume, from), byAsking(volume, from)) << count << ' ' << i;
    }
  }
}

TEST(NearestSet, IsThereOrNot) {
  BitVolume volume({70, 5, 6});
  EXPECT_FALSE(nearestSet(volume, {3, 2, 1}));
  volume.set({69, 4, 5});
  EXPECT_EQ(nearestSet(volume, {0, 0, 0}), Voxel(69, 4, 5));
  EXPECT_EQ(nearestSet(volume, {69, 4, 5}), Voxel(69, 4, 5));
}

}  // namespace
}  // namespace espalier::sim
