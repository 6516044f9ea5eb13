#pragma once
#include <string>
#include <vector>

#include "scenes/job/report.h"
#include "scenes/job/seed_failure.h"

namespace espalier::scenes {

/// Which rule stopped a seed, and by how much: "no trial stayed within 3 voxel widths of the scene: the
/// nearest wall is 12 away".
std::string whyItDidNotGrow(const SeedFailure& failure);

/// Lines for a summary, at most 8 of them: each seed that did not grow, many of one reason in one line; and
/// plants that soon stopped where others of their planting made much more.
std::string poorPlants(const std::vector<Report::Growth::Plant>& plants);

/// ", 3 not of the age, region or senses that they require" of ends of buds; empty where there are none.
std::string unmetAmong(const sim::OutcomeCounts& ends);

}  // namespace espalier::scenes
