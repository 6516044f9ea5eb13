#pragma once
#include <memory>
#include <vector>

#include "scenes/prepare/attractors.h"
#include "scenes/prepare/site.h"
#include "scenes/scene.h"
#include "sim/grow/grow.h"

namespace espalier::scenes {

/// A scene's plants made ready to grow on a site, in their order. Throws PlacedError: for a rule set that
/// cannot work at the site's voxel size, for regions that no mesh has, for a region that is too small for the
/// seeds scattered over it, for a skeleton that does not stand in the world, for seeds that do not stand in
/// the open.
std::vector<sim::Planting> makePlantings(const Scene& scene, const Site& site);

/// The plantings that makePlantings made, seeded in the site's world. Throws PlacedError where one cannot
/// begin to grow.
std::unique_ptr<sim::Growing> beginGrowth(const Scene& scene, Site& site,
                                          const std::vector<sim::Planting>& plantings,
                                          const sim::GrowthSettings& settings);

/// Settings that the scene gives, with the attractors that attractorsOf made; the caller adds progress and
/// stop.
sim::GrowthSettings growthSettings(const Scene& scene, const Site& site,
                                   const std::vector<NamedPoints>& attractors);

}  // namespace espalier::scenes
