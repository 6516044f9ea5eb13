#pragma once
#include <optional>
#include <span>
#include <vector>

#include "sim/base/vec.h"

namespace espalier::render {

/// A cubic spline that passes through its points, each at its own parameter. Twice continuously
/// differentiable.
class Spline {
 public:
  Spline() = default;  ///< to be given points later
  /// At least one point; point i is at parameter i. The curve ends without curvature, and begins so too
  /// unless its first derivative is given.
  explicit Spline(std::span<const sim::Vec3> points, std::optional<sim::Vec3> start_derivative = {});
  /// Point i at knot i; knots begin with 0 and rise.
  Spline(std::span<const sim::Vec3> points, std::vector<double> knots,
         std::optional<sim::Vec3> start_derivative = {});

  double last() const { return knots_.back(); }
  /// 0 <= t <= last()
  sim::Vec3 position(double t) const;
  sim::Vec3 derivative(double t) const;

 private:
  struct Place {
    std::size_t span;
    double width, before, after;  // of the span; shares of it that lie behind and before the place
  };
  Place placeAt(double t) const;

  std::vector<sim::Vec3> points_, bends_;  // a bend: the second derivative at a point
  std::vector<double> knots_;
};

}  // namespace espalier::render
