#pragma once
#include <vector>

#include "scenes/job/report.h"
#include "scenes/job/seed_failure.h"
#include "scenes/prepare/site.h"
#include "scenes/scene.h"

namespace espalier::scenes {

/// What there is to say of growth and of each plant, which stand in the site's world: `scene_voxels` is what
/// was occupied before them, `lights`
/// is what every seed saw then.
Report::Growth growthReport(const Scene& scene, const Site& site, const sim::BitVolume& scene_voxels,
                            const sim::Growth& growth, const std::vector<rules::Exposure>& lights);

}  // namespace espalier::scenes
