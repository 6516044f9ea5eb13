#pragma once
#include <memory>
#include <vector>

#include "rules/growth/given_tree.h"
#include "rules/language/rule_set.h"
#include "sim/base/frame.h"
#include "sim/grow/process.h"

namespace espalier::rules {

/// Trees that were made elsewhere as a growth process, one for each seed in their order: it places the
/// segments that it was given, all of them, and dresses them by a rule set: stems, and elements in the light
/// that there is. What the set says of how to grow (propagate, biases, trials, proximity) means nothing. A
/// segment stands bare where its set, by order and region, would not grow for the light or the region's rule.
///
/// A tree grows along its limbs, all of it within the iterations that are named. Segments hinder nobody and
/// nobody hinders them: what passes through the scene takes the free voxels of its way, and is counted among
/// the plant's trials as blocked, all others as grown. What lies right beside the root is not counted: a tree
/// stands on something.
///
/// Trees either all have radii, which models then take (sim::kRadiusColumn), or none. Their nodes must stand
/// in the world (standsIn). Throws sim::InputError for a rule set as makeProcess does.
std::shared_ptr<const sim::Process> makeGivenSkeleton(const std::shared_ptr<const RuleSet>& rules,
                                                      const sim::Frame& frame, std::vector<GivenTree> trees,
                                                      int iterations);

/// Whether a node has its voxel in a world of that size.
bool standsIn(sim::Voxel size, sim::Vec3 at_vx);

}  // namespace espalier::rules
