#include "render/model/spline.h"

#include <algorithm>
#include <cmath>

namespace espalier::render {
namespace {

struct Place {
  std::size_t span;
  double u;
};

Place placeAt(double t, std::size_t controls) {
  const double spans = static_cast<double>(controls) - 3.0;
  if (spans < 1) return {0, 0.0};
  const double span = std::clamp(std::floor(t), 0.0, spans - 1.0);
  return {static_cast<std::size_t>(span), t - span};
}

}  // namespace

Spline::Spline(std::span<const sim::Vec3> points, std::optional<sim::Vec3> start_derivative) {
  const std::size_t n = points.size();
  if (n == 1) {
    controls_.assign(3, points[0]);
    return;
  }
  // (c[i-1] + 4 c[i] + c[i+1]) / 6 = p[i] with the end conditions put in: tridiagonal, solved from the start
  // (Thomas). An end without curvature has its control point on the curve's own point.
  std::vector<sim::Vec3> c(n);
  std::vector<double> upper(n, 0.0);
  if (start_derivative) {
    upper[0] = 0.5;
    c[0] = 0.25 * (6.0 * points[0] + 2.0 * *start_derivative);
  } else {
    c[0] = points[0];
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double pivot = 4.0 - upper[i - 1];
    upper[i] = 1.0 / pivot;
    c[i] = (6.0 * points[i] - c[i - 1]) / pivot;
  }
  c[n - 1] = points[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) c[i] -= upper[i] * c[i + 1];

  controls_.reserve(n + 2);
  controls_.push_back(start_derivative ? c[1] - 2.0 * *start_derivative : 2.0 * c[0] - c[1]);
  controls_.insert(controls_.end(), c.begin(), c.end());
  controls_.push_back(2.0 * c[n - 1] - c[n - 2]);
}

sim::Vec3 Spline::position(double t) const {
  const auto [i, u] = placeAt(t, controls_.size());
  const double v = 1.0 - u;
  if (controls_.size() == 3) return controls_[1];
  return (v * v * v * controls_[i] + (3.0 * u * u * u - 6.0 * u * u + 4.0) * controls_[i + 1] +
          (3.0 * v * v * v - 6.0 * v * v + 4.0) * controls_[i + 2] + u * u * u * controls_[i + 3]) /
         6.0;
}

sim::Vec3 Spline::derivative(double t) const {
  const auto [i, u] = placeAt(t, controls_.size());
  const double v = 1.0 - u;
  if (controls_.size() == 3) return sim::Vec3(0.0);
  return (-v * v * controls_[i] + (3.0 * u * u - 4.0 * u) * controls_[i + 1] -
          (3.0 * v * v - 4.0 * v) * controls_[i + 2] + u * u * controls_[i + 3]) /
         2.0;
}

}  // namespace espalier::render
