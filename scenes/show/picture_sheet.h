#pragma once
#include <vector>

#include "render/image/image.h"
#include "scenes/show/pictures.h"

namespace espalier::scenes {

/// A contact sheet of the images that it names, from reductions of all the scene's images, in their order.
render::Image contactSheet(const PicturesWanted& wanted, const sim::LightAbout& about, const ImageSpec& sheet,
                           const std::vector<render::Image>& thumbnails);

}  // namespace espalier::scenes
