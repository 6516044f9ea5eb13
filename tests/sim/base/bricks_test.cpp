#include "sim/base/bricks.h"

#include <gtest/gtest.h>

#include "tests/support/bit_worlds.h"

namespace espalier {
namespace {

using sim::Voxel;

// Sizes at, before and behind the ends of bricks and of words.
TEST(Bricks, AreThoseThatHoldAnything) {
  for (const Voxel size : {Voxel(1), Voxel(8), Voxel(9, 7, 17), Voxel(64, 16, 8), Voxel(65, 30, 23),
                           Voxel(513, 9, 31), Voxel(520, 3, 12)}) {
    for (const double chance : {0.0, 0.001, 0.3}) {
      const auto voxels = tests::randomBits(size, chance, 17);
      sim::BitVolume expected((size + 7) / 8);
      sim::Bricks added(size);
      for (int y = 0; y < size.y; ++y) {
        for (int z = 0; z < size.z; ++z) {
          for (int x = 0; x < size.x; ++x) {
            if (!voxels.at({x, y, z})) continue;
            expected.set({x / 8, y / 8, z / 8});
            added.add(Voxel(x, y, z));
          }
        }
      }
      EXPECT_EQ(sim::Bricks(voxels).bits().size(), expected.size());
      EXPECT_EQ(sim::Bricks(voxels).bits().words(), expected.words()) << size.x << ' ' << chance;
      EXPECT_EQ(added.bits().words(), expected.words()) << size.x << ' ' << chance;
      auto other = tests::randomBits(size, 0.001, 18);
      sim::Bricks both(voxels);
      both.add(sim::Bricks(other));
      other.add(voxels);
      EXPECT_EQ(both.bits().words(), sim::Bricks(other).bits().words());
    }
  }
}

}  // namespace
}  // namespace espalier
