#include "render/model/spline.h"

#include <algorithm>
#include <numeric>

namespace espalier::render {
namespace {

std::vector<double> evenKnots(std::size_t count) {
  std::vector<double> knots(count);
  std::iota(knots.begin(), knots.end(), 0.0);
  return knots;
}

}  // namespace

Spline::Spline(std::span<const sim::Vec3> points, std::optional<sim::Vec3> start_derivative)
    : Spline(points, evenKnots(points.size()), start_derivative) {}

Spline::Spline(std::span<const sim::Vec3> points, std::vector<double> knots,
               std::optional<sim::Vec3> start_derivative)
    : points_(points.begin(), points.end()), bends_(points.size(), sim::Vec3(0.0)), knots_(std::move(knots)) {
  const std::size_t n = points_.size();
  if (n == 1) return;
  const auto width = [&](std::size_t i) { return knots_[i + 1] - knots_[i]; };
  const auto slope = [&](std::size_t i) { return (points_[i + 1] - points_[i]) / width(i); };
  // That first derivatives are the same on both sides of a point is a tridiagonal system of the bends, solved
  // from the start (Thomas).
  std::vector<double> upper(n, 0.0);
  if (start_derivative) {
    upper[0] = 0.5;
    bends_[0] = 3.0 / width(0) * (slope(0) - *start_derivative);
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double pivot = 2.0 * (width(i - 1) + width(i)) - width(i - 1) * upper[i - 1];
    upper[i] = width(i) / pivot;
    bends_[i] = (6.0 * (slope(i) - slope(i - 1)) - width(i - 1) * bends_[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 0;) bends_[i] -= upper[i] * bends_[i + 1];
}

Spline::Place Spline::placeAt(double t) const {
  const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, t);
  const auto i = static_cast<std::size_t>(above - knots_.begin()) - 1;
  const double width = knots_[i + 1] - knots_[i], before = (t - knots_[i]) / width;
  return {i, width, before, 1.0 - before};
}

sim::Vec3 Spline::position(double t) const {
  if (points_.size() == 1) return points_[0];
  const auto [i, h, b, a] = placeAt(t);
  return a * points_[i] + b * points_[i + 1] +
         h * h / 6.0 * ((a * a * a - a) * bends_[i] + (b * b * b - b) * bends_[i + 1]);
}

sim::Vec3 Spline::derivative(double t) const {
  if (points_.size() == 1) return sim::Vec3(0.0);
  const auto [i, h, b, a] = placeAt(t);
  return (points_[i + 1] - points_[i]) / h +
         h / 6.0 * ((3.0 * b * b - 1.0) * bends_[i + 1] - (3.0 * a * a - 1.0) * bends_[i]);
}

}  // namespace espalier::render
