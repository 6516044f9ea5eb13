#pragma once
#include "sim/base/vec.h"

namespace espalier::rules {

/// Light that a surface sends out by itself.
struct Emission {
  sim::Colour colour{1.0f};  ///< linear RGB
  double strength = 1.0;     ///< 1: as bright as white paper in full light

  sim::Colour light() const { return static_cast<float>(strength) * colour; }
};

}  // namespace espalier::rules
