#pragma once
#include <optional>
#include <vector>

#include "sim/base/vec.h"

namespace espalier::rules {

/// The point of some shapes that is nearest to a place, if it is nearer than `within_vx`; of shapes that are
/// equally near that of the first. `nearest_on(shape, at_vx)`: that of one.
template <typename Shape, typename NearestOn>
std::optional<sim::Vec3> nearestAmong(const std::vector<Shape>& shapes, sim::Vec3 at_vx, double within_vx,
                                      NearestOn nearest_on) {
  std::optional<sim::Vec3> nearest;
  double least = within_vx;
  for (const Shape& shape : shapes) {
    const sim::Vec3 on = nearest_on(shape, at_vx);
    const double far = glm::distance(on, at_vx);
    if (far >= least) continue;
    least = far;
    nearest = on;
  }
  return nearest;
}

}  // namespace espalier::rules
