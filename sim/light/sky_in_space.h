#pragma once
#include <optional>

#include "sim/light/random_sky.h"
#include "sim/light/sky.h"
#include "sim/world/field.h"

namespace espalier::sim {

/// What level ground would receive of the sky in free space, 0 .. kWhole: in all of it, or in the voxels of
/// `where`. By the random sky, if there is one, in place of the sky's directions.
ExposureField skyInSpace(const BitVolume& opaque, const Sky& sky, const std::optional<RandomSky>& random_sky,
                         std::shared_ptr<const VoxelSet> where = nullptr);

}  // namespace espalier::sim
