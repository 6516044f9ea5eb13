#pragma once
// Internal to the room: many directions swept through a world at once.
#include <functional>
#include <span>

#include "sim/bits.h"
#include "sim/directions.h"
#include "sim/lanes.h"

namespace espalier::sim {

/// What a few rows of a slice see, for every direction of a batch.
struct Band {
  int y;
  int z0, z1;                                   ///< rows z0 <= z < z1; z0 is a multiple of lanes::kRows
  std::span<const lanes::Word* const> blocked;  ///< of each direction, word (0, 0) of the slice (sim/lanes.h)
  std::size_t line;                             ///< words from (w, z) to (w + 1, z)
  std::span<const lanes::Blocks> filled;        ///< for each w the band's blocks in which anything is blocked
};

/// Sweeps directions that all go up or stay level, or all go down. Calls count(band) from several threads for
/// the bands of the slices low_y <= y <= high_y, one slice after another, without those in which nothing can
/// be blocked.
void sweepBatch(const BitVolume& occupied, std::span<const LatticeDirection* const> batch, int low_y,
                int high_y, const std::function<void(const Band&)>& count);

/// Parts a set into batches of at least so many directions, and no more than stay in a core's cache while
/// they are swept. `take` gets the numbers of a batch's directions.
void forEachBatch(const BitVolume& occupied, const DirectionSet& directions, std::size_t least,
                  const std::function<void(std::span<const std::size_t>)>& take);

}  // namespace espalier::sim
