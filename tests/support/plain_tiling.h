#pragma once
#include <algorithm>
#include <tuple>
#include <vector>

#include "sim/tile/tiling.h"

/// Polygons tiled triangle by triangle: what sim::tileTriangles must give.
namespace espalier::tests {

/// The voxels of a polygon as a fan of triangles about corner 0, in (y, z, x) order, each once, after those
/// that were there.
inline void tilePolygon(const std::vector<sim::Vec3>& corners_vx, std::vector<sim::Voxel>& voxels) {
  const auto start = static_cast<std::ptrdiff_t>(voxels.size());
  for (std::size_t i = 2; i < corners_vx.size(); ++i)
    sim::tileTriangle({corners_vx[0], corners_vx[i - 1], corners_vx[i]}, voxels);
  std::sort(voxels.begin() + start, voxels.end(), [](sim::Voxel a, sim::Voxel b) {
    return std::tie(a.y, a.z, a.x) < std::tie(b.y, b.z, b.x);
  });
  voxels.erase(std::unique(voxels.begin() + start, voxels.end()), voxels.end());
}

}  // namespace espalier::tests
