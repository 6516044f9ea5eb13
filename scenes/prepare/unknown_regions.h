#pragma once
#include <vector>

#include "scenes/problem.h"
#include "scenes/scene.h"
#include "sim/world/world.h"

/// Regions that are named in files and that no mesh of the scene has.
namespace espalier::scenes {

/// In rule files: warnings, each with its place, for a rule file is made for more than one scene.
std::vector<Problem> unknownRegions(const Scene& scene, const sim::World& world);

/// In the scene file, which knows its meshes: throws sim::InputError with the place of each region over which
/// seeds should be scattered and cannot be.
void requireRegionsToScatterOver(const Scene& scene, const sim::World& world);

}  // namespace espalier::scenes
