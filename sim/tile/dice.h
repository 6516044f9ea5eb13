#pragma once
#include <array>
#include <functional>
#include <span>

#include "sim/base/vec.h"

namespace espalier::sim {

/// Cuts a triangle to the grid of voxels: its part in each voxel's cube is a convex polygon, a fragment
/// (Greene 1989, section 4: "dicing each polygon to the voxel grid"). Corners are in voxel widths, `size` is
/// the world's. Visits each fragment with its voxel, which has an order of its own: by x, then y, then z.
///
/// Fragments fill the triangle and do not overlap. Those side by side share their corners to the last bit,
/// and so do those of triangles that share an edge: nothing gapes. Coordinates on a plane between voxels are
/// exactly those of the plane. A fragment that lies in such a plane has the voxel on its positive side, as
/// voxelAt has, or the last one.
///
/// Beyond the world there are no voxels: what lies there stays in one piece for each side of the world, whose
/// voxel is the world's own nearest to its middle. Along that side it has its own corners alone, and its
/// neighbours within have more, on the same line. Corners must be finite.
void dice(const std::array<Vec3, 3>& triangle_vx, Voxel size,
          const std::function<void(Voxel voxel, std::span<const Vec3> fragment_vx)>& visit);

}  // namespace espalier::sim
