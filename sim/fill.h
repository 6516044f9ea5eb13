#pragma once
// Internal to the room: the inside of a mesh that may leak.
#include <array>
#include <vector>

#include "sim/bits.h"
#include "sim/vec.h"

namespace espalier::sim {

struct Inside {
  BitVolume voxels;          ///< of the world; among those that the surface leaves free
  std::size_t doubtful = 0;  ///< voxels that the lines along the axes did not settle
};

/// `surface` are the voxels that the mesh's own triangles tile. Corners must lie within 16,000 voxels of the
/// origin.
Inside findInside(const std::vector<std::array<Vec3, 3>>& triangles_vx, const BitVolume& surface);

}  // namespace espalier::sim
