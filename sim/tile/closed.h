#pragma once
// Internal to the room: where a mesh of which nobody said that it is solid encloses something all the same.
#include "sim/base/bits.h"
#include "sim/tile/lines.h"

namespace espalier::sim {

/// The voxels whose centres lie inside of what the mesh closes, or nearly. That is
/// - what no way leads to but from below, past the voxels that the mesh touches: houses stand on the ground
///   without a floor of their own, cracks are narrower than a voxel, and nobody sees in;
/// - what the mesh winds around. A centre is enclosed where all five ends of its lines along the axes that do
///   not lead down find the same winding number and not 0. What one or two of the ends deny belongs to the
///   body that it is joined to, if most of that is enclosed: a mesh may have holes.
/// Courts and rooms that are open to the sky or to a side, and clouds of leaves, are neither. `surface` are
/// the voxels that the mesh's own triangles tile.
BitVolume enclosedBy(const Triangles& triangles_vx, const BitVolume& surface);

}  // namespace espalier::sim
