#pragma once
#include "sim/base/bits.h"

namespace espalier::sim {

/// The bricks of 8x8x8 voxels that hold anything at all: lets who asks or walks cross empty space in large
/// steps. Those along a volume's upper edges may reach beyond it.
class Bricks {
 public:
  static constexpr int kSide = 8;  ///< voxels along a brick's edge

  /// Of an empty volume of this size.
  explicit Bricks(Voxel size) : bits_((size + (kSide - 1)) / kSide) {}
  /// Scans the volume.
  explicit Bricks(const BitVolume& voxels);

  const BitVolume& bits() const { return bits_; }  ///< one for each
  /// The volume has got a voxel more, which must lie inside.
  void add(Voxel v) { bits_.set(v / kSide); }
  /// The volume has got all of these more. Of the same size.
  void add(const Bricks& more) { bits_.add(more.bits_); }

 private:
  BitVolume bits_;
};

}  // namespace espalier::sim
