#pragma once
#include <span>

#include "sim/world.h"

namespace espalier::sim {

enum class Fit { clear, blocked, outside };

/// Whether a tiled primitive intersects the world, what it is attached to excepted. Approximate in the way
/// that voxels are: two things that do not touch but share a voxel count as intersecting (Greene, section 1).
/// `attachment`: voxels of the limbs that meet where the new piece begins.
Fit fits(const World& world, std::span<const Voxel> voxels, std::span<const Voxel> attachment);

/// The same voxel, or one of the 26 around it.
inline bool besides(Voxel a, Voxel b) {
  const Voxel d = glm::abs(a - b);
  return d.x <= 1 && d.y <= 1 && d.z <= 1;
}

}  // namespace espalier::sim
