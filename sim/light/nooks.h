#pragma once
#include "sim/world/world.h"

namespace espalier::sim {

/// The free voxels in the stairs of walls that slant. A step of the stairs hides there what lies low along
/// the wall, which the wall itself does not; so what is seen from there says little of a floor at its foot.
/// Only walls that are plain for a voxel around count: where several faces meet in a voxel its normal says
/// nothing of stairs.
BitVolume nooksOf(const World& world);

}  // namespace espalier::sim
