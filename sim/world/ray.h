#pragma once
#include <optional>

#include "sim/base/bits.h"
#include "sim/base/bricks.h"
#include "sim/base/vec.h"

namespace espalier::sim {

struct RayHit {
  Voxel voxel{0};  ///< the first occupied voxel
  Voxel face{0};   ///< outward normal of the cube's face that was hit; zero if the ray began inside the voxel
  double t = 0.0;  ///< distance along the unit direction, voxel widths
};

/// The first occupied voxel that a ray meets (Amanatides and Woo 1987, over bricks and then voxels). The
/// origin may lie outside the world. `direction` must be of unit length. Where the ray passes exactly through
/// an edge or a corner, x is crossed before y and y before z. A caller who knows that at a distance of
/// `free_vx` the ray is in free space, with nothing occupied before, spares it the way there.
std::optional<RayHit> firstHit(const BitVolume& occupied, const Bricks& bricks, Vec3 origin_vx,
                               Vec3 direction, double free_vx = 0.0);

}  // namespace espalier::sim
