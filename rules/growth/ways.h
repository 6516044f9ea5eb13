#pragma once
#include <array>

#include "rules/growth/angle_density.h"
#include "rules/growth/senses.h"
#include "rules/language/rule_set.h"
#include "sim/base/random.h"
#include "sim/sense/feelers.h"

/// Which way a site's trials go, and how far: all of them at once, in SIMD lanes.
///
/// Single precision in a fixed order, and end points on the lattice of 1/4096 voxel width that tiling has: so
/// they are the same on every processor, and what they cross is known exactly.
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
  twist,
  apex,
  towards,                       // the first of kMostPulls
  sensed = towards + kMostPulls  // the first of kMostSenses
};
inline constexpr std::size_t kTrialSlots = static_cast<std::size_t>(TrialSlot::sensed) + kMostSenses;

/// A rule's number over the trials of a site: low + span * the trial's own draw in [0, 1).
struct Spread {
  float low = 0.0f, span = 0.0f;
};
Spread spreadOf(const Value& value, const Circumstance& at);

/// Bends a direction d: to the unit vector along d (1 - w) + towards w; below 0, w bends it away from there.
struct Pull {
  sim::Vec3f towards{0.0f};  ///< unit
  Spread weight;             ///< -1 .. 1
  TrialSlot slot = TrialSlot::up;
};

/// What the trials of a site under one rule set have in common.
struct Ways {
  sim::PhiloxInput numbers;  ///< of trial 0
  sim::Vec3f axis{0, 1, 0};  ///< unit: the limb's way, or a seed's
  bool branch = false;       ///< leaves the axis at `side_angle_deg`, on a side by chance, before it wanders
  Spread side_angle_deg{}, wander_deg{};
  AngleDistribution wanders = AngleDistribution::cone;
  AngleDensity angles;  ///< where it is a table
  /// Trials below `narrow` wander up to `narrowly` times the angle; from there on farther and farther, up to
  /// once the angle more for trial `widest` - 1.
  int narrow = 0, widest = 0;
  float narrowly = 1.0f;
  std::array<Pull, 7 + kMostPulls + kMostSenses> pulls;  ///< in this order; only those that do anything
  std::size_t pull_count = 0;
  Spread length_vx;
  std::array<bool, 3> flat{};  ///< axes along which nothing may move: the world has a single voxel there
};

/// The ways of a site's tip (number 0) or side under a rule set whose lengths are voxel widths. `set` numbers
/// the rule sets that one site tries, from 0.
Ways waysOf(const RuleSet& rules, const Surroundings& around, const Senses& senses, const sim::RandomKey& key,
            unsigned set, sim::Voxel world_size);

/// What a rule set's biases bend all trials of a site by, and the axes along which nothing may move.
void bendBy(const RuleSet& rules, const Surroundings& around, const Senses& senses, sim::Voxel world_size,
            Ways& ways);

/// Ends of the trials `first` .. `first` + count - 1, by their offsets from where the site is.
void trialEnds(const Ways& ways, unsigned first, std::size_t count, sim::Offsets& ends);

}  // namespace espalier::rules
