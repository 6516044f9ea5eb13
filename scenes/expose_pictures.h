#pragma once
#include <vector>

#include "scenes/job.h"

namespace espalier::scenes {

/// A camera that shows a whole world from its sunny side, slightly above.
NamedCamera overview(const sim::World& world, const sim::Sun& sun, double aspect);

/// The panels that make sense for a scene's light, for each of its cameras, with a contact sheet for each.
std::vector<ImageSpec> exposureImages(const Scene& scene, const sim::Sun& sun);

}  // namespace espalier::scenes
