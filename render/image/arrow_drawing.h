#pragma once
#include <vector>

#include "render/image/camera.h"
#include "render/image/image.h"
#include "sim/base/vec.h"

/// Vectors in space as arrows through a camera, drawn over a picture of display values with three channels.
namespace espalier::render {

struct SpaceArrow {
  sim::Vec3 from_m{0.0}, to_m{0.0};
  bool hidden = false;  ///< something stands before it: it is drawn faintly
};

/// What is near lies over what is far and is a little darker; what lies behind the eye is left out. Each has
/// the colour of its way. `width_m`: of a shaft.
void drawArrows(Image& picture, const std::vector<SpaceArrow>& arrows, const Camera& camera, double width_m);

/// The colour of a way, display values: a mixture of those of the three axes by the squares of its parts, so
/// that opposite ways have the same. `way` is a unit vector.
sim::Colour colourOfWay(sim::Vec3 way);

}  // namespace espalier::render
