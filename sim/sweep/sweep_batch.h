#pragma once
// Internal to the room: many directions swept through a world at once.
#include <functional>
#include <span>

#include "sim/base/bits.h"
#include "sim/sweep/directions.h"
#include "sim/sweep/lanes.h"

namespace espalier::sim {

/// What a few rows of a slice see, for every direction of a batch.
struct Band {
  int y;
  int z0, z1;  ///< rows z0 <= z < z1; z0 is a multiple of lanes::kRows
  std::span<const lanes::Word* const>
      blocked;                            ///< of each direction, word (0, 0) of the slice (sim/sweep/lanes.h)
  std::size_t line;                       ///< words from (w, z) to (w + 1, z)
  std::span<const lanes::Blocks> filled;  ///< for each w the band's blocks in which anything is blocked
};

/// Which slices are asked for, and whether the bands of a slice are shared out among the threads: not where
/// each thread has a batch of its own.
struct Extent {
  int low_y, high_y;
  bool shared = true;
};

/// Sweeps directions that all go up or stay level, or all go down. Calls count(band) for the bands of the
/// slices low_y <= y <= high_y, one slice after another, without those in which nothing can be blocked; from
/// several threads if they are shared.
void sweepBatch(const BitVolume& occupied, std::span<const LatticeDirection* const> batch,
                const Extent& extent, const std::function<void(const Band&)>& count);

/// Numbers of directions that are swept at once.
using Batch = std::vector<std::size_t>;

/// Parts directions, by their numbers, into batches of one kind, of at least so many and no more than stay in
/// a core's cache while they are swept.
std::vector<Batch> batchesOf(const BitVolume& occupied, const DirectionSet& directions, const Batch& numbers,
                             std::size_t least);

/// Whether a slice is so small that sharing it out takes longer than sweeping it.
bool isSmall(const BitVolume& occupied);

}  // namespace espalier::sim
