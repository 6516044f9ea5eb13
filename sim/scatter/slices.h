#pragma once
// Internal to the wing: an upright solid as a stack of slices.
#include <glm/vec2.hpp>

#include "sim/scatter/envelope.h"

namespace espalier::sim {

/// A solid cut across its axis. All as the solid's own sizes have it; the foot lies at 0.
struct Slice {
  double height = 0.0;
  double rise = 0.0;     ///< d height / d s
  glm::dvec2 half{0.0};  ///< half the width along x and z: of an ellipse, or of a rectangle
};

/// The slice at s in [0, 1], in which heights rise from the lowest to the highest: evenly, but of a
/// Revolution, where s is its curve's parameter.
Slice sliceAt(const Solid& solid, double s);
/// Its s where it has the height, which must lie between the lowest and the highest.
double sliceOf(const Solid& solid, double height);

/// Whether slices are rectangles.
bool isSquare(const Solid& solid);
/// The curve of a dome.
Revolution revolutionOf(const Dome& dome);

/// A cubic Bezier polynomial, and its derivative.
double bezier(const std::array<double, 4>& at, double s);
double bezierSlope(const std::array<double, 4>& at, double s);

}  // namespace espalier::sim
