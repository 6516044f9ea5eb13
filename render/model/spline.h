#pragma once
#include <optional>
#include <span>
#include <vector>

#include "sim/base/vec.h"

namespace espalier::render {

/// A uniform cubic B-spline that passes through its points: point i at parameter i. Twice continuously
/// differentiable.
class Spline {
 public:
  Spline() = default;  ///< to be given points later
  /// At least one point. The curve ends without curvature, and begins so too unless its first derivative is
  /// given.
  explicit Spline(std::span<const sim::Vec3> points, std::optional<sim::Vec3> start_derivative = {});

  double last() const { return static_cast<double>(controls_.size()) - 3.0; }
  /// 0 <= t <= last()
  sim::Vec3 position(double t) const;
  sim::Vec3 derivative(double t) const;

 private:
  std::vector<sim::Vec3> controls_;  ///< one more than the points at either end
};

}  // namespace espalier::render
