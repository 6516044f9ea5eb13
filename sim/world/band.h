#pragma once
#include "sim/base/bits.h"
#include "sim/world/world.h"

namespace espalier::sim {

/// All voxels that are free: neither occupied nor opaque. (A sheet that lies between two layers of voxels is
/// occupied on one side and takes light on the other.)
BitVolume freeVoxels(const World& world);

/// The free voxels up to `reach` >= 0 voxels from one of `around`, which must have the world's size. Corner
/// to corner counts as one step (Chebyshev distance), as boundary layers count.
BitVolume freeBand(const World& world, const BitVolume& around, int reach);

}  // namespace espalier::sim
