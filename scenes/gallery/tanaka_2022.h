#pragma once
#include <vector>

#include "scenes/gallery/figures.h"

namespace espalier::scenes {

/// Figures 2 to 9: how out-trees grow, and what bends them.
std::vector<GalleryFigure> tanaka2022Method();
/// Figures 10 to 22: what is modelled by them.
std::vector<GalleryFigure> tanaka2022Models();

}  // namespace espalier::scenes
