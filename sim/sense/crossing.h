#pragma once
#include <array>
#include <glm/common.hpp>

#include "sim/base/vec.h"
#include "sim/tile/tiling.h"

/// Whether triangles and straight lines cross. Points lie on tiling's lattice (sim/tile/tiling.h: 1/4096 of a
/// voxel width, |component| below 2^26), and all arithmetic is exact integers: no tolerance, and the same
/// answer on every machine.
namespace espalier::sim {

using LatticePoint = glm::ivec3;
using LatticeTriangle = std::array<LatticePoint, 3>;

/// An upright box, bounds included.
struct LatticeBox {
  LatticePoint low{0}, high{0};
};

/// Whether two boxes share a point.
inline bool meet(const LatticeBox& a, const LatticeBox& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

inline LatticeBox boxOf(LatticePoint a, LatticePoint b) {
  return {glm::min(a, b), glm::max(a, b)};
}
inline LatticeBox boxOf(const LatticeTriangle& t) {
  return {glm::min(glm::min(t[0], t[1]), t[2]), glm::max(glm::max(t[0], t[1]), t[2])};
}
inline LatticePoint latticePoint(Vec3 p_vx) {
  return LatticePoint(fixedFromVoxel(p_vx));
}

/// Whether two triangles cross: what they share has a length or, where they lie in one plane, an area. Those
/// that only touch, at a corner or with an edge from one side, do not; a triangle without area crosses
/// nothing. (Orientations alone, after Guigue and Devillers 2003.)
bool cross(const LatticeTriangle& a, const LatticeTriangle& b);

/// Whether two boxes lie within 256 voxel widths together.
bool near(const LatticeBox& a, const LatticeBox& b);
/// cross(b - a, c - a) of a triangle's corners; it must lie within 256 voxel widths.
glm::i64vec3 normalOf(const LatticeTriangle& triangle);
/// The same as cross, of triangles that are near, with their normals.
bool crossNear(const LatticeTriangle& a, const glm::i64vec3& normal_a, const LatticeTriangle& b,
               const glm::i64vec3& normal_b);

/// Whether a straight line pierces a triangle: its ends lie on different sides of the plane, and it passes
/// the triangle's inside or its edge. An end in the plane counts as lying behind it, so that of the limbs of
/// one way that meet in the plane exactly one pierces. A triangle without area is not pierced.
bool pierces(LatticePoint from, LatticePoint to, const LatticeTriangle& triangle);

}  // namespace espalier::sim
