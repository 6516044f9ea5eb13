#pragma once
#include "rules/growth/senses.h"
#include "rules/language/rule_set.h"
#include "sim/base/random.h"

/// Which way a trial goes, and how far.
namespace espalier::rules {

/// Where each of a trial's random numbers stands (sim::Slots). A new quantity goes to the end: so no plant
/// that does not use it changes.
enum class TrialSlot : unsigned {
  cone_turn,
  cone_height,
  length,
  wander,
  side_turn,
  side_angle,
  up,
  gravity,
  light,
  away,
  toward,
  twist
};

/// A rule's number for a trial: a range draws from the quantity's own slot.
double valueOf(const Value& value, const Circumstance& at, sim::Slots& slots, TrialSlot slot);

/// The unit direction of a trial: within `wander` of the way that the limb was going, or of a branch's way at
/// `branch_angle` to it, bent by each bias in the order of the rule language. `widening` stretches the
/// wander.
sim::Vec3 trialDirection(const RuleSet& rules, const Surroundings& around, const Senses& senses, bool branch,
                         double widening, sim::Slots& slots);

}  // namespace espalier::rules
