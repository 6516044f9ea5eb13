#include "sim/base/voxel_set.h"

namespace espalier::sim {

VoxelSet::VoxelSet(BitVolume bits) : bits_(std::move(bits)) {
  const Voxel size = bits_.size();
  row_begin_.reserve(static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z) + 1);
  std::size_t count = 0;
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      row_begin_.push_back(count);
      const std::uint64_t* const row = bits_.row(y, z);
      for (int w = 0; w < bits_.rowWords() - 1; ++w) count += static_cast<std::size_t>(std::popcount(row[w]));
    }
  }
  row_begin_.push_back(count);
}

std::vector<Voxel> VoxelSet::voxels() const {
  std::vector<Voxel> voxels;
  voxels.reserve(count());
  for (int y = 0; y < bits_.size().y; ++y) {
    for (int z = 0; z < bits_.size().z; ++z) {
      const std::uint64_t* const row = bits_.row(y, z);
      for (int w = 0; w < bits_.rowWords() - 1; ++w) {
        for (std::uint64_t left = row[w]; left != 0; left &= left - 1)
          voxels.emplace_back(w * BitVolume::kWordBits + std::countr_zero(left), y, z);
      }
    }
  }
  return voxels;
}

}  // namespace espalier::sim
