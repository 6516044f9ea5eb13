#pragma once
#include <cstdint>

#include "sim/base/vec.h"
#include "sim/grow/plant.h"

namespace espalier::render {

/// What a blade's colour may follow, each 0..1.
struct LeafPlace {
  float youth = 0.0f;   ///< 0 what the first iteration placed .. 1 the last
  float height = 0.0f;  ///< 0 the lowest of the plant's elements .. 1 its highest
};

/// By what a blade's colour is multiplied: each has its own shade and hue; young ones are lighter, those that
/// grew in the light yellower, those high on their plant golden. `piece` is its number; exposure 0..1.
sim::Colour leafTint(std::uint32_t piece, const LeafPlace& place, float exposure,
                     const sim::ColourVariation& varies);

}  // namespace espalier::render
