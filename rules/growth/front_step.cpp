#include "rules/growth/front_step.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "rules/growth/trial_judge.h"
#include "sim/sense/proximity.h"
#include "sim/tile/tiling.h"

namespace espalier::rules {
namespace {

using sim::Outcome;

/// Whether something stands in a way that is no plant.
bool meetsTheScene(const sim::World& world, std::span<const sim::Voxel> passes) {
  return std::any_of(passes.begin(), passes.end(), [&](sim::Voxel v) {
    return sim::contains(world.frame().size, v) && world.occupied().at(v) &&
           world.part(world.partAt(v)).plant == sim::kNoPlant;
  });
}

/// A way alone, to the bit.
std::optional<Candidate> oneWay(const sim::SiteView& view, const RuleSet& rules, const Surroundings& around,
                                sim::Vec3 end_vx, sim::Passage passage, sim::Proposal& proposal) {
  Candidate candidate{end_vx, {}, {}, passage, 0.0};
  Outcome outcome = Outcome::out_of_world;
  if (sim::holds(view.world.frame().size, end_vx)) {
    sim::tileSegment(around.at_vx, end_vx, candidate.passes);
    const sim::Fit fit = sim::fit(view.world, candidate.passes, around.attachment, passage,
                                  sim::numberOf(view.world, view.plant), candidate.takes);
    outcome = Outcome::blocked;
    if (fit == sim::Fit::outside) outcome = Outcome::out_of_world;
    if (fit == sim::Fit::clear) {
      candidate.proximity_vx = sim::meanProximity(view.world, candidate.passes);
      TrialJudge judge(view, rules, around, static_cast<int>(glm::length(end_vx - around.at_vx)) + 1);
      outcome = judge.judged(end_vx, candidate.proximity_vx);
    }
  }
  ++proposal.trials[static_cast<std::size_t>(outcome)];
  if (view.record_attempts)
    proposal.attempts.push_back({around.at_vx, end_vx, outcome, outcome == Outcome::grown});
  return outcome == Outcome::grown ? std::optional(std::move(candidate)) : std::nullopt;
}

}  // namespace

std::optional<Candidate> frontStep(const sim::SiteView& view, const RuleSet& rules,
                                   const Surroundings& around, const Senses& senses, const Errand& errand,
                                   const sim::RandomKey& key, unsigned set, sim::Proposal& proposal) {
  const Colonization& front = rules.colonization;
  const bool another = errand.meets_another != kNobody;
  const sim::Passage passage =
      rules.require.clear && !another ? sim::Passage::past_own : sim::Passage::through;
  Ways ways;
  ways.numbers = sim::philoxInput(key, sim::Purpose::trial, set);
  ways.axis = sim::Vec3f(errand.direction);
  ways.length_vx = {static_cast<float>(glm::length(errand.end_vx - around.at_vx)), 0.0f};
  ways.wander_deg = {static_cast<float>(front.avoid_deg), 0.0f};
  ways.narrowly = 0.0f;
  ways.narrow = 1;
  ways.widest = front.trials;
  if (errand.gait == Gait::pulled && !front.onto && !errand.isMeeting())
    bendBy(rules, around, senses, view.world.frame().size, ways);
  // The first trial mostly is the last, and many at a time would cost more.
  sim::Vec3 end_vx = errand.end_vx;
  if (ways.pull_count > 0) {
    sim::Offsets bent;
    trialEnds(ways, 0, 1, bent);
    end_vx = sim::endOf(around.at_vx, bent, 0);
  }
  if (auto first = oneWay(view, rules, around, end_vx, passage, proposal)) {
    // What comes to another plant goes into its voxels, but through nothing else.
    if (!another || !rules.require.clear || !meetsTheScene(view.world, first->passes)) return first;
    return std::nullopt;
  }
  if (front.onto || errand.isMeeting()) return std::nullopt;
  return bestTrial(view, rules, around, ways, {1, 1, front.trials, passage}, proposal);
}

}  // namespace espalier::rules
