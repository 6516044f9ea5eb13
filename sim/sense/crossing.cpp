#include "sim/sense/crossing.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace espalier::sim {
namespace {

__extension__ using Int128 = __int128;

template <typename Int>
struct Point {
  Int x, y, z;
};

template <typename Int>
Point<Int> operator-(const Point<Int>& a, const Point<Int>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <typename Int>
Point<Int> cross(const Point<Int>& a, const Point<Int>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename Int>
Int dot(const Point<Int>& a, const Point<Int>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename Int>
int sign(Int v) {
  return (v > 0) - (v < 0);
}

/// On which side of the plane of a, b, c (seen from where they run anticlockwise: positive) d lies.
template <typename Int>
int side(const Point<Int>& a, const Point<Int>& b, const Point<Int>& c, const Point<Int>& d) {
  return sign(dot(cross(b - a, c - a), d - a));
}

template <typename Int>
using Triangle = std::array<Point<Int>, 3>;

template <typename Int>
Triangle<Int> about(LatticePoint origin, const LatticeTriangle& t) {
  Triangle<Int> points;
  for (std::size_t i = 0; i < 3; ++i)
    points[i] = {Int{t[i].x} - origin.x, Int{t[i].y} - origin.y, Int{t[i].z} - origin.z};
  return points;
}

struct Sides {
  std::array<int, 3> of;  // each corner: -1, 0 or 1
  bool apart() const {
    return (of[0] >= 0 && of[1] >= 0 && of[2] >= 0) || (of[0] <= 0 && of[1] <= 0 && of[2] <= 0);
  }
  bool flat() const { return of[0] == 0 && of[1] == 0 && of[2] == 0; }
};

template <typename Int>
Sides sidesOf(const Point<Int>& normal, const Point<Int>& in_plane, const Triangle<Int>& t) {
  return {{sign(dot(normal, t[0] - in_plane)), sign(dot(normal, t[1] - in_plane)),
           sign(dot(normal, t[2] - in_plane))}};
}

/// Turns a triangle so that corner 0 is alone on its side of the other's plane; says which side.
template <typename Int>
int turnAlone(Triangle<Int>& t, const Sides& sides) {
  for (std::size_t i = 0; i < 3; ++i) {
    const int mine = sides.of[i], next = sides.of[(i + 1) % 3], last = sides.of[(i + 2) % 3];
    if (mine != 0 && mine * next <= 0 && mine * last <= 0) {
      std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(i), t.end());
      return mine;
    }
  }
  return 0;  // not where corners lie on both sides
}

/// Two triangles in one plane, whose normal has its largest component along `axis`: no edge of either keeps
/// them apart.
template <typename Int>
bool overlap(const Triangle<Int>& a, const Triangle<Int>& b, int axis) {
  const auto flat = [axis](const Point<Int>& p) {
    return axis == 0 ? std::pair(p.y, p.z) : axis == 1 ? std::pair(p.z, p.x) : std::pair(p.x, p.y);
  };
  const auto keepsApart = [&](const Triangle<Int>& edges, const Triangle<Int>& other) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [px, py] = flat(edges[i]);
      const auto [qx, qy] = flat(edges[(i + 1) % 3]);
      const Int dx = qx - px, dy = qy - py;
      const auto turn = [&, x0 = px, y0 = py](const Point<Int>& p) {
        const auto at = flat(p);
        return sign(dx * (at.second - y0) - dy * (at.first - x0));
      };
      const int inside = turn(edges[(i + 2) % 3]);
      if (turn(other[0]) * inside <= 0 && turn(other[1]) * inside <= 0 && turn(other[2]) * inside <= 0)
        return true;
    }
    return false;
  };
  return !keepsApart(a, b) && !keepsApart(b, a);
}

template <typename Int>
Point<Int> normalOf(const LatticeTriangle& t) {
  const Triangle<Int> at = about<Int>(t[0], t);
  return cross(at[1], at[2]);
}

template <typename Int>
bool crossAbout(LatticePoint origin, const LatticeTriangle& first, const Point<Int>& normal_a,
                const LatticeTriangle& second, const Point<Int>& normal_b) {
  Triangle<Int> a = about<Int>(origin, first), b = about<Int>(origin, second);
  const Sides a_of_b = sidesOf(normal_b, b[0], a);
  if (a_of_b.apart() && !a_of_b.flat()) return false;
  const Sides b_of_a = sidesOf(normal_a, a[0], b);
  if (b_of_a.apart() && !b_of_a.flat()) return false;
  const auto area = [](const Point<Int>& n) { return n.x != 0 || n.y != 0 || n.z != 0; };
  if (!area(normal_a) || !area(normal_b)) return false;
  if (a_of_b.flat()) {
    const auto size = [](Int v) { return v < 0 ? -v : v; };
    const Int x = size(normal_a.x), y = size(normal_a.y), z = size(normal_a.z);
    return overlap(a, b, x >= y && x >= z ? 0 : y >= z ? 1 : 2);
  }
  // Each plane cuts the other triangle in a piece of the line that the planes share: the pieces must overlap.
  const int way_a = turnAlone(a, a_of_b), way_b = turnAlone(b, b_of_a);
  if (way_a < 0) std::swap(b[1], b[2]);
  if (way_b < 0) std::swap(a[1], a[2]);
  return side(a[0], a[1], b[0], b[1]) < 0 && side(a[0], a[2], b[2], b[0]) < 0;
}

template <typename Int>
bool piercesAbout(LatticePoint origin, LatticePoint from, LatticePoint to, const LatticeTriangle& triangle) {
  const Triangle<Int> t = about<Int>(origin, triangle);
  const auto point = [&](LatticePoint p) {
    return Point<Int>{Int{p.x} - origin.x, Int{p.y} - origin.y, Int{p.z} - origin.z};
  };
  const Point<Int> p = point(from), q = point(to);
  const Point<Int> normal = cross(t[1] - t[0], t[2] - t[0]);
  if ((dot(normal, p - t[0]) > 0) == (dot(normal, q - t[0]) > 0)) return false;
  const int s0 = side(p, q, t[0], t[1]), s1 = side(p, q, t[1], t[2]), s2 = side(p, q, t[2], t[0]);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

}  // namespace

bool near(const LatticeBox& a, const LatticeBox& b) {
  // With an extent E the products of a volume reach 6 E^3, which 64 bits hold.
  constexpr int kExtent = 1 << 20;
  const LatticePoint span = glm::max(a.high, b.high) - glm::min(a.low, b.low);
  return std::max({span.x, span.y, span.z}) < kExtent;
}

bool cross(const LatticeTriangle& a, const LatticeTriangle& b) {
  const LatticeBox box_a = boxOf(a), box_b = boxOf(b);
  if (!meet(box_a, box_b)) return false;
  if (near(box_a, box_b)) return crossNear(a, normalOf(a), b, normalOf(b));
  return crossAbout<Int128>(b[0], a, normalOf<Int128>(a), b, normalOf<Int128>(b));
}

glm::i64vec3 normalOf(const LatticeTriangle& triangle) {
  const Point<std::int64_t> normal = normalOf<std::int64_t>(triangle);
  return {normal.x, normal.y, normal.z};
}

bool crossNear(const LatticeTriangle& a, const glm::i64vec3& normal_a, const LatticeTriangle& b,
               const glm::i64vec3& normal_b) {
  return crossAbout<std::int64_t>(b[0], a, {normal_a.x, normal_a.y, normal_a.z}, b,
                                  {normal_b.x, normal_b.y, normal_b.z});
}

bool pierces(LatticePoint from, LatticePoint to, const LatticeTriangle& triangle) {
  const LatticeBox line = boxOf(from, to), box = boxOf(triangle);
  if (!meet(line, box)) return false;
  return near(line, box) ? piercesAbout<std::int64_t>(triangle[0], from, to, triangle)
                         : piercesAbout<Int128>(triangle[0], from, to, triangle);
}

}  // namespace espalier::sim
