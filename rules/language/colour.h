#pragma once
#include <string>

#include "sim/base/srgb.h"
#include "sim/base/vec.h"

/// Colours in files are sRGB (IEC 61966-2-1), colours in memory are linear.
namespace espalier::rules {

using sim::linearFromSrgb;
sim::Colour srgbFromLinear(sim::Colour linear);
/// "#rrggbb", sRGB.
std::string hexFromLinear(sim::Colour linear);

}  // namespace espalier::rules
