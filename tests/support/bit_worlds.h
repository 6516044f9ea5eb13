#pragma once
#include <random>

#include "sim/base/bits.h"

/// Small worlds with known answers.
namespace espalier::tests {

/// Every voxel occupied with the same chance.
inline sim::BitVolume randomBits(sim::Voxel size, double chance, unsigned seed) {
  std::mt19937 random(seed);
  sim::BitVolume bits(size);
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        if (static_cast<double>(random()) < chance * 4294967296.0) bits.set({x, y, z});
      }
    }
  }
  return bits;
}

/// Occupies the box low..high, both included.
inline void addBox(sim::BitVolume& bits, sim::Voxel low, sim::Voxel high) {
  for (int y = low.y; y <= high.y; ++y) {
    for (int z = low.z; z <= high.z; ++z) {
      for (int x = low.x; x <= high.x; ++x) bits.set({x, y, z});
    }
  }
}

}  // namespace espalier::tests
