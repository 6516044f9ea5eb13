#pragma once
#include <memory>
#include <string>

#include "rules/language/rule_set.h"
#include "sim/base/frame.h"

/// From what a rule file says to what a job's voxels make of it: the one place where a rule's length in
/// metres meets the voxel size. What grows sees voxel widths alone.
namespace espalier::rules {

/// A distance of a rule file in voxel widths.
double widths(const Distance& distance, double voxel_m);

/// A rule set and all that it may lead to with every length in voxel widths; a set that stands in several
/// places stays one. Throws sim::InputError for one that cannot work with such voxels, with the path that
/// leads to it ("otherwise.regions.brick"): a segment must be 0.1 to 60 voxel widths long, a twist look no
/// farther than 64, a twig be 1e-6 to 100 thick, an element's corners lie within 100,000, the
/// elements of one segment take a million voxels at most, and require.proximity.min be less than its max.
std::shared_ptr<const RuleSet> inVoxelWidths(const std::shared_ptr<const RuleSet>& rules, double voxel_m);

/// Throws sim::InputError where an element of a rule set in voxel widths, or of one that it may lead to, can
/// stand nowhere in the world: where it is longer than the world's diagonal even at its smallest.
void requireElementsFit(const RuleSet& rules, const sim::Frame& frame);

/// How many boundary layers a rule set needs, and what asks for them.
struct LayersNeeded {
  int layers = 0;
  std::string asked_by;       ///< "rule set 'ivy', otherwise: require.proximity.max is 12 voxel widths"
  double asked_m = kNoLimit;  ///< that distance, where it was written with a unit
};

/// Distances that a rule set and all that it may lead to ask for (require.proximity, prefer.proximity),
/// rounded up, and one more: beyond its last layer a world takes every voxel for one layer farther, so that a
/// limit is felt only where the layers reach it. A limit from `farthest_vx` on, which no voxel of the world
/// can be from another, is none and needs no layers.
LayersNeeded layersNeeded(const RuleSet& rules, double voxel_m, double farthest_vx);

}  // namespace espalier::rules
