#pragma once
#include "sim/bits.h"

namespace espalier::sim {

/// All voxels that are not occupied.
BitVolume freeVoxels(const BitVolume& occupied);

/// The voxels up to `reach` >= 0 voxels from one of `around` that are not occupied. Corner to corner counts
/// as one step (Chebyshev distance), as boundary layers count. Both volumes must have one size.
BitVolume freeBand(const BitVolume& around, int reach, const BitVolume& occupied);

}  // namespace espalier::sim
