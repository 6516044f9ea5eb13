#pragma once
#include <glm/mat3x3.hpp>

#include "scenes/scene.h"
#include "sim/base/vec.h"

namespace espalier::scenes {

/// From a file's space to world space: its numbers become metres, what is up in it becomes y, it is scaled
/// about the origin, turned about the x, then the y, then the z axis, and moved. Quarter turns are exact, and
/// so are units as far as doubles have them: 4 cm are 0.04 m.
class Placing {
 public:
  explicit Placing(const Placement& placement);

  sim::Vec3 point(const sim::Vec3& of_file) const;
  /// Turned alone.
  sim::Vec3 direction(const sim::Vec3& of_file) const { return turn_ * of_file; }
  /// A length of the file in metres.
  double length(double of_file) const { return inMetres(of_file) * scale_; }

 private:
  template <class Number>
  Number inMetres(const Number& of_file) const {
    return of_file * numerator_ / denominator_;
  }

  double numerator_,
      denominator_;  // of the unit; two, so that cm are divided: 4 / 100 is the nearest to 0.04
  double scale_;
  glm::dmat3 turn_;
  sim::Vec3 translate_m_;
};

}  // namespace espalier::scenes
