#pragma once
// Internal to the room: the walk over the rows of voxels that a triangle tiles.
#include <algorithm>
#include <array>
#include <cstdint>

#include "sim/tiling.h"

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

/// What the three edges of a projected triangle ask of the voxels, each on its outer side. The projected
/// triangle must have an area, `turn` its sign.
inline std::array<HalfPlane, 3> outerEdges(const std::array<glm::i64vec2, 3>& p, bool anticlockwise) {
  std::array<HalfPlane, 3> edges;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::i64vec2 from = p[i];
    const glm::i64vec2 along = p[(i + 1) % 3] - from;
    // Outward normal; the whole triangle lies at or below `top` along it.
    const glm::i64vec2 out =
        anticlockwise ? glm::i64vec2(along.y, -along.x) : glm::i64vec2(-along.y, along.x);
    const std::int64_t top = out.x * from.x + out.y * from.y;
    const std::int64_t cube_low =
        kFixedOne * (std::min<std::int64_t>(out.x, 0) + std::min<std::int64_t>(out.y, 0));
    const bool shifted_up = out.x > 0 || (out.x == 0 && out.y > 0);
    // The cube's low side must not lie above the top: 4096 m + cube_low <= top, or < where the shift lowers
    // the top.
    edges[i] = {out.x, out.y, (top - cube_low - (shifted_up ? 0 : 1)) >> 12};
  }
  return edges;
}

/// lo <= a.v <= hi: the cube reaches the triangle's plane.
template <typename Int>
struct PlaneSlab {
  Int x, y, z;
  Int lo, hi;
};

/// The normal must not be zero, with coordinates from a corner near the triangle.
template <typename Int>
PlaneSlab<Int> planeSlab(const std::array<Fixed, 3>& q, glm::i64vec3 n) {
  if (n.x < 0 || (n.x == 0 && (n.y < 0 || (n.y == 0 && n.z < 0)))) n = -n;
  const Int at = Int{n.x} * q[0].x + Int{n.y} * q[0].y + Int{n.z} * q[0].z;
  const Int low =
      Int{std::min<std::int64_t>(n.x, 0)} + std::min<std::int64_t>(n.y, 0) + std::min<std::int64_t>(n.z, 0);
  const Int high =
      Int{std::max<std::int64_t>(n.x, 0)} + std::max<std::int64_t>(n.y, 0) + std::max<std::int64_t>(n.z, 0);
  return {n.x, n.y, n.z, ((at - kFixedOne * high) >> 12) + 1, (at - kFixedOne * low) >> 12};
}

/// cross(b - a, c - a): exact, as the coordinates stay below 2^26.
inline glm::i64vec3 normalOf(const std::array<Fixed, 3>& q) {
  const Fixed u = q[1] - q[0];
  const Fixed v = q[2] - q[0];
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

template <typename Int, typename Visit>
void walkRows(const std::array<Fixed, 3>& q, glm::i64vec3 n, Voxel base, Voxel first, Voxel last,
              Visit& visit) {
  const PlaneSlab<Int> plane = planeSlab<Int>(q, n);
  // A projection that has no area asks nothing that the plane does not ask.
  std::array<HalfPlane, 3> xy, xz, yz;
  if (n.z != 0) xy = outerEdges({glm::i64vec2(q[0].x, q[0].y), {q[1].x, q[1].y}, {q[2].x, q[2].y}}, n.z > 0);
  if (n.y != 0) xz = outerEdges({glm::i64vec2(q[0].x, q[0].z), {q[1].x, q[1].z}, {q[2].x, q[2].z}}, n.y < 0);
  if (n.x != 0) yz = outerEdges({glm::i64vec2(q[0].y, q[0].z), {q[1].y, q[1].z}, {q[2].y, q[2].z}}, n.x > 0);
  for (int y = first.y; y <= last.y; ++y) {
    IntRange xs_of_slice{first.x, last.x};
    if (n.z != 0) {
      for (const HalfPlane& e : xy) keepAtMost<std::int64_t>(xs_of_slice, e.a, e.limit - e.b * y);
    }
    IntRange zs{first.z, last.z};
    if (n.x != 0) {
      for (const HalfPlane& e : yz) keepAtMost<std::int64_t>(zs, e.b, e.limit - e.a * y);
    }
    if (xs_of_slice.empty()) continue;
    for (int z = zs.first; z <= zs.last; ++z) {
      IntRange xs = xs_of_slice;
      if (n.y != 0) {
        for (const HalfPlane& e : xz) keepAtMost<std::int64_t>(xs, e.a, e.limit - e.b * z);
      }
      if (xs.empty()) continue;
      const Int rest = plane.y * y + plane.z * z;
      keepAtMost<Int>(xs, plane.x, plane.hi - rest);
      if (xs.empty()) continue;
      keepAtMost<Int>(xs, -plane.x, rest - plane.lo);
      if (!xs.empty()) visit(base.y + y, base.z + z, base.x + xs.first, base.x + xs.last);
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
  const Voxel first = glm::max(base, lo) - base;
  const Voxel last = glm::min(cellOf(high), hi) - base;
  if (first.x > last.x || first.y > last.y || first.z > last.z) return;
  const Fixed shift = Fixed(base) * kFixedOne;
  const std::array<Fixed, 3> q{corners[0] - shift, corners[1] - shift, corners[2] - shift};
  const glm::i64vec3 n = normalOf(q);
  // With an extent E a plane's products reach 6 E^3; 64 bits hold them up to 256 voxels.
  const Fixed extent = high - low;
  if (std::max({extent.x, extent.y, extent.z}) < (std::int64_t{1} << 20) - kFixedOne) {
    walkRows<std::int64_t>(q, n, base, first, last, visit);
  } else {
    walkRows<Int128>(q, n, base, first, last, visit);
  }
}

}  // namespace espalier::sim
