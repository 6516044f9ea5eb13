#pragma once
#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

#include "sim/base/bits.h"

namespace espalier::sim {

/// Some of a world's voxels, numbered in (y, z, x) order: where something is known or asked for.
class VoxelSet {
 public:
  explicit VoxelSet(BitVolume bits);

  const BitVolume& bits() const { return bits_; }
  std::size_t count() const { return row_begin_.back(); }
  bool has(Voxel v) const { return bits_.at(v); }
  /// The number of a voxel, which must be one of the set.
  std::size_t number(Voxel v) const {
    const std::uint64_t* const row = bits_.row(v.y, v.z);
    std::size_t n = row_begin_[rowIndex(v.y, v.z)];
    for (int w = 0; w < v.x >> 6; ++w) n += static_cast<std::size_t>(std::popcount(row[w]));
    return n +
           static_cast<std::size_t>(std::popcount(row[v.x >> 6] & ((std::uint64_t{1} << (v.x & 63)) - 1)));
  }
  /// The number of the first voxel at or after row (y, z).
  std::size_t firstOfRow(int y, int z) const { return row_begin_[rowIndex(y, z)]; }
  /// All of them, in order.
  std::vector<Voxel> voxels() const;

 private:
  std::size_t rowIndex(int y, int z) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(bits_.size().z) +
           static_cast<std::size_t>(z);
  }
  BitVolume bits_;
  std::vector<std::size_t> row_begin_;  // of each row, and the count of all
};

}  // namespace espalier::sim
