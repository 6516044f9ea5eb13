#pragma once
#include <vector>

#include "scenes/prepare/site.h"
#include "scenes/problem.h"
#include "scenes/scene.h"
#include "sim/grow/growth.h"

namespace espalier::scenes {

/// Where all seeds of a plant stand outside of the mesh whose inside its attractors fill, and that mesh
/// stands in their way: one warning a plant, with its place in the scene's file and the remedy. `plantings`:
/// from makePlantings.
std::vector<Problem> shutOutWarnings(const Scene& scene, const Site& site,
                                     const std::vector<sim::Planting>& plantings);

}  // namespace espalier::scenes
