#pragma once
#include <optional>
#include <vector>

#include "scenes/problem.h"
#include "scenes/scene.h"
#include "sim/world/world.h"

/// Regions that are named in files and that no mesh of the scene has.
namespace espalier::scenes {

/// In rule files, by their regions and senses: warnings, each with its place, for a rule file is made for
/// more than one scene. A guide's region is none that could be sensed.
std::vector<Problem> unknownRegions(const Scene& scene, const sim::World& world);

/// In the scene file, which knows its meshes: of each of its plants, whether its seeds should be scattered
/// over such a region.
std::vector<std::optional<Problem>> unknownToScatterOver(const Scene& scene, const sim::World& world);

}  // namespace espalier::scenes
