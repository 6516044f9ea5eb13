#include "sim/base/bits.h"

#include <gtest/gtest.h>

#include "tests/support/bit_worlds.h"

namespace espalier {
namespace {

using sim::BitVolume;
using sim::Voxel;

TEST(BitVolume, SetsAreJoinedKeptAndTakenAway) {
  const Voxel size(131, 3, 5);
  const BitVolume a = tests::randomBits(size, 0.4, 1), b = tests::randomBits(size, 0.5, 2);
  BitVolume both = a, joined = a, first_alone = a;
  both.keep(b);
  joined.add(b);
  first_alone.remove(b);
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        const Voxel v(x, y, z);
        ASSERT_EQ(both.at(v), a.at(v) && b.at(v));
        ASSERT_EQ(joined.at(v), a.at(v) || b.at(v));
        ASSERT_EQ(first_alone.at(v), a.at(v) && !b.at(v));
      }
    }
  }
}

}  // namespace
}  // namespace espalier
