#pragma once
// Internal to the room: what lies inside a mesh that may leak, and what of it takes light.
#include <array>
#include <functional>
#include <vector>

#include "sim/base/bits.h"
#include "sim/base/vec.h"
#include "sim/tile/lines.h"

namespace espalier::sim {

struct Filled {
  BitVolume inside;  ///< of a solid's voxels, those that the surface leaves free
  BitVolume opaque;  ///< what takes light: all that are inside, and where that is too little, those behind
  std::size_t doubtful = 0;   ///< free voxels that the lines along the axes did not settle
  std::size_t outvoted = 0;   ///< of those, the ones taken for outside
  std::size_t undecided = 0;  ///< of the doubtful, where neither side has two thirds of all ends
};

/// How far from the origin corners may lie, in voxels: fixed point holds no more.
inline constexpr double kFarthestCorner = 16000.0;

/// `surface` are the voxels that the mesh's own triangles tile. Corners must lie within kFarthestCorner.
Filled fillMesh(const Triangles& triangles_vx, const BitVolume& surface, bool solid);
/// The same where it is known which voxels' centres are inside.
Filled fillMesh(const Triangles& triangles_vx, const BitVolume& surface, const BitVolume& inside);

/// The voxels of a world of this size that may be inside or behind.
VoxelBox boxOf(const Triangles& triangles_vx, Voxel size);
/// Calls work(first y, last y) for slabs of a box whose bytes never outgrow the world's bits.
void forEachSlab(const VoxelBox& box, const std::function<void(int, int)>& work);

}  // namespace espalier::sim
