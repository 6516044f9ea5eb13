#pragma once
#include <array>
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

/// VoxelSet::number for voxels that mostly lie in the words of a few rows, one after the other.
class NearbyNumbers {
 public:
  explicit NearbyNumbers(const VoxelSet& set) : set_(set) {}

  std::size_t operator()(Voxel v) {
    const int word = v.x >> 6;
    Known& known = known_[static_cast<std::size_t>((v.y & 15) * 16 + (v.z & 15))];
    if (known.at != Voxel(word, v.y, v.z))
      known = {Voxel(word, v.y, v.z), set_.number({word * BitVolume::kWordBits, v.y, v.z})};
    const std::uint64_t before = (std::uint64_t{1} << (v.x & 63)) - 1;
    return known.number + static_cast<std::size_t>(std::popcount(set_.bits().row(v.y, v.z)[word] & before));
  }

 private:
  struct Known {
    Voxel at{-1};
    std::size_t number = 0;  // of the word's first place
  };
  const VoxelSet& set_;
  std::array<Known, 256> known_;
};

}  // namespace espalier::sim
