#pragma once
#include <algorithm>

#include "sim/base/vec.h"

/// From linear light to the values a display wants. Float arithmetic only, so that pictures agree between
/// machines.
namespace espalier::render {

/// Of a channel; what lies outside 0..1 is clamped (IEC 61966-2-1).
float srgbFromLinear(float value);

inline sim::Colour srgbFromLinear(sim::Colour c) {
  return {srgbFromLinear(c.r), srgbFromLinear(c.g), srgbFromLinear(c.b)};
}

/// The part of Greene's "nonlinear colour table, making dark areas appear brighter" (1989, figure 5): opens
/// up the shadows and rolls the highlights off softly. Reinhard et al. 2002, "Photographic tone
/// reproduction", equation 4, on each channel, so that very bright colours fade towards white as on film.
struct ToneCurve {
  float exposure = 1.7f;  ///< multiplies the light first; > 0
  float white = 2.6f;     ///< the exposed value that becomes pure white; >= 1

  float operator()(float linear) const {
    const float v = std::max(0.0f, linear * exposure);
    return std::min(1.0f, v * (1.0f + v / (white * white)) / (1.0f + v));
  }
  /// Display values (sRGB, 0..1) of linear light.
  sim::Colour operator()(sim::Colour linear) const {
    return srgbFromLinear(sim::Colour((*this)(linear.r), (*this)(linear.g), (*this)(linear.b)));
  }
};

}  // namespace espalier::render
