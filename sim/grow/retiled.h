#pragma once
#include <span>
#include <vector>

#include "sim/grow/plant.h"
#include "sim/world/world.h"

/// Plants that stand in another shape than the one in which they grew (StemForm).
namespace espalier::sim {

/// The voxels of a skeleton's segments, each once, in (y, z, x) order.
std::vector<Voxel> stemVoxels(const Skeleton& skeleton);

/// What a voxel of a plant's stems knows.
Surface stemSurface(const Plant& plant);

/// The world in which plants grew, with some of them in another shape. `before`: as it was before anything
/// grew; `plants`: all of them as they shall stand; `changed`: those whose stems are tiled anew. All else of
/// plants, elements too, is where it grew. The scene keeps its voxels. Throws BrokenContract for a stem that
/// leaves the world.
World retiled(World before, const World& grown, std::span<const Plant> plants,
              const std::vector<bool>& changed);

}  // namespace espalier::sim
