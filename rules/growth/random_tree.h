#pragma once
#include <memory>

#include "rules/language/rule_set.h"
#include "sim/grow/rule.h"

namespace espalier::rules {

/// Greene's tree-structured random walk (1989, sections 3 and 4) as a growth process: each due bud makes
/// randomly perturbed trials of a segment, rejects those that do not meet `require`, and takes the one that
/// `prefer` ranks first. A branch leaves a node at `branch_angle` once the node's branch age is reached.
///
/// Where Greene's text leaves it open:
/// - growth rate with light: a bud at exposure e grows in an iteration with probability vigour(e) / boost, so
/// that
///   fully exposed buds grow in every iteration and dim ones `boost` times more rarely; segments keep their
///   length;
/// - trials beyond trials.min, made where none was good yet, wander farther and farther, up to twice the
/// angle;
/// - a bud all of whose trials fail retires, as around it the world only gets fuller; a seed tries again.
///
/// `voxel_m` turns lengths given in metres into voxel widths. Throws sim::InputError for a rule set that
/// cannot work (a segment longer than 60 voxel widths or shorter than 0.1).
std::unique_ptr<sim::Rule> makeRandomTree(std::shared_ptr<const RuleSet> rules, double voxel_m);

}  // namespace espalier::rules
