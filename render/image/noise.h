#pragma once
#include <vector>

#include <glm/vec3.hpp>

#include "sim/base/vec.h"

namespace espalier::render {

/// Smooth keyed noise in space, -1..1, repeating every 32 units: a small table, so that a look-up costs
/// little.
class Noise {
 public:
  static constexpr int kPeriod = 32;

  Noise();
  float operator()(sim::Vec3f p) const;
  /// The same with a period of its own along each axis, 1 to 32: for what is laid side by side.
  float tiled(sim::Vec3f p, glm::ivec3 period) const;

 private:
  template <class Wrap>
  float between(sim::Vec3f p, const Wrap& wrap) const;

  std::vector<float> table_;
};

}  // namespace espalier::render
