#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/base/frame.h"
#include "sim/base/vec.h"

namespace espalier::sim {

/// One bit a voxel: the packed occupancy that rays and sweeps read.
/// Rows run along x, slices are xz-planes and y is slowest: a sky sweep goes down the slices one by one.
/// A whole word of zeros lies before and behind each row (and one more behind the last), so that a read
/// shifted by up to 63 voxels either way needs no bounds check.
class BitVolume {
 public:
  static constexpr int kWordBits = 64;

  BitVolume() = default;
  explicit BitVolume(Voxel size)
      : size_(size),
        row_words_((size.x + kWordBits - 1) / kWordBits + 1),
        words_(2 + static_cast<std::size_t>(row_words_) * static_cast<std::size_t>(size.y) *
                       static_cast<std::size_t>(size.z)) {}

  Voxel size() const { return size_; }
  /// Words from one row to the next; the last of them is the zero word behind the row.
  int rowWords() const { return row_words_; }

  /// False outside the volume.
  bool at(Voxel v) const { return contains(size_, v) && ((row(v.y, v.z)[v.x >> 6] >> (v.x & 63)) & 1u) != 0; }
  /// The voxel must lie inside.
  void set(Voxel v) { row(v.y, v.z)[v.x >> 6] |= std::uint64_t{1} << (v.x & 63); }
  void clear(Voxel v) { row(v.y, v.z)[v.x >> 6] &= ~(std::uint64_t{1} << (v.x & 63)); }
  /// Sets all that are set in a volume of the same size.
  void add(const BitVolume& more);
  /// Clears all that are not set in a volume of the same size; or all that are.
  void keep(const BitVolume& only);
  void remove(const BitVolume& these);

  /// The 64 voxels from one on along x, bit 0 being itself; zeros before the row and behind it. The row must
  /// lie inside, and x between -63 and the row's end.
  std::uint64_t from(Voxel v) const {
    const std::uint64_t* const words = row(v.y, v.z) + (v.x >> 6);
    const int shift = v.x & 63;
    return words[0] >> shift | words[1] << 1 << (63 - shift);
  }
  const std::uint64_t* row(int y, int z) const { return words_.data() + rowOffset(y, z); }
  std::uint64_t* row(int y, int z) { return words_.data() + rowOffset(y, z); }
  const std::vector<std::uint64_t>& words() const { return words_; }

  std::size_t count() const;

 private:
  std::size_t rowOffset(int y, int z) const {
    return 1 +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.z) + static_cast<std::size_t>(z)) *
               static_cast<std::size_t>(row_words_);
  }

  Voxel size_{0};
  int row_words_ = 0;
  std::vector<std::uint64_t> words_;
};

}  // namespace espalier::sim
