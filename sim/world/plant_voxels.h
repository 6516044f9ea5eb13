#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "sim/world/block_map.h"
#include "sim/world/world.h"

namespace espalier::sim {

/// What the voxels of plants know. Plants take a few dozen voxels of a block of 8x8x8, where the scene's
/// grids keep all 512; and the voxels of a leaf differ in their coverage alone. So a block lists those that
/// are taken, and what several of them share is kept once. Voxels must lie inside the world.
class PlantVoxels {
 public:
  explicit PlantVoxels(Voxel size) : size_(size), blocks_(size) {}

  /// kFree where no plant is.
  PartId partAt(Voxel v) const {
    const Entry* const entry = find(v);
    return entry != nullptr ? entry->part : kFree;
  }
  std::optional<Surface> surfaceAt(Voxel v) const;

  /// Calls visit(bit, part) for each plant's voxel that a bit of `among` names: bit i is i voxels from
  /// `first` along x. They must lie inside the world; those without a plant are passed over.
  template <typename Visit>
  void forEachAmong(Voxel first, std::uint64_t among, Visit visit) const {
    while (among != 0) {
      Voxel v = first;
      v.x += std::countr_zero(among);
      const int before = v.x & 7,
                shift = v.x - before - first.x;  // of the block's eight voxels, below 0 at the start
      const std::uint64_t eight = shift < 0 ? std::uint64_t{0xff} >> -shift : std::uint64_t{0xff} << shift;
      const Block& block = blocks_.of(v);
      const unsigned taken = block.taken[rowOf(v)];
      const std::uint64_t here = shift < 0 ? std::uint64_t{taken} >> -shift : std::uint64_t{taken} << shift;
      for (std::uint64_t left = among & here; left != 0; left &= left - 1) {
        v.x = first.x + std::countr_zero(left);
        visit(left & -left, block.entries[numberIn(block, v)].part);
      }
      among &= ~eight;
    }
  }

  /// Of the voxels that bits of `among` name, as above, those where plants are.
  std::uint64_t takenAmong(Voxel first, std::uint64_t among) const {
    std::uint64_t taken = 0;
    while (among != 0) {
      Voxel v = first;
      v.x += std::countr_zero(among);
      const int shift = (v.x & ~7) - first.x;  // below 0 at the start
      const std::uint64_t row = blocks_.of(v).taken[rowOf(v)];
      const auto at = [&](std::uint64_t eight) { return shift < 0 ? eight >> -shift : eight << shift; };
      taken |= among & at(row);
      among &= ~at(0xff);
    }
    return taken;
  }

  /// A voxel is to be asked for or added soon.
  void prefetch(Voxel v) const { blocks_.prefetch(v); }
  /// Into a voxel where no plant is.
  void add(Voxel v, const Surface& surface);
  /// More comes into a voxel where a plant is. Returns the sum.
  float addCoverage(Voxel v, float coverage);
  /// What comes takes a voxel over where a plant is; the coverage stays.
  void takeOver(Voxel v, const Surface& surface);

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
  /// Of rows of eight voxels along x.
  struct Block {
    std::array<std::uint16_t, 64> first{};  // of the entries, for each row
    std::array<std::uint8_t, 64> taken{};   // which of a row's voxels are
    std::vector<Entry> entries;             // in the order of (y, z, x)
  };

  static std::size_t rowOf(Voxel v) { return static_cast<std::size_t>((v.y & 7) << 3 | (v.z & 7)); }
  static bool isTaken(const Block& block, Voxel v) { return (block.taken[rowOf(v)] >> (v.x & 7) & 1) != 0; }
  static std::size_t numberIn(const Block& block, Voxel v) {
    const std::size_t row = rowOf(v);
    const unsigned before = block.taken[row] & ((1u << (v.x & 7)) - 1);
    return block.first[row] + std::size_t{kBits[before]};
  }
  const Entry* find(Voxel v) const {
    const Block& block = blocks_.of(v);
    return isTaken(block, v) ? &block.entries[numberIn(block, v)] : nullptr;
  }
  Entry& entryAt(Voxel v);
  std::uint32_t lookOf(const Surface& surface);
  Surface surfaceOf(const Entry& entry) const;

  template <typename Visit>
  void forEachIn(Voxel corner, Visit& visit) const {
    const Block& block = blocks_.of(corner);
    auto entry = block.entries.begin();
    for (int n = 0; entry != block.entries.end(); ++n) {
      const Voxel v = corner + Voxel(n & 7, n >> 6, n >> 3 & 7);
      if (isTaken(block, v)) visit(v, surfaceOf(*entry++));
    }
  }

  /// How many bits a byte has: std::popcount is slow where a program must run on any processor.
  static constexpr auto kBits = [] {
    std::array<std::uint8_t, 256> bits{};
    for (unsigned byte = 0; byte < 256; ++byte) bits[byte] = static_cast<std::uint8_t>(std::popcount(byte));
    return bits;
  }();

  Voxel size_;
  BlockMap<Block> blocks_;
  std::deque<Look> looks_;
  std::vector<std::uint32_t> latest_;  // by part: the number of its latest look, from 1
};

}  // namespace espalier::sim
