#pragma once
#include <span>
#include <vector>

#include "sim/world/world.h"

namespace espalier::sim {

/// A highest place of a part of the scene: the middle of the voxels at its top.
struct Peak {
  PartId part = kFree;
  Vec3 at_vx{0.0};

  friend bool operator==(const Peak&, const Peak&) = default;
};

/// The peaks of these parts of the scene or of guides, by part and from the highest down: of each piece of a
/// part (voxels that touch, corners too) its top, and every other rise from which one must go down by
/// `prominence_vx` voxels at least to get to a higher one. A piece that is level all over has none.
std::vector<Peak> peaksOf(const World& world, std::span<const PartId> parts, int prominence_vx);

}  // namespace espalier::sim
