#pragma once
#include <vector>

#include "rules/growth/senses.h"
#include "rules/language/rule_set.h"
#include "sim/grow/process.h"

namespace espalier::rules {

/// Tries to place elements on a new segment, from around.at_vx to `to_vx`, that passes the voxels `segment`
/// and leaves the site's node: one at each place that phyllotaxis names, or an expected number that grows
/// with the light, as their size does (Greene's boost). Each is tried up to Element::trials times, in other
/// attitudes and by chance elsewhere, until one lies in no voxel of the scene that its segment does not pass,
/// crosses no other element and is pierced by no limb but its own (exactly: sim/sense/piece_grid.h), which
/// two things nobody asks of one that `crosses`.
/// `first_shape` is the plant's number of the rule set's first element.
std::vector<sim::ProposedElement> proposeElements(const sim::SiteView& view, const sim::Site& site,
                                                  const RuleSet& rules, const Surroundings& around,
                                                  const Senses& senses, sim::Vec3 to_vx,
                                                  const std::vector<sim::Voxel>& segment,
                                                  std::int32_t first_shape, const sim::RandomKey& key);

/// Whether a voxel is part of the scene.
bool isScene(const sim::World& world, sim::Voxel v);

/// The shapes that a rule set's elements place, in their order.
std::vector<sim::ElementShape> shapesOf(const RuleSet& rules);

}  // namespace espalier::rules
