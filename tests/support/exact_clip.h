#pragma once
// An oracle for tiling that shares no idea with it: the primitive is really moved by a small (e, e^2, e^3)
// and then clipped to each cube in rational arithmetic; a voxel is tiled when something is left.

// GCC 12 takes the small-number union of Boost's integers for uninitialized memory.
#ifndef __clang__  // which calls itself GCC and has no such warning
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

#include "sim/base/frame.h"
#include "sim/tile/tiling.h"

namespace espalier::tests {

// Without expression templates, which take long to compile.
using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;
using Point = std::array<Rational, 3>;
using Shape = std::vector<Point>;  ///< one corner: a point; two: a segment; more: a convex polygon

/// Coordinates stay below 2^27, so every separating axis has components below 2^56 and 2^-64 of a unit cannot
/// overtake one.
inline Shape movedALittle(const std::vector<sim::Vec3>& corners) {
  Shape shape;
  const Rational e = Rational(1) / Rational(std::uint64_t{1} << 32) / Rational(std::uint64_t{1} << 32);
  for (const sim::Vec3& p : corners) {
    const sim::Fixed f = sim::fixedFromVoxel(p);
    shape.push_back({f.x + e, f.y + e * e, f.z + e * e * e});
  }
  return shape;
}

/// The part of a shape where sign * (coordinate - bound) >= 0.
inline Shape clipped(const Shape& shape, std::size_t axis, std::int64_t bound, int sign) {
  Shape kept;
  const auto height = [&](const Point& p) -> Rational { return sign * (p[axis] - bound); };
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const Point& p = shape[i];
    const Point& q = shape[(i + 1) % shape.size()];
    const Rational hp = height(p);
    const Rational hq = height(q);
    if (hp >= 0) kept.push_back(p);
    if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) {
      const Rational t = hp / (hp - hq);
      kept.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])});
    }
  }
  return kept;
}

inline Shape slab(const Shape& shape, std::size_t axis, int voxel) {
  const std::int64_t low = sim::kFixedOne * voxel - sim::kFixedOne / 2;
  return clipped(clipped(shape, axis, low, 1), axis, low + sim::kFixedOne, -1);
}

/// All voxels that the moved shape meets, within `lo` and `hi`, in (y, z, x) order.
inline std::vector<sim::Voxel> exactTiling(const std::vector<sim::Vec3>& corners, sim::Voxel lo,
                                           sim::Voxel hi) {
  std::vector<sim::Voxel> voxels;
  sim::Vec3 low = corners[0], high = corners[0];
  for (const sim::Vec3& p : corners) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  lo = glm::max(lo, sim::voxelAt(low) - 1);
  hi = glm::min(hi, sim::voxelAt(high) + 1);
  const Shape whole = movedALittle(corners);
  for (int y = lo.y; y <= hi.y; ++y) {
    const Shape in_slice = slab(whole, 1, y);
    for (int z = lo.z; !in_slice.empty() && z <= hi.z; ++z) {
      const Shape in_row = slab(in_slice, 2, z);
      for (int x = lo.x; !in_row.empty() && x <= hi.x; ++x) {
        if (!slab(in_row, 0, x).empty()) voxels.emplace_back(x, y, z);
      }
    }
  }
  return voxels;
}

}  // namespace espalier::tests
