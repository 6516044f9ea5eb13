#include "rules/growth/random_tree.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "rules/growth/trial_judge.h"
#include "sim/sense/feelers.h"

namespace espalier::rules {
namespace {

using sim::Outcome;

/// Bits below a number of at most 64.
std::uint64_t below(int number) {
  return number >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << number) - 1;
}

/// Counts those of the first `count` that have no room.
void countFailed(const sim::Felt& felt, int count, sim::OutcomeCounts& trials) {
  const std::uint64_t counted = below(count);
  trials[static_cast<std::size_t>(Outcome::out_of_world)] +=
      static_cast<std::uint64_t>(std::popcount(felt.outside & counted));
  trials[static_cast<std::size_t>(Outcome::blocked)] +=
      static_cast<std::uint64_t>(std::popcount(~(felt.clear | felt.outside) & counted));
}

void record(TrialJudge& judge, const Surroundings& around, const sim::Offsets& ends, const sim::Felt& felt,
            int count, std::vector<sim::Attempt>& attempts) {
  for (int i = 0; i < count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const auto is = [&](std::uint64_t bits) { return (bits >> n & 1u) != 0; };
    const sim::Vec3 to_vx = sim::endOf(around.at_vx, ends, n);
    const Outcome outcome = is(felt.clear)     ? judge.judged(to_vx, felt.proximity_vx[n])
                            : is(felt.outside) ? Outcome::out_of_world
                                               : Outcome::blocked;
    attempts.push_back({around.at_vx, to_vx, outcome, false});
  }
}

}  // namespace

int reachOf(const Ways& ways) {
  return static_cast<int>(std::max(ways.length_vx.low, ways.length_vx.low + ways.length_vx.span)) + 1;
}

std::optional<Candidate> bestTrial(const sim::SiteView& view, const RuleSet& rules,
                                   const Surroundings& around, const Ways& ways, const Trials& trials,
                                   sim::Proposal& proposal) {
  const sim::Passage passage = trials.passage;
  const int plant = sim::numberOf(view.world, view.plant);
  thread_local sim::Room room;  // it keeps its memory
  sim::roomAround(view.world, around.voxel, reachOf(ways), around.attachment, passage, plant, room);
  TrialJudge judge(view, rules, around, reachOf(ways));
  std::optional<Candidate> best;
  double best_score = std::numeric_limits<double>::infinity();
  int best_trial = 0;
  const std::size_t recorded = proposal.attempts.size();  // of the sets before
  sim::Offsets ends;
  sim::Felt felt;
  // Without a preference any good one will do.
  const int enough = trials.first + (rules.prefer.any() ? trials.min : 1);
  // Where any good one will do, one of the first mostly does.
  constexpr int kFew = 16;
  for (int first = trials.first; first < trials.max && !(best && first >= enough);) {
    // Trials are made as if one by one: what is felt ahead of the one that ends them counts for nothing.
    const int until = first >= enough ? trials.max : std::max(enough, std::min(kFew, trials.max));
    const int ahead = std::min<int>(until - first, sim::Offsets::kMost);
    trialEnds(ways, static_cast<unsigned>(first), static_cast<std::size_t>(ahead), ends);
    sim::feel(view.world, room, around.at_vx, ends, static_cast<std::size_t>(ahead), felt);
    int count = best ? std::min(ahead, enough - first) : ahead;
    for (std::uint64_t clear = felt.clear; clear != 0; clear &= clear - 1) {
      const int i = std::countr_zero(clear);
      if (i >= count) break;
      const auto n = static_cast<std::size_t>(i);
      const double proximity_vx = felt.proximity_vx[n];
      const sim::Vec3 to_vx = sim::endOf(around.at_vx, ends, n);
      const Outcome outcome = judge.judged(to_vx, proximity_vx);
      ++proposal.trials[static_cast<std::size_t>(outcome)];
      if (outcome != Outcome::grown) continue;
      if (!best) count = std::min(ahead, std::max(enough - first, i + 1));
      const double score = judge.scoreOf(to_vx, proximity_vx);
      if (score < best_score) {
        best_score = score;
        best = Candidate{to_vx, {}, {}, passage, proximity_vx};
        best_trial = first + i - trials.first;
      }
    }
    countFailed(felt, count, proposal.trials);
    if (view.record_attempts) record(judge, around, ends, felt, count, proposal.attempts);
    first += count;
  }
  if (!best) return best;
  if (view.record_attempts) proposal.attempts[recorded + static_cast<std::size_t>(best_trial)].taken = true;
  sim::tileSegment(around.at_vx, best->to_vx, best->passes);
  sim::fit(view.world, best->passes, around.attachment, passage, plant, best->takes);
  return best;
}

std::optional<Candidate> bestStep(const sim::SiteView& view, const RuleSet& rules, const Surroundings& around,
                                  const Senses& senses, const sim::RandomKey& key, unsigned set,
                                  sim::Proposal& proposal) {
  const RandomTree& tree = rules.random_tree;
  return bestTrial(view, rules, around, waysOf(rules, around, senses, key, set, view.world.frame().size),
                   {0, tree.trials_min, tree.trials_max,
                    rules.require.clear ? sim::Passage::around : sim::Passage::through},
                   proposal);
}

}  // namespace espalier::rules
