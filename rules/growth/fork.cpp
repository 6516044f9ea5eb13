#include <algorithm>
#include <bit>

#include "rules/growth/random_tree.h"
#include "rules/growth/trial_judge.h"
#include "sim/sense/feelers.h"

namespace espalier::rules {
namespace {

using sim::Outcome;

struct GoodTrial {
  sim::Vec3 to_vx{0.0};
  double proximity_vx = 0.0, score = 0.0;
};

/// All that meet the rules, the best first; counts what becomes of each.
std::vector<GoodTrial> goodTrials(const sim::SiteView& view, const RuleSet& rules, const Surroundings& around,
                                  const Ways& ways, const sim::Room& room, sim::Proposal& proposal) {
  std::vector<GoodTrial> good;
  TrialJudge judge(view, rules, around, reachOf(ways));
  sim::Offsets ends;
  sim::Felt felt;
  for (int first = 0; first < rules.random_tree.trials_max;) {
    const int count = std::min<int>(rules.random_tree.trials_max - first, sim::Offsets::kMost);
    trialEnds(ways, static_cast<unsigned>(first), static_cast<std::size_t>(count), ends);
    sim::feel(view.world, room, around.at_vx, ends, static_cast<std::size_t>(count), felt);
    for (int i = 0; i < count; ++i) {
      const auto n = static_cast<std::size_t>(i);
      const auto is = [&](std::uint64_t bits) { return (bits >> n & 1u) != 0; };
      const sim::Vec3 to_vx = sim::endOf(around.at_vx, ends, n);
      const double proximity_vx = felt.proximity_vx[n];
      const Outcome outcome = is(felt.clear)     ? judge.judged(to_vx, proximity_vx)
                              : is(felt.outside) ? Outcome::out_of_world
                                                 : Outcome::blocked;
      ++proposal.trials[static_cast<std::size_t>(outcome)];
      if (view.record_attempts) proposal.attempts.push_back({around.at_vx, to_vx, outcome, false});
      if (outcome == Outcome::grown)
        good.push_back({to_vx, proximity_vx, judge.scoreOf(to_vx, proximity_vx)});
    }
    first += count;
  }
  std::stable_sort(good.begin(), good.end(),
                   [](const GoodTrial& a, const GoodTrial& b) { return a.score < b.score; });
  return good;
}

/// Whether a tip stands so near behind a fork that it is not to fork itself.
bool forkedLately(const sim::SiteView& view, sim::NodeId node, int apart) {
  for (int segment = 0; segment < apart; ++segment) {
    node = view.plant.skeleton.parent[static_cast<std::size_t>(node)];
    if (node == sim::kNoNode) return false;
    int limbs = 0;
    view.kin.forEachChild(node, [&](sim::NodeId) { ++limbs; });
    if (limbs > 1) return true;
  }
  return false;
}

/// The voxels that limbs of one fork take: none may want another's, or one of them would have to wait and
/// find its way shut.
class Shared {
 public:
  Shared(const sim::SiteView& view, const Surroundings& around, sim::Passage passage)
      : view_(view), around_(around), passage_(passage) {}

  /// Whether there is room for one more, which has it then. Right beside the node limbs may meet.
  bool take(sim::Vec3 to_vx) {
    passes_.clear();
    takes_.clear();
    sim::tileSegment(around_.at_vx, to_vx, passes_);
    sim::fit(view_.world, passes_, around_.attachment, passage_, sim::numberOf(view_.world, view_.plant),
             takes_);
    std::erase_if(takes_, [&](sim::Voxel v) { return sim::besides(v, around_.voxel); });
    const auto is_taken = [&](sim::Voxel v) {
      return std::find(taken_.begin(), taken_.end(), v) != taken_.end();
    };
    if (std::any_of(takes_.begin(), takes_.end(), is_taken)) return false;
    taken_.insert(taken_.end(), takes_.begin(), takes_.end());
    return true;
  }

 private:
  const sim::SiteView& view_;
  const Surroundings& around_;
  sim::Passage passage_;
  std::vector<sim::Voxel> passes_, takes_, taken_;
};

}  // namespace

std::optional<Candidate> forkStep(const sim::SiteView& view, const RuleSet& rules, const Surroundings& around,
                                  const Senses& senses, const sim::RandomKey& key, unsigned set,
                                  sim::Proposal& proposal) {
  const RandomTree& tree = rules.random_tree;
  const bool alone = forkedLately(view, static_cast<sim::NodeId>(key.node), tree.fork_apart);
  if (alone && tree.fork_min > 1) return std::nullopt;
  const std::size_t most = alone ? 1 : static_cast<std::size_t>(tree.fork_max);
  const sim::Passage passage = rules.require.clear ? sim::Passage::around : sim::Passage::through;
  const int plant = sim::numberOf(view.world, view.plant);
  sim::RandomKey tip = key;
  tip.number = 0;
  const Ways ways = waysOf(rules, around, senses, tip, set, view.world.frame().size);
  thread_local sim::Room room;  // it keeps its memory
  sim::roomAround(view.world, around.voxel, reachOf(ways), around.attachment, passage, plant, room);
  const std::vector<GoodTrial> good = goodTrials(view, rules, around, ways, room, proposal);
  const double closest = sim::unitCircle(tree.fork_angle_deg / 360.0).x;
  // Of limbs that took the same voxels at once one had to wait: the others stand by now.
  std::vector<sim::Vec3> taken_ways;
  view.kin.forEachChild(static_cast<sim::NodeId>(key.node), [&](sim::NodeId child) {
    taken_ways.push_back(
        glm::normalize(view.plant.skeleton.position_vx[static_cast<std::size_t>(child)] - around.at_vx));
  });
  const std::size_t standing = taken_ways.size();
  std::vector<const GoodTrial*> taken;
  Shared room_left(view, around, passage);
  for (const GoodTrial& trial : good) {
    if (taken_ways.size() >= most) break;
    const sim::Vec3 way = glm::normalize(trial.to_vx - around.at_vx);
    if (std::any_of(taken_ways.begin(), taken_ways.end(),
                    [&](sim::Vec3 other) { return glm::dot(way, other) > closest; }))
      continue;
    if (!room_left.take(trial.to_vx)) continue;
    taken.push_back(&trial);
    taken_ways.push_back(way);
  }
  const std::size_t own_number = key.number - std::min<std::size_t>(key.number, standing);
  if (taken_ways.size() < static_cast<std::size_t>(tree.fork_min) || taken.size() <= own_number)
    return std::nullopt;
  const GoodTrial& own = *taken[own_number];
  if (view.record_attempts) {
    for (sim::Attempt& attempt : proposal.attempts)
      attempt.taken = attempt.taken || attempt.to_vx == own.to_vx;
  }
  Candidate candidate{own.to_vx, {}, {}, passage, own.proximity_vx};
  sim::tileSegment(around.at_vx, candidate.to_vx, candidate.passes);
  sim::fit(view.world, candidate.passes, around.attachment, passage, plant, candidate.takes);
  return candidate;
}

}  // namespace espalier::rules
