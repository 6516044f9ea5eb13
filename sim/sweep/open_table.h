#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/base/voxel_set.h"

namespace espalier::sim {

/// Which of a set's directions reach the world's edge from each of some places: a bit for each. Every
/// question about light at a place is answered from its row: sums by any weights, the brightest way, hours of
/// sun.
struct OpenTable {
  std::shared_ptr<const VoxelSet> where;
  std::size_t directions = 0;
  std::vector<std::uint64_t> bits;  ///< words() for each place, in the order of `where`

  std::size_t words() const { return (directions + 63) / 64; }
  /// Of one place: bit i is direction i.
  std::span<const std::uint64_t> row(std::size_t place) const {
    return std::span(bits).subspan(place * words(), words());
  }
  bool open(std::size_t place, std::size_t direction) const {
    return ((bits[place * words() + direction / 64] >> (direction % 64)) & 1u) != 0;
  }
};

}  // namespace espalier::sim
