#pragma once
#include <cstddef>
#include <string>

#include "scenes/job/prepared.h"
#include "scenes/scene.h"
#include "sim/grow/grow.h"
#include "studio/wire/events.h"

/// What somebody wants to know of what has grown.
namespace espalier::studio {

/// What a scene's surfaces receive, with its plants in the way, as README.md has it. `bare`: the world before
/// anything grew. Throws Stopped.
std::string surfacesOf(Version version, const scenes::Scene& scene, const scenes::Site& site,
                       const sim::World& bare);

/// A cut through the boundary layers at right angles to an axis (0: x), as README.md has it. Throws InputError
/// where `at_m` is outside of the world.
std::string layersOf(Version version, const sim::World& bare, int axis, double at_m);

/// How a node of growth.plants[plant] came to be, and what the sites at it tried last: JSON, as README.md has
/// it. The plants are grown once more in a copy of `bare`, to where it happened. Throws InputError where
/// there is no such node; Stopped.
std::string whyOf(Version version, const sim::World& bare, const std::vector<sim::Planting>& plantings,
                  const sim::GrowthSettings& settings, const sim::Growth& growth, std::size_t plant,
                  sim::NodeId node);

}  // namespace espalier::studio
