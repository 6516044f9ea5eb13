#pragma once
#include <span>

#include "sim/world/world.h"

namespace espalier::sim {

/// Unit vector along which the distance to the scene grows fastest about a voxel; zero where nothing is near.
Vec3 awayFromScene(const World& world, Voxel v);

/// Mean distance to the scene of voxels inside the world, voxel widths; one beyond the boundary layers counts
/// as one layer farther than the last. As sim::feel finds it, to the bit.
double meanProximity(const World& world, std::span<const Voxel> voxels);

}  // namespace espalier::sim
