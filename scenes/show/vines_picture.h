#pragma once
#include "render/image/camera.h"
#include "render/image/image.h"
#include "scenes/show/pictures.h"

namespace espalier::scenes {

/// Whether any is one of vines.
bool drawsVines(const std::vector<ImageSpec>& images);
/// Whether an image of vines shows nothing that grew: it is lit as if nothing had.
bool showsNoPlant(const ImageSpec& image);

/// What an image of vines shows, in daylight; linear light (see render/finish/finished_picture.h).
render::Image vinesPicture(const ImageSpec& image, const Finished& finished, sim::Vec3 to_sun,
                           const render::Camera& camera, glm::ivec2 size_px);

}  // namespace espalier::scenes
