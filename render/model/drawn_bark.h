#pragma once
#include <memory>

#include "render/model/leaf_picture.h"
#include "sim/base/vec.h"

namespace espalier::render {

/// What rule files call it.
inline constexpr const char* kDrawnBark = "bark";

/// Bark in a colour, linear RGB: furrows along the stem (v), fine cracks across. It tiles; drawn once for all
/// who ask for the same. Throws InputError where OpenImageIO's module is missing.
std::shared_ptr<const LeafPicture> drawnBark(sim::Colour colour);

}  // namespace espalier::render
