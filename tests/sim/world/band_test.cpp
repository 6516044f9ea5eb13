#include "sim/world/band.h"

#include <gtest/gtest.h>

#include "tests/support/bit_worlds.h"
#include "tests/support/each_voxel.h"

namespace espalier::sim {
namespace {

int distance(Voxel a, Voxel b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

/// Rows shorter than a word, of just one, and of more than one.
class Band : public testing::TestWithParam<int> {
 protected:
  Voxel size_{GetParam(), 9, 11};
  std::vector<Voxel> stands_ = {
      {0, 0, 0}, {size_.x - 1, 4, 10}, {size_.x / 2, 8, 5}, {size_.x / 2 + 1, 8, 5}};
  World world_{Frame{Vec3(0.0), 1.0, size_}};
  void SetUp() override {
    const PartId part = world_.addPart({"stone", "all", PartKind::scene, -1});
    for (const Voxel v : stands_) {
      const TiledVoxel tiled{v, {.part = part, .colour = Colour(0.5f), .coverage = 1.0f}};
      world_.occupy(std::span(&tiled, 1));
    }
  }
};

TEST_P(Band, HoldsWhatIsFreeAndNear) {
  for (const int reach : {0, 1, 3, 20}) {
    const BitVolume band = freeBand(world_, world_.occupied(), reach);
    tests::forEachVoxel(size_, [&](Voxel v) {
      int nearest = 99;
      for (const Voxel s : stands_) nearest = std::min(nearest, distance(v, s));
      ASSERT_EQ(band.at(v), nearest > 0 && nearest <= reach) << v.x << ' ' << v.y << ' ' << v.z;
    });
    EXPECT_LE(band.count(), static_cast<std::size_t>(size_.x) * 99u);  // nothing beyond the rows' ends
  }
}

TEST_P(Band, OfOneThingLeavesOutAnother) {
  BitVolume one(size_);
  one.set(stands_[2]);
  const BitVolume band = freeBand(world_, one, 1);
  EXPECT_FALSE(band.at(stands_[3]));
  EXPECT_EQ(band.count(), 16u);  // of 18 in the world's uppermost two slices, the two that stand there
}

TEST_P(Band, FreeIsAllThatDoesNotStand) {
  const BitVolume open = freeVoxels(world_);
  EXPECT_EQ(open.count(), static_cast<std::size_t>(size_.x) * 99u - stands_.size());
  tests::forEachVoxel(size_, [&](Voxel v) { ASSERT_NE(open.at(v), world_.occupied().at(v)); });
}

TEST_P(Band, WhatTakesLightIsNotFree) {
  BitVolume sheet(size_);
  sheet.set({3, 5, 5});
  world_.addOpaque(sheet);
  EXPECT_FALSE(freeVoxels(world_).at({3, 5, 5}));
  EXPECT_FALSE(freeBand(world_, world_.occupied(), 20).at({3, 5, 5}));
}

INSTANTIATE_TEST_SUITE_P(Widths, Band, testing::Values(13, 64, 70, 130));

}  // namespace
}  // namespace espalier::sim
