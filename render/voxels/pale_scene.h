#pragma once
#include "render/image/image.h"
#include "render/voxels/visibility.h"

namespace espalier::render {

/// A sheet of paper, of display values.
Image paper(int width_px, int height_px);

/// What a camera sees, in pale grey on paper: a ground to draw on. `occupied` is what was seen.
Image paleScene(const Visibility& seen, const sim::BitVolume& occupied);

}  // namespace espalier::render
