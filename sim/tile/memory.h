#pragma once
// Internal to the room: what a world costs.
#include <cstddef>
#include <string>

#include "sim/base/vec.h"
#include "sim/tile/build_world.h"

namespace espalier::sim {

/// Throws InputError when a world of so many voxels, given as real numbers so that nothing overflows, is too
/// large for tiling or for this machine.
void requireFits(Vec3 size, double voxel_m, const WorldUse& use);

/// The same for voxels that a filled mesh would add to a world one by one.
void requireFilledFits(std::size_t voxels, const std::string& object);

}  // namespace espalier::sim
