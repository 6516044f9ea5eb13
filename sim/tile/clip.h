#pragma once
// Internal to the room: convex polygons cut by axis-aligned planes (Sutherland and Hodgman 1974).
#include <array>
#include <cstddef>

#include "sim/base/vec.h"

namespace espalier::sim {

/// A triangle cut by up to six planes. A cut lengthens a polygon by half at the very most, however roundly
/// its corners were calculated: 3, 4, 6, 9, 13, 19, 28.
struct CutPolygon {
  std::array<Vec3, 28> corner;
  std::size_t count = 0;

  void add(Vec3 p) { corner[count++] = p; }
};

/// The part where sign * (coordinate - bound) >= 0.
inline CutPolygon cut(const CutPolygon& polygon, int axis, double bound, double sign) {
  CutPolygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec3& p = polygon.corner[i];
    const Vec3& q = polygon.corner[i + 1 < polygon.count ? i + 1 : 0];
    const double hp = sign * (p[axis] - bound);
    const double hq = sign * (q[axis] - bound);
    if (hp >= 0) kept.add(p);
    if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) {
      Vec3 crossing = p + (hp / (hp - hq)) * (q - p);
      crossing[axis] = bound;
      kept.add(crossing);
    }
  }
  return kept;
}

inline CutPolygon cutToSlab(const CutPolygon& polygon, int axis, double low, double high) {
  return cut(cut(polygon, axis, low, 1.0), axis, high, -1.0);
}

}  // namespace espalier::sim
