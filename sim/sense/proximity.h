#pragma once
#include <span>

#include "sim/world/world.h"

namespace espalier::sim {

/// Mean distance to the scene over voxels, voxel widths. A voxel beyond the boundary layers counts as one
/// layer farther than the last: all that is known of it is that it is at least that far. `voxels` must not be
/// empty.
double averageProximity(const World& world, std::span<const Voxel> voxels);

/// Unit vector along which the distance to the scene grows fastest about a voxel; zero where nothing is near.
Vec3 awayFromScene(const World& world, Voxel v);

}  // namespace espalier::sim
