#include "rules/growth/random_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "rules/growth/elements.h"
#include "rules/growth/trial.h"
#include "sim/base/error.h"
#include "sim/sense/proximity.h"
#include "sim/tile/tiling.h"

namespace espalier::rules {
namespace {

using sim::Outcome;

// What a random key tells apart: trials of one rule set, and rule sets tried one after another.
constexpr std::uint32_t kTrialsOfOneSet = 10'000;
constexpr int kMostSets = 6;

// Single-precision: the same on every processor, unlike glibc's double functions.
double cosineOfDegrees(double degrees) {
  return std::cos(static_cast<float>(degrees * std::numbers::pi / 180.0));
}
double sineOfDegrees(double degrees) {
  return std::sin(static_cast<float>(degrees * std::numbers::pi / 180.0));
}

sim::Vec3 bent(sim::Vec3 direction, sim::Vec3 towards, double weight) {
  if (weight == 0.0 || towards == sim::Vec3(0.0)) return direction;
  const sim::Vec3 mixed = glm::mix(direction, towards, weight);
  const double length = glm::length(mixed);
  return length > 1e-9 ? mixed / length : direction;
}

void count(sim::OutcomeCounts& counts, Outcome outcome) {
  ++counts[static_cast<std::size_t>(outcome)];
}

struct Candidate {
  sim::Vec3 to_vx{0.0};
  std::vector<sim::Voxel> voxels;  // that it passes
  std::vector<sim::Voxel> takes;   // the free ones of them
  double proximity_vx = 0.0;
};

class RandomTreeRule final : public sim::Rule {
 public:
  RandomTreeRule(std::shared_ptr<const RuleSet> rules, double voxel_m)
      : rules_(std::move(rules)), voxel_m_(voxel_m) {
    gatherShapes(*rules_);
  }

  sim::Plant seedling() const override {
    sim::Plant plant;
    plant.shapes = shapes_;
    plant.stem_colour = rules_->stem_colour;
    plant.stem_radius_vx = rules_->stem_radius_vx;
    return plant;
  }

  sim::Proposal propose(const sim::GrowthView& view, const sim::Bud& bud,
                        const sim::RandomKey& key) const override;

 private:
  /// The rule set of the region that is nearest to the bud; null where nothing may grow.
  const RuleSet* rulesAt(const sim::World& world, sim::Voxel v) const;
  sim::Vec3 trialDirection(const RuleSet& rules, const Senses& senses, const sim::Bud& bud, double widening,
                           sim::Draws& draws) const;
  Outcome judge(const sim::GrowthView& view, const RuleSet& rules, const Senses& senses,
                Candidate& trial) const;
  std::optional<Candidate> bestTrial(const sim::GrowthView& view, const RuleSet& rules, const Senses& senses,
                                     const sim::Bud& bud, const sim::RandomKey& key,
                                     std::uint32_t first_trial, sim::Proposal& proposal) const;

  /// A plant has the shapes of every rule set that may come to bear on it.
  void gatherShapes(const RuleSet& rules) {
    if (first_shape_.contains(&rules)) return;
    first_shape_[&rules] = static_cast<std::int32_t>(shapes_.size());
    for (auto& shape : shapesOf(rules)) shapes_.push_back(std::move(shape));
    for (const auto& [region, rule] : rules.regions) {
      if (rule.rules) gatherShapes(*rule.rules);
    }
    if (rules.otherwise) gatherShapes(*rules.otherwise);
  }

  std::shared_ptr<const RuleSet> rules_;
  double voxel_m_;
  std::vector<sim::ElementShape> shapes_;
  std::map<const RuleSet*, std::int32_t> first_shape_;
};

const RuleSet* RandomTreeRule::rulesAt(const sim::World& world, sim::Voxel v) const {
  const auto nearness = world.nearnessAt(v);
  if (!nearness || rules_->regions.empty()) return rules_.get();
  const auto found = rules_->regions.find(world.part(nearness->part).region);
  if (found == rules_->regions.end()) return rules_.get();
  if (found->second.forbidden) return nullptr;
  return found->second.rules ? found->second.rules.get() : rules_.get();
}

sim::Vec3 RandomTreeRule::trialDirection(const RuleSet& rules, const Senses& senses, const sim::Bud& bud,
                                         double widening, sim::Draws& draws) const {
  sim::Vec3 direction;
  if (senses.heading == sim::Vec3(0.0)) {
    // A seed has no way of its own yet: a shoot makes for the open above, or along the wall that it stands
    // at.
    direction = draws.inCone(sim::Vec3(0, 1, 0), 0.5);
  } else {
    sim::Vec3 heading = senses.heading;
    if (bud.side) {
      const double angle = evaluate(rules.random_tree.branch_angle_deg, senses.circumstance, draws.uniform());
      const sim::Vec3 sideways =
          glm::normalize(glm::cross(heading, draws.onSphere()) + 1e-9 * sim::perpendicular(heading));
      heading = cosineOfDegrees(angle) * heading + sineOfDegrees(angle) * sideways;
    }
    const double wander = std::min(
        180.0, widening * evaluate(rules.random_tree.wander_deg, senses.circumstance, draws.uniform()));
    direction = draws.inCone(heading, cosineOfDegrees(wander));
  }
  const Bias& bias = rules.bias;
  const auto weight = [&](const Value& value) {
    return evaluate(value, senses.circumstance, draws.uniform());
  };
  direction = bent(direction, sim::Vec3(0, 1, 0), weight(bias.up));
  direction = bent(direction, sim::Vec3(0, -1, 0), weight(bias.gravity));
  direction = bent(direction, senses.light, weight(bias.light));
  direction = bent(direction, senses.away, weight(bias.away));
  direction = bent(direction, -senses.away, weight(bias.toward));
  const double twist = weight(bias.twist);
  return bent(direction, twist < 0.0 ? -senses.twist : senses.twist, std::abs(twist));
}

Outcome RandomTreeRule::judge(const sim::GrowthView& view, const RuleSet& rules, const Senses& senses,
                              Candidate& trial) const {
  trial.voxels.clear();
  sim::tileSegment(senses.at_vx, trial.to_vx, trial.voxels);
  const auto passage = rules.require.clear ? sim::Passage::around : sim::Passage::through;
  switch (sim::fit(view.world, trial.voxels, senses.attachment, passage, trial.takes)) {
    case sim::Fit::outside:
      return Outcome::out_of_world;
    case sim::Fit::blocked:
      return Outcome::blocked;
    case sim::Fit::clear:
      break;
  }
  // Tiling rounds, so that an end within 1/8192 of the rim may lie beyond it where its voxel does not.
  if (!sim::contains(view.world.frame().size, sim::voxelAt(trial.to_vx))) return Outcome::out_of_world;
  // One that folds back into its own limb would take nothing of the world, and so could grow for ever.
  if (trial.takes.empty()) return Outcome::blocked;
  trial.proximity_vx = sim::averageProximity(view.world, trial.voxels);
  if (trial.proximity_vx > rules.require.proximity_max_vx) return Outcome::too_far;
  if (trial.proximity_vx < rules.require.proximity_min_vx) return Outcome::too_near;
  return Outcome::grown;
}

std::optional<Candidate> RandomTreeRule::bestTrial(const sim::GrowthView& view, const RuleSet& rules,
                                                   const Senses& senses, const sim::Bud& bud,
                                                   const sim::RandomKey& key, std::uint32_t first_trial,
                                                   sim::Proposal& proposal) const {
  const RandomTree& tree = rules.random_tree;
  std::optional<Candidate> best;
  double best_score = std::numeric_limits<double>::infinity();
  Candidate trial;
  const int enough =
      rules.prefer.has_proximity ? tree.trials_min : 1;  // without a preference any good one will do
  for (int i = 0; i < tree.trials_max && !(best && i >= enough); ++i) {
    sim::Draws draws(key, bud.side ? sim::Purpose::branch : sim::Purpose::tip,
                     first_trial + static_cast<std::uint32_t>(i));
    // A tip that has not found a way among its first trials looks farther afield.
    const double widening =
        i < tree.trials_min ? 1.0 : 1.0 + (i - tree.trials_min + 1.0) / (tree.trials_max - tree.trials_min);
    const sim::Vec3 direction =
        flattened(trialDirection(rules, senses, bud, widening, draws), view.world.frame().size);
    if (direction == sim::Vec3(0.0)) continue;
    const double length = evaluate(tree.length.value, senses.circumstance, draws.uniform());
    trial.to_vx = senses.at_vx + direction * (tree.length.metres ? length / voxel_m_ : length);
    const Outcome outcome = judge(view, rules, senses, trial);
    count(proposal.trials, outcome);
    if (view.record_attempts) proposal.attempts.push_back({senses.at_vx, trial.to_vx, false});
    if (outcome != Outcome::grown) continue;
    const double score =
        rules.prefer.has_proximity ? std::abs(trial.proximity_vx - rules.prefer.proximity_vx) : i;
    if (score < best_score) {
      best_score = score;
      best = trial;
    }
  }
  return best;
}

sim::Proposal RandomTreeRule::propose(const sim::GrowthView& view, const sim::Bud& bud,
                                      const sim::RandomKey& key) const {
  sim::Proposal proposal;
  const auto stop = [&](Outcome outcome, bool retire) {
    proposal.outcome = outcome;
    proposal.retire = retire;
    return proposal;
  };
  const sim::Voxel at = sim::voxelAt(view.plant.skeleton.position_vx[static_cast<std::size_t>(bud.node)]);
  const RuleSet* rules = rulesAt(view.world, at);
  if (rules == nullptr) return stop(Outcome::forbidden, true);

  const Senses senses = sense(view, bud, *rules);
  proposal.exposure = static_cast<float>(senses.exposure);
  proposal.sky_exposure = static_cast<float>(senses.sky_exposure);
  proposal.sun_exposure = static_cast<float>(senses.sun_exposure);
  if (senses.exposure < rules->require.exposure_min) return stop(Outcome::too_dark, true);
  if (senses.exposure > rules->require.exposure_max) return stop(Outcome::too_bright, true);
  if (sim::Draws(key, sim::Purpose::rate).uniform() * std::max(1.0, rules->light.boost) >= senses.vigour) {
    return stop(Outcome::resting, false);
  }

  std::optional<Candidate> best = bestTrial(view, *rules, senses, bud, key, 0, proposal);
  for (std::uint32_t set = 1; !best && rules->otherwise; ++set) {
    rules = rules->otherwise.get();
    best = bestTrial(view, *rules, senses, bud, key, set * kTrialsOfOneSet, proposal);
  }
  const bool seed = senses.heading == sim::Vec3(0.0);
  if (!best) return stop(Outcome::no_trial, !seed);

  proposal.outcome = Outcome::grown;
  proposal.to_vx = best->to_vx;
  proposal.proximity_vx = static_cast<float>(best->proximity_vx);
  proposal.elements =
      proposeElements(view, *rules, senses, best->to_vx, best->voxels, first_shape_.at(rules), key);
  proposal.voxels = std::move(best->takes);
  if (view.record_attempts) proposal.attempts.push_back({senses.at_vx, proposal.to_vx, true});
  sim::Draws age(key, sim::Purpose::branch_age);
  proposal.sprouts = {
      {false, 1}, {true, age.whole(rules->random_tree.branch_age_min, rules->random_tree.branch_age_max)}};
  return proposal;
}

}  // namespace

std::unique_ptr<sim::Rule> makeRandomTree(std::shared_ptr<const RuleSet> rules, double voxel_m) {
  int sets = 0;
  for (const RuleSet* set = rules.get(); set != nullptr; set = set->otherwise.get()) {
    if (++sets > kMostSets) {
      throw sim::InputError(fmt::format(
          "rule set '{}': more than {} rule sets follow each other by 'otherwise'", rules->name, kMostSets));
    }
    const double unit = set->random_tree.length.metres ? voxel_m : 1.0;
    const double shortest = lowest(set->random_tree.length.value) / unit;
    const double longest = highest(set->random_tree.length.value) / unit;
    if (shortest < 0.1 || longest > 60.0) {
      throw sim::InputError(
          fmt::format("rule set '{}': random_tree.length is {:.3g} to {:.3g} voxel widths at a voxel of "
                      "{:.4g} m; expected 0.1 to 60",
                      set->name, shortest, longest, voxel_m));
    }
  }
  return std::make_unique<RandomTreeRule>(std::move(rules), voxel_m);
}

}  // namespace espalier::rules
