#pragma once
#include "sim/world/world.h"

namespace espalier::sim {

/// Unit vector along which the distance to the scene grows fastest about a voxel; zero where nothing is near.
Vec3 awayFromScene(const World& world, Voxel v);

}  // namespace espalier::sim
