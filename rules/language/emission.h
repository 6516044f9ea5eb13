#pragma once
#include "sim/base/vec.h"

namespace espalier::rules {

/// Light that a surface sends out by itself.
struct Emission {
  sim::Colour colour{1.0f};  ///< linear RGB
  double strength = 1.0;     ///< 1: as bright as white paper in full light

  sim::Colour light() const { return static_cast<float>(strength) * colour; }
};

/// The same of stems.
struct StemEmission : Emission {
  double order_share = 1.0;  ///< what of it is left with each order of branching
};

}  // namespace espalier::rules
