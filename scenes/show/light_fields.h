#pragma once
#include <vector>

#include "render/files/vdb.h"
#include "sim/light/lighting.h"

namespace espalier::scenes {

/// Light as grids for render::vdbBytes; all borrow what they are made from.

/// `sun_exposure` and `sky_exposure` on everything that stands in the world, and in the free voxels of
/// `around`.
std::vector<render::VdbField> worldFields(const sim::Lighting& light, const sim::VoxelSet& around);

/// On surfaces: `sky_exposure`, `sun_exposure`, `sun_hours`, `brightest`, `normal` and `part`; in free space
/// where the light knows it: `space_sky_exposure`, `space_sun_exposure` and `space_sun_hours`, for the voxels
/// of `space`. Grids of a sun are left out where there is none.
std::vector<render::VdbField> exposureFields(const sim::Lighting& light, const sim::VoxelSet* space);

}  // namespace espalier::scenes
