#include "sim/base/nearest.h"

#include <gtest/gtest.h>

#include <random>

namespace espalier::sim {
namespace {

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
