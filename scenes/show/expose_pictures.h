#pragma once
#include <vector>

#include "scenes/scene.h"
#include "sim/base/frame.h"
#include "sim/light/sun.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// A camera that shows all surfaces (or all of an empty world) from their sunny side, slightly above, and
/// fills a picture of this width over height.
NamedCamera overview(const sim::Frame& frame, const std::vector<sim::TiledVoxel>& surfaces,
                     const sim::Sun& sun, double aspect);

/// The panels that make sense for a scene's light, with a sun or without, for each camera, with a contact
/// sheet for each. A threshold for each of the plants that asks for another light than those before it.
std::vector<ImageSpec> exposureImages(const Scene& scene, const std::vector<NamedCamera>& cameras, bool sun);

}  // namespace espalier::scenes
