#include "scenes/import/triangulate.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

namespace espalier::scenes {
namespace {

using Point = glm::dvec2;

double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Newell's normal: as long as twice the polygon's area.
sim::Vec3 normalOf(const std::vector<sim::Vec3>& corners) {
  sim::Vec3 normal(0.0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    normal += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  }
  return normal;
}

/// The corners without their coordinate along the polygon's steepest axis, counterclockwise. To drop a
/// coordinate, and not to turn, keeps corners on one line on one line.
std::vector<Point> flattened(const std::vector<sim::Vec3>& corners) {
  const sim::Vec3 normal = normalOf(corners);
  const sim::Vec3 steepness = glm::abs(normal);
  int axis = 0;
  for (int candidate : {1, 2}) {
    if (steepness[candidate] > steepness[axis]) axis = candidate;
  }
  const bool flip = normal[axis] < 0;
  std::vector<Point> points;
  points.reserve(corners.size());
  for (const auto& corner : corners) {
    const Point p(corner[(axis + 1) % 3], corner[(axis + 2) % 3]);
    points.push_back(flip ? Point(p.y, p.x) : p);
  }
  return points;
}

class EarClipper {
 public:
  explicit EarClipper(std::vector<Point> points)
      : points_(std::move(points)), next_(points_.size()), before_(points_.size()) {
    const auto n = static_cast<std::uint32_t>(points_.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      before_[i] = (i + n - 1) % n;
    }
  }

  std::vector<std::array<std::uint32_t, 3>> clip() {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::uint32_t at = 0;
    for (std::size_t left = points_.size(); left > 2; --left) {
      for (std::size_t tried = 0; tried < left && !isEar(at); ++tried)
        at = next_[at];  // with no ear, any will do
      const std::uint32_t a = before_[at];
      const std::uint32_t c = next_[at];
      triangles.push_back({a, at, c});
      next_[a] = c;
      before_[c] = a;
      at = next_[c];  // not the neighbour: fans of slivers look bad
    }
    return triangles;
  }

 private:
  /// Convex, and no other corner lies in the triangle or on its edges.
  bool isEar(std::uint32_t at) const {
    const Point& a = points_[before_[at]];
    const Point& b = points_[at];
    const Point& c = points_[next_[at]];
    if (turn(a, b, c) <= 0) return false;
    for (std::uint32_t i = next_[next_[at]]; i != before_[at]; i = next_[i]) {
      const Point& p = points_[i];
      if (p == a || p == b || p == c)
        continue;  // a polygon with a hole visits the corners of its bridge twice
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  std::vector<Point> points_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> before_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<sim::Vec3>& corners) {
  if (corners.size() == 3) return {{0, 1, 2}};
  return EarClipper(flattened(corners)).clip();
}

}  // namespace espalier::scenes
