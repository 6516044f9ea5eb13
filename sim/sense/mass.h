#pragma once
#include <optional>

#include "sim/base/bits.h"

namespace espalier::sim {

/// Centre of mass of the occupied voxels within `radius_vx` of a voxel, voxel space; nothing where none is.
std::optional<Vec3> centreOfMass(const BitVolume& occupied, Voxel about, double radius_vx);

}  // namespace espalier::sim
