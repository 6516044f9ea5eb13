#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/world/world.h"

namespace espalier::sim {

/// How many blocks of 8x8x8 voxels lie along each axis.
inline Voxel blocksOf(Voxel size) {
  return (size + 7) / 8;
}

/// What is known of some of a world's blocks of 8x8x8 voxels, by place. Finding it takes two reads, where
/// the way down from an OpenVDB tree's root takes four or five; growth asks millions of times.
template <typename Known>
class BlockMap {
 public:
  explicit BlockMap(Voxel size)
      : blocks_(blocksOf(size)),
        slots_(static_cast<std::size_t>(blocks_.x) * static_cast<std::size_t>(blocks_.y) *
               static_cast<std::size_t>(blocks_.z)),
        known_(1) {}

  /// A default-made Known where nothing is known. The voxel must lie inside the world.
  const Known& of(Voxel v) const { return known_[slots_[blockNumber(blocks_, v)]]; }
  /// What is known of a voxel's block is to be asked soon.
  void prefetch(Voxel v) const { __builtin_prefetch(&slots_[blockNumber(blocks_, v)]); }
  /// What is known of a block, made where there was nothing.
  Known& make(Voxel v) {
    std::uint32_t& slot = slots_[blockNumber(blocks_, v)];
    if (slot == 0) {
      slot = static_cast<std::uint32_t>(known_.size());
      known_.emplace_back();
    }
    return known_[slot];
  }

 private:
  Voxel blocks_;
  std::vector<std::uint32_t> slots_;
  std::vector<Known> known_;
};

}  // namespace espalier::sim
