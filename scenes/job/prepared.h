#pragma once
#include <vector>

#include "scenes/job/report.h"
#include "scenes/job/run.h"
#include "scenes/job/stages.h"
#include "scenes/prepare/plantings.h"
#include "scenes/prepare/site.h"

namespace espalier::scenes {

/// What shall grow on a site.
struct Plans {
  std::vector<sim::Planting> plantings;
  std::vector<NamedPoints> attractors;
  std::vector<rules::Exposure> seed_lights;  ///< what every seed sees before anything grows
  std::vector<Problem> warnings;             ///< of all that a run on this site warns of before it grows
};

/// Throws PlacedError with all that is wrong with the scene on its site.
Plans plansOn(const Scene& scene, const Site& site, const RunOptions& options);

/// A scene's site, and what shall grow on it or has grown there.
struct Prepared : Plans {
  Site site;
};

/// Tiles a scene and makes ready what grows on it; tells the report of the world, and of what the run warns.
/// Throws PlacedError with all that is wrong with the site.
Prepared prepare(const Scene& scene, const RunOptions& options, Report& report, Stages& stages);

}  // namespace espalier::scenes
