#pragma once
#include <vector>

#include "render/voxels/visibility.h"

namespace espalier::render {

/// For each fragment the share of it, 0..1, that the sun in one direction lights directly; sky fragments get
/// 0. Edges of shadows are anti-aliased. `to_sun` must be of unit length.
std::vector<float> castShadows(const Visibility& seen, const sim::BitVolume& occupied,
                               const sim::Bricks& bricks, sim::Vec3 to_sun);

}  // namespace espalier::render
