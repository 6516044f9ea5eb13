#pragma once
#include "sim/base/picture.h"

namespace espalier::render {

/// Across it UVs go from 0 to 1, v upwards.
using LeafPicture = sim::Picture;

/// Where its alpha is below this, there is no blade.
inline constexpr float kCutout = 0.5f;

}  // namespace espalier::render
