#pragma once
// Internal to the room: the walk over the rows of voxels that a triangle tiles.
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "sim/tile/tiling.h"

/// A cube and a triangle are apart exactly when one of thirteen axes keeps them apart: three cube normals,
/// the triangle's normal and nine crosses of edges (Akenine-Moller 2001; Schwarz and Seidel 2010 show that
/// the nine are the edges of the three projections). Over voxel coordinates v each axis is an inequality with
/// whole numbers between lo and hi of a.v, so a row of voxels along x is solved by division and no voxel is
/// tested by itself.
///
/// The tie rule: along an axis a, the shift (e, e^2, e^3) moves the triangle up if the first component of a
/// that is not zero is positive. All axes are turned to have it positive, so touching from below counts and
/// from above not.
namespace espalier::sim {

__extension__ using Int128 = __int128;

/// Coordinates measured from the low corner of voxel (0, 0, 0) instead of its centre.
inline Fixed fromCorner(Fixed p) {
  return p + kFixedOne / 2;
}
inline int cellOf(std::int64_t from_corner) {
  return static_cast<int>(from_corner >> 12);
}
inline Voxel cellOf(Fixed p) {
  return {cellOf(p.x), cellOf(p.y), cellOf(p.z)};
}

struct IntRange {
  int first;
  int last;  ///< inclusive
  bool empty() const { return first > last; }
};

template <typename Int>
Int floorDiv(Int n, Int positive) {
  const Int q = n / positive;
  return q - static_cast<Int>(n % positive < 0);
}

/// Narrows r to the i with a * i <= limit.
template <typename Int>
void keepAtMost(IntRange& r, Int a, Int limit) {
  if (a > 0) {
    if (limit >= a * r.last) return;
    r.last = limit < a * r.first ? r.first - 1 : static_cast<int>(floorDiv<Int>(limit, a));
  } else if (a < 0) {
    if (limit >= a * r.first) return;
    r.first = limit < a * r.last ? r.last + 1 : static_cast<int>(-floorDiv<Int>(limit, -a));
  } else if (limit < 0) {
    r.last = r.first - 1;
  }
}

/// a * u + b * w <= limit over the voxel coordinates of one projection.
struct HalfPlane {
  std::int64_t a;
  std::int64_t b;
  std::int64_t limit;
};

/// What an edge of a projected triangle asks of the voxels on its outer side.
inline HalfPlane outerEdge(glm::i64vec2 from, glm::i64vec2 to) {
  const glm::i64vec2 out{to.y - from.y, from.x - to.x};  // the whole triangle lies at or below `top` along it
  const std::int64_t top = out.x * from.x + out.y * from.y;
  const std::int64_t cube_low = std::min<std::int64_t>(out.x, 0) + std::min<std::int64_t>(out.y, 0);
  const bool shifted_up = out.x > 0 || (out.x == 0 && out.y > 0);
  // 4096 m + 4096 cube_low <= top, or < where the shift lowers the top.
  return {out.x, out.y, ((top - (shifted_up ? 0 : 1)) >> 12) - cube_low};
}

inline std::array<HalfPlane, 3> outerEdges(glm::i64vec2 p, glm::i64vec2 q, glm::i64vec2 r,
                                           bool anticlockwise) {
  if (!anticlockwise) std::swap(q, r);
  return {outerEdge(p, q), outerEdge(q, r), outerEdge(r, p)};
}

/// lo <= a.v <= hi: the cube reaches the triangle's plane.
template <typename Int>
struct PlaneSlab {
  Int x, y, z;
  Int lo, hi;
};

/// Of the plane through p with a normal that is not zero.
template <typename Int>
PlaneSlab<Int> planeSlab(Fixed p, glm::i64vec3 n) {
  if (n.x < 0 || (n.x == 0 && (n.y < 0 || (n.y == 0 && n.z < 0)))) n = -n;
  const Int at = Int{n.x} * p.x + Int{n.y} * p.y + Int{n.z} * p.z;
  const glm::i64vec3 zero(0);
  const glm::i64vec3 low = glm::min(n, zero);
  const glm::i64vec3 high = glm::max(n, zero);
  return {n.x, n.y, n.z, (at >> 12) - (high.x + high.y + high.z) + 1, (at >> 12) - (low.x + low.y + low.z)};
}

/// cross(b - a, c - a): exact, as the coordinates stay below 2^26.
inline glm::i64vec3 normalOf(const std::array<Fixed, 3>& q) {
  const Fixed u = q[1] - q[0];
  const Fixed v = q[2] - q[0];
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

template <typename Int, typename Visit>
void walkRows(const std::array<Fixed, 3>& q, glm::i64vec3 n, Voxel span, Voxel first, Voxel last,
              Visit visit) {
  // A projection that is a single voxel wide asks nothing that the bounds do not ask (small triangles live on
  // this); one without area asks nothing that the plane does not ask.
  const bool wide_xy = span.x > 0 && span.y > 0;
  const bool wide_xz = span.x > 0 && span.z > 0;
  const bool wide_yz = span.y > 0 && span.z > 0;
  const bool use_xy = wide_xy && n.z != 0;
  const bool use_xz = wide_xz && n.y != 0;
  const bool use_yz = wide_yz && n.x != 0;
  const bool use_plane = (wide_xy && wide_xz) || wide_xy != use_xy || wide_xz != use_xz || wide_yz != use_yz;
  std::array<HalfPlane, 3> xy, xz, yz;
  PlaneSlab<Int> plane{};
  if (use_xy) xy = outerEdges({q[0].x, q[0].y}, {q[1].x, q[1].y}, {q[2].x, q[2].y}, n.z > 0);
  if (use_xz) xz = outerEdges({q[0].x, q[0].z}, {q[1].x, q[1].z}, {q[2].x, q[2].z}, n.y < 0);
  if (use_yz) yz = outerEdges({q[0].y, q[0].z}, {q[1].y, q[1].z}, {q[2].y, q[2].z}, n.x > 0);
  if (use_plane) plane = planeSlab<Int>(q[0], n);
  for (int y = first.y; y <= last.y; ++y) {
    IntRange xs_of_slice{first.x, last.x};
    IntRange zs{first.z, last.z};
    if (use_xy) {
      for (const HalfPlane& e : xy) keepAtMost<std::int64_t>(xs_of_slice, e.a, e.limit - e.b * y);
    }
    if (use_yz) {
      for (const HalfPlane& e : yz) keepAtMost<std::int64_t>(zs, e.b, e.limit - e.a * y);
    }
    if (xs_of_slice.empty()) continue;
    for (int z = zs.first; z <= zs.last; ++z) {
      IntRange xs = xs_of_slice;
      if (use_xz) {
        for (const HalfPlane& e : xz) keepAtMost<std::int64_t>(xs, e.a, e.limit - e.b * z);
      }
      if (use_plane) {
        const Int rest = plane.y * y + plane.z * z;
        keepAtMost<Int>(xs, plane.x, plane.hi - rest);
        keepAtMost<Int>(xs, -plane.x, rest - plane.lo);
      }
      if (!xs.empty()) visit(y, z, xs);
    }
  }
}

/// Calls visit(y, z, first x, last x) for each row of the voxels lo <= v <= hi that the triangle tiles, in
/// (y, z) order. Corners are measured fromCorner(); the triangle must have an area.
template <typename Visit>
void forEachTriangleRow(const std::array<Fixed, 3>& corners, Voxel lo, Voxel hi, Visit visit) {
  const Fixed low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
  const Fixed high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
  const Voxel base = cellOf(low);
  const Voxel span = cellOf(high) - base;
  const Voxel first = glm::max(lo - base, Voxel(0));
  const Voxel last = glm::min(hi - base, span);
  if (first.x > last.x || first.y > last.y || first.z > last.z) return;
  const Fixed shift = Fixed(base) * kFixedOne;
  const std::array<Fixed, 3> q{corners[0] - shift, corners[1] - shift, corners[2] - shift};
  const auto shifted = [&](int y, int z, IntRange xs) {
    visit(base.y + y, base.z + z, base.x + xs.first, base.x + xs.last);
  };
  // With an extent E a plane's products reach 6 E^3; 64 bits hold them up to 256 voxels.
  if (std::max({span.x, span.y, span.z}) < 255) {
    walkRows<std::int64_t>(q, normalOf(q), span, first, last, shifted);
  } else {
    walkRows<Int128>(q, normalOf(q), span, first, last, shifted);
  }
}

}  // namespace espalier::sim
