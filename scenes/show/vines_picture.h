#pragma once
#include "render/image/camera.h"
#include "render/image/image.h"
#include "scenes/show/pictures.h"

namespace espalier::scenes {

/// Whether any is one of vines.
bool drawsVines(const std::vector<ImageSpec>& images);
/// Whether an image of vines shows nothing that grew: it is lit as if nothing had.
bool showsNoPlant(const ImageSpec& image);

struct VinesLook {
  sim::Vec3 to_sun{0.0, 1.0, 0.0};
  render::DaylightShare daylight;
  double bloom = 0.0;  ///< see render::bloom
};

/// What an image of vines shows, in daylight; linear light (see render/finish/finished_picture.h).
render::Image vinesPicture(const ImageSpec& image, const Finished& finished, const VinesLook& look,
                           const render::Camera& camera, glm::ivec2 size_px);

}  // namespace espalier::scenes
