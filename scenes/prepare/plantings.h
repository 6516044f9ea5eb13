#pragma once
#include <memory>
#include <vector>

#include "scenes/prepare/site.h"
#include "scenes/scene.h"
#include "sim/grow/grow.h"
#include "sim/grow/rule.h"

namespace espalier::scenes {

/// A scene's plants made ready to grow on a site.
struct Plantings {
  std::vector<std::unique_ptr<const sim::Rule>> rules;  ///< of the scene's plants, in their order
  std::vector<sim::Planting> seeds;                     ///< alike; each borrows its rule
};

/// Throws sim::InputError, naming the scene's file: for a rule set that cannot work at the site's voxel size,
/// for regions that no mesh has, for a region that is too small for the seeds scattered over it. Whether the
/// seeds stand in the open, sim::grow finds out.
Plantings makePlantings(const Scene& scene, const Site& site);

/// Settings that the scene gives; the caller adds progress and stop.
sim::GrowthSettings growthSettings(const Scene& scene, const Site& site);

}  // namespace espalier::scenes
