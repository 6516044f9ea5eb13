#pragma once
#include <span>
#include <vector>

#include "sim/world.h"

namespace espalier::sim {

enum class Fit { clear, blocked, outside };

/// What a new piece of a plant may touch: the limb that it grows from, and its own plant's stems right beside
/// the place where it is attached (siblings leave one node through the same voxels).
struct Attachment {
  Voxel at{0};
  PartId stem = kFree;            ///< the plant's own stems
  std::span<const Voxel> parent;  ///< voxels of the parent limb
};

/// Whether a tiled primitive intersects the world, its own attachment excepted. Approximate in the way that
/// voxels are: two things that do not touch but share a voxel count as intersecting (Greene, section 1).
Fit fits(const World& world, std::span<const Voxel> voxels, const Attachment& attachment);

inline bool besides(Voxel a, Voxel b) {
  const Voxel d = glm::abs(a - b);
  return d.x <= 1 && d.y <= 1 && d.z <= 1;
}

}  // namespace espalier::sim
