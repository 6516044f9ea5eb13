#pragma once
#include <vector>

#include "scenes/prepare/attractors.h"
#include "scenes/prepare/site.h"
#include "scenes/scene.h"
#include "sim/grow/grow.h"

namespace espalier::scenes {

/// A scene's plants made ready to grow on a site, in their order. Throws sim::InputError, naming the scene's
/// file: for a rule set that cannot work at the site's voxel size, for regions that no mesh has, for a region
/// that is too small for the seeds scattered over it, for a skeleton that does not stand in the world.
/// Whether the seeds stand in the open, sim::grow finds out.
std::vector<sim::Planting> makePlantings(const Scene& scene, const Site& site);

/// Settings that the scene gives, with the attractors that attractorsOf made; the caller adds progress and
/// stop.
sim::GrowthSettings growthSettings(const Scene& scene, const Site& site,
                                   const std::vector<NamedPoints>& attractors);

}  // namespace espalier::scenes
