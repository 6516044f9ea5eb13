#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "sim/sense/crossing.h"

/// Whether triangles cross, found in another way than sim/sense/crossing does and with no thought of time: by
/// the edges of each that pass through the other, in whole numbers.
namespace espalier::tests {

__extension__ using Wide = __int128;

/// The signed volume that four points span, six times.
inline Wide volume(sim::LatticePoint a, sim::LatticePoint b, sim::LatticePoint c, sim::LatticePoint d) {
  using P = std::array<Wide, 3>;
  const auto less = [](sim::LatticePoint p, sim::LatticePoint q) {
    return P{Wide{p.x} - q.x, Wide{p.y} - q.y, Wide{p.z} - q.z};
  };
  const P u = less(b, a), v = less(c, a), w = less(d, a);
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
         u[2] * (v[0] * w[1] - v[1] * w[0]);
}

/// Whether an edge passes through the inside of a triangle (touching neither its plane with an end nor its
/// rim).
inline bool plainlyPierces(sim::LatticePoint p, sim::LatticePoint q, const sim::LatticeTriangle& t) {
  const Wide at_p = volume(t[0], t[1], t[2], p), at_q = volume(t[0], t[1], t[2], q);
  if (!((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))) return false;
  int left = 0, right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Wide turn = volume(p, q, t[i], t[(i + 1) % 3]);
    left += turn > 0;
    right += turn < 0;
  }
  return left == 3 || right == 3;
}

/// Whether two triangles cross, where no corner of one lies in the plane of the other and no two edges meet:
/// then an edge of one passes through the other.
inline bool plainlyCross(const sim::LatticeTriangle& a, const sim::LatticeTriangle& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (plainlyPierces(a[i], a[(i + 1) % 3], b) || plainlyPierces(b[i], b[(i + 1) % 3], a)) return true;
  }
  return false;
}

/// Whether that is so of two triangles.
inline bool general(const sim::LatticeTriangle& a, const sim::LatticeTriangle& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (volume(a[0], a[1], a[2], b[i]) == 0 || volume(b[0], b[1], b[2], a[i]) == 0) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (volume(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]) == 0) return false;
    }
  }
  return true;
}

}  // namespace espalier::tests
