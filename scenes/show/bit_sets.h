#pragma once
// Internal to the wing: of two volumes of one size.
#include <cstdint>
#include <utility>

#include "sim/base/bits.h"

namespace espalier::scenes {

/// Each word of the first by what is wanted of it and the other's.
template <class Wanted>
sim::BitVolume wordByWord(sim::BitVolume set, const sim::BitVolume& other, Wanted wanted) {
  const sim::Voxel size = set.size();
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int w = 0; w < set.rowWords(); ++w)
        set.row(y, z)[w] = wanted(set.row(y, z)[w], other.row(y, z)[w]);
    }
  }
  return set;
}

/// What is set in both.
inline sim::BitVolume both(sim::BitVolume set, const sim::BitVolume& other) {
  return wordByWord(std::move(set), other, [](std::uint64_t a, std::uint64_t b) { return a & b; });
}

/// What is set in the first alone.
inline sim::BitVolume without(sim::BitVolume set, const sim::BitVolume& other) {
  return wordByWord(std::move(set), other, [](std::uint64_t a, std::uint64_t b) { return a & ~b; });
}

}  // namespace espalier::scenes
