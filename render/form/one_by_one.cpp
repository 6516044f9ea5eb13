#include "render/form/one_by_one.h"

#include <algorithm>
#include <map>

#include "render/form/forks.h"
#include "render/form/stretch.h"
#include "render/model/radii.h"

namespace espalier::render {

using sim::NodeId;

namespace {

/// Adds points to the ways of a limb's nodes, at rising arcs, for other limbs to leave from.
void leaveFrom(const Stretch& limb, const std::vector<NodeId>& leaving, double apart, const sim::Skeleton& s,
               const KeptFree& blocked, std::vector<Reshaped>& ways) {
  const double most = limb.length() / static_cast<double>(leaving.size() + 1);
  for (std::size_t k = 0; k < leaving.size(); ++k) {
    const double arc = static_cast<double>(k + 1) * std::min(apart, most);
    const auto end = static_cast<std::size_t>(std::upper_bound(limb.arcs.begin(), limb.arcs.end() - 1, arc) -
                                              limb.arcs.begin());
    const auto node = static_cast<std::size_t>(leaving[k]);
    const sim::Vec3 place = limb.at(arc);
    if (enters(place, s.position_vx[node], blocked)) continue;
    Reshaped& way = ways[static_cast<std::size_t>(limb.nodes[end - 1])];
    const double share = (arc - limb.arcs[end - 1]) / (limb.arcs[end] - limb.arcs[end - 1]);
    ways[node].start = Reshaped::Start{limb.nodes[end - 1], way.through.size() - 1};
    way.through.insert(way.through.end() - 1, place);
    way.shares.insert(way.shares.end() - 1, share);
  }
}

}  // namespace

sim::Plant leavingOneByOne(const sim::Plant& plant, const KeptFree& blocked) {
  const sim::Skeleton& s = plant.skeleton;
  const std::vector<float> radii = stemRadii(s, plant.girth);
  const std::vector<Stretch> stretches = stretchesOf(s);
  std::map<NodeId, std::vector<std::size_t>> leaving;  // of each fork
  for (std::size_t i = 0; i < stretches.size(); ++i) leaving[stretches[i].from].push_back(i);
  std::vector<Reshaped> ways = asGrown(s);
  bool any = false;
  for (auto& [fork, of] : leaving) {
    if (of.size() <= 2 || s.parent[static_cast<std::size_t>(fork)] == sim::kNoNode) continue;
    const auto first = [&](std::size_t i) { return static_cast<std::size_t>(stretches[i].nodes.front()); };
    std::stable_sort(of.begin(), of.end(),
                     [&](std::size_t a, std::size_t b) { return radii[first(a)] > radii[first(b)]; });
    const Stretch& main = stretches[of.front()];
    if (main.length() <= 0.0) continue;
    any = true;
    std::vector<NodeId> others;
    for (std::size_t k = 2; k < of.size(); ++k) others.push_back(stretches[of[k]].nodes.front());
    const double apart = 2.0 * kStraightRadii * static_cast<double>(radii[static_cast<std::size_t>(fork)]);
    leaveFrom(main, others, apart, s, blocked, ways);
  }
  return any ? reshaped(plant, ways) : plant;
}

}  // namespace espalier::render
