#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "sim/base/bits.h"
#include "sim/world/block_map.h"
#include "sim/world/world.h"

namespace espalier::sim {

/// What the voxels of plants know. Plants take a few dozen voxels of a block of 8x8x8, where the scene's
/// grids keep all 512; and the voxels of a leaf differ in their coverage alone. So a block lists those that
/// are taken, and what several of them share is kept once. Voxels must lie inside the world.
class PlantVoxels {
 public:
  explicit PlantVoxels(Voxel size) : size_(size), taken_(size), blocks_(size) {}

  /// kFree where no plant is.
  PartId partAt(Voxel v) const {
    const Entry* const entry = find(v);
    return entry != nullptr ? entry->part : kFree;
  }
  std::optional<Surface> surfaceAt(Voxel v) const;

  /// Where plants are.
  const BitVolume& taken() const { return taken_; }
  /// Of the voxels that bits of `among` name, those where plants are: bit i is i voxels from `first` along x.
  /// They must lie inside the world.
  std::uint64_t takenAmong(Voxel first, std::uint64_t among) const { return among & taken_.from(first); }

  /// Those of one plant; plantOf(part) says whose a part is.
  template <typename PlantOf>
  std::uint64_t ofPlant(Voxel first, std::uint64_t among, int plant, PlantOf plant_of) const {
    std::uint64_t own = 0;
    std::uint64_t left = takenAmong(first, among);
    while (left != 0) {
      Voxel v = first;
      v.x += std::countr_zero(left);
      const int shift = (v.x & ~7) - first.x;  // of the block's eight voxels, below 0 at the start
      const std::uint64_t eight =
          left & (shift < 0 ? std::uint64_t{0xff} >> -shift : std::uint64_t{0xff} << shift);
      const Block& block = blocks_.of(v);
      if (block.plant == plant) own |= eight;
      for (std::uint64_t bits = block.plant == kSeveral ? eight : 0; bits != 0; bits &= bits - 1) {
        v.x = first.x + std::countr_zero(bits);
        if (plant_of(block.entries[numberIn(block, v)].part) == plant) own |= bits & -bits;
      }
      left &= ~eight;
    }
    return own;
  }

  /// A voxel is to be asked for or added soon.
  void prefetch(Voxel v) const {
    blocks_.prefetch(v);
    __builtin_prefetch(taken_.row(v.y, v.z) + (v.x >> 6));
  }
  /// Into a voxel where no plant is; `plant` says whose the surface's part is.
  void add(Voxel v, const Surface& surface, int plant);
  /// More comes into a voxel where a plant is. Returns the sum.
  float addCoverage(Voxel v, float coverage);
  /// What comes takes a voxel over where a plant is; the coverage stays.
  void takeOver(Voxel v, const Surface& surface, int plant);

  /// Calls visit(voxel, surface) for all of them, block by block.
  template <typename Visit>
  void forEach(Visit visit) const {
    const Voxel blocks = blocksOf(size_);
    for (int y = 0; y < blocks.y; ++y) {
      for (int z = 0; z < blocks.z; ++z) {
        for (int x = 0; x < blocks.x; ++x) forEachIn(8 * Voxel(x, y, z), visit);
      }
    }
  }

 private:
  struct Look {
    Colour colour;
    Vec3f normal;
    float offset_vx;

    friend bool operator==(const Look&, const Look&) = default;
  };
  struct Entry {
    PartId part;
    std::uint32_t look;
    float coverage;
  };
  static constexpr int kNobody = std::numeric_limits<int>::min(), kSeveral = kNobody + 1;
  /// Of rows of eight voxels along x.
  struct Block {
    std::array<std::uint16_t, 64> first{};  // of the entries, for each row
    std::vector<Entry> entries;             // in the order of (y, z, x)
    int plant = kNobody;                    // whose they all are, or kSeveral
  };

  static std::size_t rowOf(Voxel v) { return static_cast<std::size_t>((v.y & 7) << 3 | (v.z & 7)); }
  bool isTaken(Voxel v) const { return (taken_.row(v.y, v.z)[v.x >> 6] >> (v.x & 63) & 1) != 0; }
  std::size_t numberIn(const Block& block, Voxel v) const {
    const std::uint64_t row = taken_.row(v.y, v.z)[v.x >> 6] >> (v.x & 56);
    return block.first[rowOf(v)] + std::size_t{kBits[row & ((1u << (v.x & 7)) - 1)]};
  }
  const Entry* find(Voxel v) const {
    if (!isTaken(v)) return nullptr;
    const Block& block = blocks_.of(v);
    return &block.entries[numberIn(block, v)];
  }
  Entry& entryAt(Voxel v);
  static void note(Block& block, int plant);
  std::uint32_t lookOf(const Surface& surface);
  Surface surfaceOf(const Entry& entry) const;

  template <typename Visit>
  void forEachIn(Voxel corner, Visit& visit) const {
    const Block& block = blocks_.of(corner);
    auto entry = block.entries.begin();
    for (int n = 0; entry != block.entries.end(); ++n) {
      const Voxel v = corner + Voxel(n & 7, n >> 6, n >> 3 & 7);
      if (taken_.at(v)) visit(v, surfaceOf(*entry++));
    }
  }

  /// How many bits a byte has: std::popcount is slow where a program must run on any processor.
  static constexpr auto kBits = [] {
    std::array<std::uint8_t, 256> bits{};
    for (unsigned byte = 0; byte < 256; ++byte) bits[byte] = static_cast<std::uint8_t>(std::popcount(byte));
    return bits;
  }();

  Voxel size_;
  BitVolume taken_;
  BlockMap<Block> blocks_;
  std::deque<Look> looks_;
  std::vector<std::uint32_t> latest_;  // by part: the number of its latest look, from 1
};

}  // namespace espalier::sim
