#pragma once
#include "sim/grow/grow.h"

namespace espalier::sim {

/// Plants as seeds: a node each, and parts in the world. Throws PlantingFaults, and leaves the world as it
/// was, if a seed lies outside the world or inside something, or two of a name have the same key.
Growth seeded(World& world, const std::vector<Planting>& plantings, const GrowthSettings& settings);

}  // namespace espalier::sim
