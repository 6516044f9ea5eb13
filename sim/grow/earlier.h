#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/bits.h"
#include "sim/base/voxel_set.h"
#include "sim/grow/plant.h"
#include "sim/world/world.h"

/// What stood before: plants and their world as they were after fewer iterations, by the births of nodes and
/// elements.
namespace espalier::sim {

/// A plant after so many iterations: the nodes that were born until then, their elements, and what its
/// process says of them. Its seed stands from the beginning.
Plant plantAfter(const Plant& plant, int iterations);

/// When each voxel that plants are in was first taken.
class VoxelBirths {
 public:
  /// Of all that grew in a world. A voxel in which none of a plant's segments and elements lies any more is
  /// as old as the youngest beside it.
  VoxelBirths(const World& world, std::span<const Plant> plants, int iterations);

  /// Bits of the world, such as World::occupied(), without what was taken after so many iterations.
  BitVolume after(const BitVolume& bits, int iterations) const;
  /// How many voxels were taken by then.
  std::size_t takenAfter(int iterations) const;

 private:
  VoxelSet where_;
  std::vector<std::int32_t> born_;  // of each
  std::vector<std::size_t> taken_;  // after each number of iterations
};

}  // namespace espalier::sim
