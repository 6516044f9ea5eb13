#pragma once
#include <cstdint>

#include "sim/base/vec.h"
#include "sim/grow/plant.h"

namespace espalier::render {

/// By what a blade's colour is multiplied: each has its own shade and hue; young ones are lighter, those that
/// grew in the light yellower. `piece` is its number; youth and exposure 0..1.
sim::Colour leafTint(std::uint32_t piece, float youth, float exposure, const sim::ColourVariation& varies);

}  // namespace espalier::render
