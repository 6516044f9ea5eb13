#pragma once
#include "sim/base/vec.h"

namespace espalier::sim {

/// Linear light of a channel in sRGB (IEC 61966-2-1). Float arithmetic only: the same on every processor.
float linearFromSrgb(float srgb);

inline Colour linearFromSrgb(Colour srgb) {
  return {linearFromSrgb(srgb.r), linearFromSrgb(srgb.g), linearFromSrgb(srgb.b)};
}

}  // namespace espalier::sim
