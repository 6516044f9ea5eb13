#pragma once
#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/vec.h"

/// Tiling: which voxels a primitive occupies. A voxel is tiled exactly when its cube intersects the primitive
/// (Greene 1989, section 1, after Kaufman 1986 with the criterion of exact intersection).
///
/// Coordinates are first rounded to 1/4096 of a voxel width; from there on all arithmetic is exact integers,
/// so the answer has no tolerance and is the same on every machine. Ties (a primitive that only touches a
/// face, an edge or a corner of a cube) are settled by moving the primitive by an infinitesimal (e, e^2, e^3)
/// towards +x, +y, +z: a floor lying in the plane between two layers of voxels occupies the upper layer
/// alone.
namespace espalier::sim {

/// Voxel coordinates in 1/4096 of a voxel width. |component| must stay below 2^26 (16,384 voxels).
using Fixed = glm::i64vec3;
inline constexpr std::int64_t kFixedOne = 4096;

inline std::int64_t fixedFromVoxel(double voxels) {
  [[maybe_unused]] constexpr double kReach = 1 << 26;  // a release build asserts nothing
  const double scaled = voxels * static_cast<double>(kFixedOne) + 0.5;
  assert(scaled > -kReach && scaled < kReach);
  const auto towards_zero = static_cast<std::int64_t>(scaled);
  return towards_zero - (scaled < static_cast<double>(towards_zero) ? 1 : 0);
}
inline Fixed fixedFromVoxel(Vec3 p_vx) {
  return {fixedFromVoxel(p_vx.x), fixedFromVoxel(p_vx.y), fixedFromVoxel(p_vx.z)};
}

/// The voxel of a point.
Voxel tilePoint(Vec3 p_vx);

/// Appends the voxels of the segment from a to b, in the order in which it passes them, each once.
void tileSegment(Vec3 a_vx, Vec3 b_vx, std::vector<Voxel>& voxels);

/// Appends the voxels of a triangle, each once, in (y, z, x) order. Degenerate triangles tile like the
/// segment or point that they are.
void tileTriangle(const std::array<Vec3, 3>& corners_vx, std::vector<Voxel>& voxels);

/// A triangle by the numbers of its corners.
using CornerNumbers = std::array<std::uint32_t, 3>;

/// Appends the voxels of triangles that share corners, given as Fixed, in (y, z, x) order, each once.
void tileTriangles(std::span<const glm::ivec3> corners, std::span<const CornerNumbers> triangles,
                   std::vector<Voxel>& voxels);

}  // namespace espalier::sim
