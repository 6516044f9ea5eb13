#include "sim/base/bricks.h"

#include <algorithm>

#include "sim/base/parallel.h"

namespace espalier::sim {
namespace {

/// Bit b of the result: whether byte b holds anything.
std::uint64_t bytesThatHoldAnything(std::uint64_t word) {
  word |= word >> 4;
  word |= word >> 2;
  word |= word >> 1;
  return ((word & 0x0101010101010101u) * 0x0102040810204080u) >> 56;
}

}  // namespace

Bricks::Bricks(const BitVolume& voxels) : Bricks(voxels.size()) {
  constexpr std::size_t kInWord = BitVolume::kWordBits / kSide;
  const Voxel size = voxels.size();
  const auto words = static_cast<std::size_t>(voxels.rowWords() - 1);
  parallelForEach(static_cast<std::size_t>(bits_.size().y), [&](std::size_t slab) {
    const int y = static_cast<int>(slab);
    std::vector<std::uint64_t> united(words);
    for (int z = 0; z < bits_.size().z; ++z) {
      std::fill(united.begin(), united.end(), 0);
      for (int dy = kSide * y; dy < std::min(size.y, kSide * (y + 1)); ++dy) {
        for (int dz = kSide * z; dz < std::min(size.z, kSide * (z + 1)); ++dz) {
          const std::uint64_t* const row = voxels.row(dy, dz);
          for (std::size_t w = 0; w < words; ++w) united[w] |= row[w];
        }
      }
      std::uint64_t* const row = bits_.row(y, z);
      for (std::size_t w = 0; w < words; ++w)
        row[w / kInWord] |= bytesThatHoldAnything(united[w]) << (kInWord * (w % kInWord));
    }
  });
}

}  // namespace espalier::sim
