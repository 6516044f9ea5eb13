#pragma once
#include <vector>

#include "rules/language/rule_set.h"
#include "sim/grow/grow.h"

/// Vines that grow on a plain wall.
namespace espalier::bench {

/// A wall twice as wide as it is high, 20 cm thick, with half a metre of air before it, of 2 cm voxels: as
/// large as so many segments cover.
sim::World wallFor(double segments);
/// Two a square metre.
std::vector<sim::Seed> seedsOn(const sim::World& world);
rules::RuleSet figureFour();
/// A sky of 128 and a sun of 48 directions, and no end.
sim::GrowthSettings settingsFor();

}  // namespace espalier::bench
