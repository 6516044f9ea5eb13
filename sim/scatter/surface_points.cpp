#include "sim/scatter/surface_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/random.h"

namespace espalier::sim {
namespace {

enum Drawn : unsigned { kTriangle, kAcross, kAlong };

constexpr std::size_t kMostPoints = std::numeric_limits<std::uint32_t>::max();

void requireCount(std::size_t count) {
  if (count == 0 || count > kMostPoints)
    throw InputError(fmt::format("{} points on a surface; expected 1 to 2^32 - 1", count));
}

struct Point {
  Vec3 at, normal;
};

/// A mesh's triangles by their areas.
class Areas {
 public:
  explicit Areas(const Mesh& mesh) : mesh_(mesh) {
    sums_.reserve(mesh.triangles.size());
    double sum = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      sum += 0.5 * glm::length(cross(t));
      sums_.push_back(sum);
    }
    if (!(sum > 0.0) || !std::isfinite(sum)) {
      throw InputError(
          fmt::format("mesh '{}': has no surface to strew points over; expected triangles with "
                      "an area",
                      mesh.name));
    }
  }

  double total() const { return sums_.back(); }

  Point draw(std::uint64_t stream, std::uint32_t number) const {
    Slots slots({stream, number}, Purpose::attractor);
    const double sum = slots.uniform(kTriangle) * total();
    const auto at = std::upper_bound(sums_.begin(), sums_.end() - 1, sum);  // the first that ends beyond it
    const auto t = static_cast<std::size_t>(at - sums_.begin());
    const auto [a, b, c] = corners(t);
    const double across = std::sqrt(slots.uniform(kAcross)), along = slots.uniform(kAlong);
    return {a + across * ((1.0 - along) * (b - a) + along * (c - a)), glm::normalize(cross(t))};
  }

 private:
  std::array<Vec3, 3> corners(std::size_t t) const {
    const auto& v = mesh_.triangles[t];
    return {mesh_.vertices_m[v[0]], mesh_.vertices_m[v[1]], mesh_.vertices_m[v[2]]};
  }
  Vec3 cross(std::size_t t) const {
    const auto [a, b, c] = corners(t);
    return glm::cross(b - a, c - a);
  }

  const Mesh& mesh_;
  std::vector<double> sums_;  // of the areas up to and with each
};

/// Points that keep apart, by cells as wide as they do.
class Apart {
 public:
  explicit Apart(double spacing) : spacing_(spacing) {}

  /// Keeps the point where it is far enough from all others.
  bool keep(Vec3 p) {
    const Cell cell = cellOf(p);
    constexpr std::int64_t kSteps[] = {0, -1, 1};  // what is too near mostly lies in the same cell
    for (const std::int64_t y : kSteps) {
      for (const std::int64_t z : kSteps) {
        for (const std::int64_t x : kSteps) {
          const auto there = cells_.find(cell + Cell(x, y, z));
          if (there == cells_.end()) continue;
          for (const Vec3& other : there->second) {
            if (glm::distance(p, other) < spacing_) return false;
          }
        }
      }
    }
    cells_[cell].push_back(p);
    return true;
  }

 private:
  using Cell = glm::i64vec3;
  struct Hash {
    std::size_t operator()(const Cell& c) const {
      std::uint64_t h = 0;
      for (int axis = 0; axis < 3; ++axis)
        h = (h ^ static_cast<std::uint64_t>(c[axis])) * 0x9e3779b97f4a7c15u;
      return h ^ (h >> 32);
    }
  };

  Cell cellOf(Vec3 p) const { return Cell(glm::floor(p / spacing_)); }

  double spacing_;
  std::unordered_map<Cell, std::vector<Vec3>, Hash> cells_;
};

}  // namespace

PointSet scatterOn(const Mesh& mesh, std::size_t count, std::uint64_t stream) {
  requireCount(count);
  const Areas areas(mesh);
  PointSet points{std::vector<Vec3>(count), std::vector<Vec3>(count)};
  parallelFor(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Point point = areas.draw(stream, static_cast<std::uint32_t>(k));
      points.at[k] = point.at;
      points.normal[k] = point.normal;
    }
  });
  return points;
}

PointSet scatterApart(const Mesh& mesh, std::size_t count, double spacing, std::uint64_t stream, int waves) {
  requireCount(count);
  if (!(spacing > 0.0) || !std::isfinite(spacing))
    throw InputError(fmt::format("points {} apart; expected a number above 0", spacing));
  const Areas areas(mesh);
  constexpr double kFull = 0.7, kTimes = 30.0;  // of squares of the spacing, where no more points fit in
  PointSet points;
  for (int wave = 0; wave < waves; ++wave) {
    const double apart_by = std::ldexp(spacing, waves - 1 - wave);
    const double tries = std::ceil(kTimes * (1.0 + kFull * areas.total() / (apart_by * apart_by)));
    const auto most = static_cast<std::uint32_t>(std::min(tries, static_cast<double>(kMostPoints)));
    Apart apart(apart_by);
    for (const Vec3& at : points.at) apart.keep(at);  // as far apart as that they are
    for (std::uint32_t k = 0; k < most && points.at.size() < count; ++k) {
      const Point point = areas.draw(stream, k);
      if (!apart.keep(point.at)) continue;
      points.at.push_back(point.at);
      points.normal.push_back(point.normal);
      if (waves > 1) points.wave.push_back(wave);
    }
  }
  return points;
}

}  // namespace espalier::sim
