#pragma once
#include <glm/common.hpp>

#include "sim/base/vec.h"

namespace espalier::sim {

/// Where a world of voxels lies in world space: the one converter between metres and voxel widths.
struct Frame {
  Vec3 origin_m{0.0};    ///< world position of the centre of voxel (0, 0, 0)
  double voxel_m = 1.0;  ///< edge of a voxel, metres
  Voxel size{0};         ///< voxels along x, y, z; the world holds voxels 0 <= v < size

  friend bool operator==(const Frame&, const Frame&) = default;
};

inline Vec3 voxelFromWorld(const Frame& frame, Vec3 p_m) {
  return (p_m - frame.origin_m) / frame.voxel_m;
}
inline Vec3 worldFromVoxel(const Frame& frame, Vec3 p_vx) {
  return frame.origin_m + p_vx * frame.voxel_m;
}

/// The voxel whose cube holds a point; a point on a shared face belongs to the voxel on its positive side.
inline Voxel voxelAt(Vec3 p_vx) {
  return Voxel(glm::floor(p_vx + 0.5));
}

inline bool contains(Voxel size, Voxel v) {
  return v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < size.x && v.y < size.y && v.z < size.z;
}

/// Whether a place lies in a world; one that is no number does not.
inline bool holds(Voxel size, Vec3 place_vx) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(place_vx[axis] >= -0.5 && place_vx[axis] < size[axis] - 0.5)) return false;
  }
  return true;
}

}  // namespace espalier::sim
