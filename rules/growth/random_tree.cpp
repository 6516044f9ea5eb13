#include "rules/growth/random_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rules/growth/ways.h"
#include "sim/sense/feelers.h"

namespace espalier::rules {
namespace {

using sim::Outcome;

/// What the rules say to a segment that was felt along.
Outcome judged(const RuleSet& rules, sim::Felt::Fate fate, double proximity_vx) {
  if (fate == sim::Felt::outside) return Outcome::out_of_world;
  if (fate == sim::Felt::blocked) return Outcome::blocked;
  if (proximity_vx > rules.require.proximity_max.number) return Outcome::too_far;
  if (proximity_vx < rules.require.proximity_min.number) return Outcome::too_near;
  return Outcome::grown;
}

/// The voxels that segments of a set may reach along any axis.
int reachOf(const Ways& ways) {
  return static_cast<int>(std::max(ways.length_vx.low, ways.length_vx.low + ways.length_vx.span)) + 1;
}

}  // namespace

std::optional<Candidate> bestTrial(const sim::SiteView& view, const RuleSet& rules,
                                   const Surroundings& around, const Senses& senses,
                                   const sim::RandomKey& key, unsigned set, sim::Proposal& proposal) {
  const RandomTree& tree = rules.random_tree;
  const sim::Passage passage = rules.require.clear ? sim::Passage::around : sim::Passage::through;
  const int plant = sim::numberOf(view.world, view.plant);
  const Ways ways = waysOf(rules, around, senses, key, set, view.world.frame().size);
  const sim::Room room =
      sim::roomAround(view.world, around.voxel, reachOf(ways), around.attachment, passage, plant);
  std::optional<Candidate> best;
  double best_score = std::numeric_limits<double>::infinity();
  std::size_t best_attempt = 0;
  sim::Offsets ends;
  sim::Felt felt;
  // Without a preference any good one will do.
  const int enough = rules.prefer.has_proximity ? tree.trials_min : 1;
  // Where any good one will do, one of the first mostly does.
  constexpr int kFew = 16;
  const auto done = [&](int trial) { return trial >= tree.trials_max || (best && trial >= enough); };
  for (int first = 0; !done(first);) {
    // Trials are made as if one by one: what is felt ahead of the one that ends them counts for nothing.
    const int until = first >= enough ? tree.trials_max : std::max(enough, std::min(kFew, tree.trials_max));
    const int count = std::min<int>(until - first, sim::Offsets::kMost);
    trialEnds(ways, static_cast<unsigned>(first), static_cast<std::size_t>(count), ends);
    sim::feel(view.world, room, around.at_vx, ends, static_cast<std::size_t>(count), felt);
    int i = 0;
    for (; i < count && !done(first + i); ++i) {
      const auto n = static_cast<std::size_t>(i);
      const double proximity_vx = felt.fate[n] == sim::Felt::clear ? double{felt.proximity_vx[n]} : 0.0;
      const Outcome outcome = judged(rules, felt.fate[n], proximity_vx);
      ++proposal.trials[static_cast<std::size_t>(outcome)];
      if (view.record_attempts) {
        proposal.attempts.push_back({around.at_vx, sim::endOf(around.at_vx, ends, n), outcome, false});
      }
      if (outcome != Outcome::grown) continue;
      const double score =
          rules.prefer.has_proximity ? std::abs(proximity_vx - rules.prefer.proximity.number) : 0.0;
      if (score < best_score) {
        best_score = score;
        best = Candidate{sim::endOf(around.at_vx, ends, n), {}, {}, passage, proximity_vx};
        best_attempt = proposal.attempts.size() - 1;
      }
    }
    first += i;
  }
  if (!best) return best;
  if (view.record_attempts) proposal.attempts[best_attempt].taken = true;
  sim::tileSegment(around.at_vx, best->to_vx, best->passes);
  sim::fit(view.world, best->passes, around.attachment, passage, plant, best->takes);
  return best;
}

}  // namespace espalier::rules
