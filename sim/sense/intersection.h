#pragma once
#include <span>
#include <vector>

#include "sim/world/world.h"

namespace espalier::sim {

enum class Fit { clear, blocked, outside };

/// What a piece may do where something stands already.
enum class Passage {
  around,    ///< it must be clear of everything but what it is attached to
  past_own,  ///< it must be clear of everything but its own plant: twigs that are finer than a voxel
  through    ///< it may pass, and takes what is free
};

/// No plant's number (Part::plant).
inline constexpr int kNoPlant = -1;

/// Whether a tiled piece may be placed in the world, and the voxels that it would then take: those and no
/// others are claimed and occupied. It takes what is free, and what only elements are in whose first is of
/// its plant, by number: a plant's leaves give way to its limbs. Approximate in the way that
/// voxels are: two things that do not touch but share a voxel count as intersecting (Greene, section 1).
/// `attachment`: voxels of the limbs that meet where the new piece begins. Where the answer is not
/// Fit::clear, `takes` means nothing.
Fit fit(const World& world, std::span<const Voxel> piece, std::span<const Voxel> attachment, Passage passage,
        int plant, std::vector<Voxel>& takes);

/// The same voxel, or one of the 26 around it.
inline bool besides(Voxel a, Voxel b) {
  const Voxel d = glm::abs(a - b);
  return d.x <= 1 && d.y <= 1 && d.z <= 1;
}

}  // namespace espalier::sim
