#include "rules/growth/random_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rules/growth/bend.h"
#include "sim/sense/intersection.h"
#include "sim/sense/proximity.h"
#include "sim/tile/tiling.h"

namespace espalier::rules {
namespace {

using sim::Outcome;

/// As sim::fit, but that leaves of the limb's own plant give way: their voxels are as free as empty ones.
sim::Fit fitLimb(const sim::SiteView& view, const Surroundings& around, Candidate& trial) {
  const sim::World& world = view.world;
  trial.takes.clear();
  for (const sim::Voxel v : trial.passes) {
    if (!sim::contains(world.frame().size, v)) return sim::Fit::outside;
    bool free = !world.occupied().at(v);
    if (!free && !world.solid().at(v)) {
      const sim::PartId part = world.partAt(v);
      const auto& own = view.plant.element_parts;
      free = std::find(own.begin(), own.end(), part) != own.end();
    }
    if (free) {
      trial.takes.push_back(v);
    } else if (trial.passage == sim::Passage::around &&
               std::find(around.attachment.begin(), around.attachment.end(), v) == around.attachment.end()) {
      return sim::Fit::blocked;
    }
  }
  return sim::Fit::clear;
}

/// Whether a trial meets the rules; fills in what it would take.
Outcome judge(const sim::SiteView& view, const RuleSet& rules, const Surroundings& around, Candidate& trial) {
  trial.passes.clear();
  sim::tileSegment(around.at_vx, trial.to_vx, trial.passes);
  trial.passage = rules.require.clear ? sim::Passage::around : sim::Passage::through;
  switch (fitLimb(view, around, trial)) {
    case sim::Fit::outside:
      return Outcome::out_of_world;
    case sim::Fit::blocked:
      return Outcome::blocked;
    case sim::Fit::clear:
      break;
  }
  // Tiling rounds, so that an end within 1/8192 of the rim may lie beyond it where its voxel does not.
  if (!sim::contains(view.world.frame().size, sim::voxelAt(trial.to_vx))) return Outcome::out_of_world;
  if (trial.takes.empty()) return Outcome::blocked;
  trial.proximity_vx = sim::averageProximity(view.world, trial.passes);
  if (trial.proximity_vx > rules.require.proximity_max_vx) return Outcome::too_far;
  if (trial.proximity_vx < rules.require.proximity_min_vx) return Outcome::too_near;
  return Outcome::grown;
}

}  // namespace

std::optional<Candidate> bestTrial(const sim::SiteView& view, const sim::Site& site, const RuleSet& rules,
                                   const Surroundings& around, const Senses& senses,
                                   const sim::RandomKey& key, unsigned set, double voxel_m,
                                   sim::Proposal& proposal) {
  const RandomTree& tree = rules.random_tree;
  std::optional<Candidate> best;
  double best_score = std::numeric_limits<double>::infinity();
  std::size_t best_attempt = 0;
  Candidate trial;
  const int enough =
      rules.prefer.has_proximity ? tree.trials_min : 1;  // without a preference any good one will do
  for (int i = 0; i < tree.trials_max && !(best && i >= enough); ++i) {
    sim::Slots slots(key, sim::Purpose::trial, set, static_cast<unsigned>(i));
    // A tip that has not found a way among its first trials looks farther afield.
    const double widening =
        i < tree.trials_min ? 1.0 : 1.0 + (i - tree.trials_min + 1.0) / (tree.trials_max - tree.trials_min);
    const sim::Vec3 direction = flattened(
        trialDirection(rules, around, senses, site.number != 0, widening, slots), view.world.frame().size);
    const double length = valueOf(tree.length.value, senses.circumstance, slots, TrialSlot::length);
    trial.to_vx = around.at_vx + direction * (tree.length.metres ? length / voxel_m : length);
    // Bent all the way to an axis that the world has not: out of it.
    const Outcome outcome =
        direction == sim::Vec3(0.0) ? Outcome::out_of_world : judge(view, rules, around, trial);
    ++proposal.trials[static_cast<std::size_t>(outcome)];
    if (view.record_attempts) proposal.attempts.push_back({around.at_vx, trial.to_vx, outcome, false});
    if (outcome != Outcome::grown) continue;
    const double score =
        rules.prefer.has_proximity ? std::abs(trial.proximity_vx - rules.prefer.proximity_vx) : 0.0;
    if (score < best_score) {
      best_score = score;
      best = trial;
      best_attempt = proposal.attempts.size() - 1;
    }
  }
  if (best && view.record_attempts) proposal.attempts[best_attempt].taken = true;
  return best;
}

}  // namespace espalier::rules
