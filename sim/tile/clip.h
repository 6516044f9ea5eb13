#pragma once
#include <array>
#include <cstddef>
#include <glm/common.hpp>
#include <utility>

#include "sim/base/vec.h"

/// Convex polygons cut by axis-aligned planes (Sutherland and Hodgman 1974).
namespace espalier::sim {

/// A triangle cut by up to six planes. A cut lengthens a polygon by half at the very most, however roundly
/// its corners were calculated: 3, 4, 6, 9, 13, 19, 28.
struct CutPolygon {
  std::array<Vec3, 28> corner;
  std::size_t count = 0;

  void add(Vec3 p) { corner[count++] = p; }
};

/// Where an edge crosses a plane, which its ends lie on either side of. Polygons that share the edge find the
/// very same point, whichever way around they have it; and it lies between the ends along every axis, so that
/// what was cut to a slab stays in it.
inline Vec3 crossing(Vec3 low, Vec3 high, int axis, double bound) {
  if (low[axis] > high[axis]) std::swap(low, high);
  const double along = (bound - low[axis]) / (high[axis] - low[axis]);
  Vec3 at = glm::clamp(low + along * (high - low), glm::min(low, high), glm::max(low, high));
  at[axis] = bound;
  return at;
}

/// The part where sign * (coordinate - bound) >= 0.
inline CutPolygon cut(const CutPolygon& polygon, int axis, double bound, double sign) {
  CutPolygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec3& p = polygon.corner[i];
    const Vec3& q = polygon.corner[i + 1 < polygon.count ? i + 1 : 0];
    const double hp = sign * (p[axis] - bound);
    const double hq = sign * (q[axis] - bound);
    if (hp >= 0) kept.add(p);
    if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) kept.add(crossing(p, q, axis, bound));
  }
  return kept;
}

inline CutPolygon cutToSlab(const CutPolygon& polygon, int axis, double low, double high) {
  return cut(cut(polygon, axis, low, 1.0), axis, high, -1.0);
}

/// A triangle's part in a box, bounds included.
inline CutPolygon cutToBox(const std::array<Vec3, 3>& triangle, Vec3 low, Vec3 high) {
  CutPolygon part;
  for (const Vec3 corner : triangle) part.add(corner);
  for (int axis = 0; axis < 3; ++axis) part = cutToSlab(part, axis, low[axis], high[axis]);
  return part;
}

}  // namespace espalier::sim
