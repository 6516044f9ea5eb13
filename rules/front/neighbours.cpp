#include "rules/front/neighbours.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "rules/front/attractor_tree.h"
#include "sim/base/parallel.h"

namespace espalier::rules {
namespace {

double square(double x) {
  return x * x;
}

bool isWaiting(const Attractors& attractors, std::size_t at) {
  return attractors.fate[at] == static_cast<std::int32_t>(Fate::waiting);
}

/// All nodes by place.
class NodeTree {
 public:
  explicit NodeTree(std::span<const sim::Vec3> nodes) : tree_(sortedAttractors(nodes)) {}

  /// Whether one of them is nearer to both places than this.
  bool holdsNear(sim::Vec3 a, sim::Vec3 b, double within2) const {
    return !tree_.first.empty() && holdsNear(0, a, b, within2);
  }

 private:
  /// Never more than distance2 of anything in it, whichever way that rounds.
  bool mayHoldNear(std::size_t part, sim::Vec3 p, double within2) const {
    const sim::Vec3 near = glm::clamp(p, tree_.low[part], tree_.high[part]);
    return distance2(near, p) * (1.0 - 1e-12) < within2;
  }
  bool holdsNear(std::size_t part, sim::Vec3 a, sim::Vec3 b, double within2) const {
    if (!mayHoldNear(part, a, within2) || !mayHoldNear(part, b, within2)) return false;
    if (tree_.children[part] == 0) {
      for (std::int32_t i = tree_.first[part]; i < tree_.last[part]; ++i) {
        const sim::Vec3 at = tree_.at(i);
        if (distance2(at, a) < within2 && distance2(at, b) < within2) return true;
      }
      return false;
    }
    for (std::int32_t c = 0; c < tree_.children[part]; ++c) {
      if (holdsNear(asIndex(tree_.child[part] + c), a, b, within2)) return true;
    }
    return false;
  }

  Attractors tree_;
};

/// Of one attractor.
struct Neighbour {
  std::int32_t node = 0;
  Link link = Link::pulls;
  double away2 = 0.0;
};

struct Arrival {
  std::int32_t node = 0, from = 0;
};

/// One attractor's part of a meeting: its own, so that threads do not meet.
struct Kept {
  std::vector<Neighbour> neighbours;  ///< ascending
  std::vector<Arrival> arrived;       ///< likewise
  bool ends = false;
};

class NeighbourMeeting {
 public:
  NeighbourMeeting(Front& front, std::span<const std::int32_t> fresh, std::span<const std::int32_t> parents,
                   const OrderRules& rules)
      : front_(front), fresh_(fresh), parents_(parents), rules_(rules), tree_(front.nodes) {}

  /// The attractor of this number, of which the links from `first` to `last` are known.
  Kept meet(std::int32_t number, std::size_t first, std::size_t last, std::vector<Arrival> arrived) {
    const sim::Vec3 at = placeOf(number);
    Kept kept;
    kept.arrived = std::move(arrived);
    std::vector<Neighbour> old;
    for (std::size_t i = first; i < last; ++i) {
      const std::int32_t node = front_.links.node[i];
      old.push_back(
          {node, static_cast<Link>(front_.links.state[i]), distance2(front_.nodes[asIndex(node)], at)});
    }
    kept.neighbours = old;
    for (std::size_t i = 0; i < fresh_.size(); ++i) meetOne(i, at, old, kept);
    change(old, kept.neighbours, at, -1);
    change(kept.neighbours, old, at, 1);
    std::sort(kept.neighbours.begin(), kept.neighbours.end(),
              [](const Neighbour& a, const Neighbour& b) { return a.node < b.node; });
    std::sort(kept.arrived.begin(), kept.arrived.end(),
              [](const Arrival& a, const Arrival& b) { return a.node < b.node; });
    kept.ends = endsBy(kept.neighbours);
    return kept;
  }

 private:
  sim::Vec3 placeOf(std::int32_t number) const {
    return front_.attractors.at(front_.attractors.place[asIndex(number)]);
  }
  const FrontRules& rulesOf(std::int32_t node) const { return rules_.at(front_.order[asIndex(node)]); }
  bool isNear(std::int32_t node, double away2) const { return away2 < square(rulesOf(node).kill); }

  static bool endsBy(const std::vector<Neighbour>& all) {
    const auto is = [](Link link) { return [link](const Neighbour& one) { return one.link == link; }; };
    return std::any_of(all.begin(), all.end(), is(Link::near)) &&
           std::none_of(all.begin(), all.end(), is(Link::pulls));
  }

  void meetOne(std::size_t i, sim::Vec3 at, const std::vector<Neighbour>& old, Kept& kept) {
    const std::int32_t node = fresh_[i];
    const sim::Vec3 place = front_.nodes[asIndex(node)];
    const double away2 = distance2(place, at);
    const std::int32_t parent = parents_.empty() ? kNobody : parents_[i];
    const bool near = isNear(node, away2);
    if (parent != kNobody && near && isPulled(old, parent)) kept.arrived.push_back({node, parent});
    std::erase_if(kept.neighbours, [&](const Neighbour& one) {
      return away2 < one.away2 && distance2(place, front_.nodes[asIndex(one.node)]) < one.away2;
    });
    if (away2 >= square(rulesOf(node).influence)) return;
    if (isBlocked(place, away2, parent, at, kept)) return;
    const auto known = std::find_if(kept.neighbours.begin(), kept.neighbours.end(),
                                    [&](const Neighbour& one) { return one.node == node; });
    if (known == kept.neighbours.end()) {
      kept.neighbours.push_back({node, near ? Link::near : Link::pulls, away2});
    } else if (known->link == Link::near && !near) {  // the kill distance is another in this wave
      known->link = Link::pulls;
    }
  }

  /// Mostly its parent stands between, or who is a neighbour already.
  bool isBlocked(sim::Vec3 place, double away2, std::int32_t parent, sim::Vec3 at, const Kept& kept) const {
    if (parent != kNobody) {
      const sim::Vec3 before = front_.nodes[asIndex(parent)];
      if (distance2(before, at) < away2 && distance2(before, place) < away2) return true;
    }
    for (const Neighbour& one : kept.neighbours) {
      if (one.away2 < away2 && distance2(front_.nodes[asIndex(one.node)], place) < away2) return true;
    }
    return tree_.holdsNear(at, place, away2);
  }

  static bool isPulled(const std::vector<Neighbour>& all, std::int32_t node) {
    return std::any_of(all.begin(), all.end(),
                       [&](const Neighbour& one) { return one.node == node && one.link == Link::pulls; });
  }
  /// Those pulled of some that are not among others.
  void change(const std::vector<Neighbour>& some, const std::vector<Neighbour>& others, sim::Vec3 at,
              int sign) {
    for (const Neighbour& one : some) {
      if (one.link == Link::pulls && !isPulled(others, one.node))
        addPull(front_.pulls, one.node, front_.nodes[asIndex(one.node)], at, sign);
    }
  }

  Front& front_;
  std::span<const std::int32_t> fresh_, parents_;
  const OrderRules& rules_;
  NodeTree tree_;
};

/// Which of what is sorted by attractors belong to each number: from, to.
class Runs {
 public:
  Runs(const std::vector<std::int32_t>& sorted, std::int32_t count) : first_(asIndex(count) + 1) {
    for (const std::int32_t number : sorted) ++first_[asIndex(number) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
  }
  std::size_t from(std::size_t number) const { return first_[number]; }
  std::size_t to(std::size_t number) const { return first_[number + 1]; }

 private:
  std::vector<std::size_t> first_;
};

std::vector<Arrival> arrivalsAt(const Links& links, std::int32_t number) {
  const auto [first, last] = std::equal_range(links.arrived_at.begin(), links.arrived_at.end(), number);
  std::vector<Arrival> found;
  for (auto at = first; at != last; ++at) {
    const auto i = static_cast<std::size_t>(at - links.arrived_at.begin());
    found.push_back({links.arrived[i], links.arrived_from[i]});
  }
  return found;
}

/// An attractor ends, and those that arrived there meet.
void endAt(Front& front, std::int32_t number, std::span<const Arrival> arrived, Fate fate, int iteration) {
  for (std::size_t i = 1; i < arrived.size() && fate == Fate::reached; ++i) {
    const auto& [node, from] = arrived[i];
    const auto& [first, first_from] = arrived[0];
    if (from == first || from == first_from || front.nodes[asIndex(node)] == front.nodes[asIndex(first)])
      continue;
    front.links.meetings.from.push_back(node);
    front.links.meetings.to.push_back(first);
  }
  end(front.attractors, front.attractors.place[asIndex(number)], fate, iteration, front.nodes, front.pulls);
}

sim::Vec3 placeOf(const Front& front, std::int32_t number) {
  return front.attractors.at(front.attractors.place[asIndex(number)]);
}

/// Takes what is kept of an attractor out.
void forget(Links& links, std::int32_t number) {
  const auto cut = [number](std::vector<std::int32_t>& by,
                            std::initializer_list<std::vector<std::int32_t>*> with) {
    const auto [first, last] = std::equal_range(by.begin(), by.end(), number);
    const auto from = first - by.begin(), to = last - by.begin();
    for (std::vector<std::int32_t>* other : with) other->erase(other->begin() + from, other->begin() + to);
    by.erase(first, last);
  };
  cut(links.attractor, {&links.node, &links.state});
  cut(links.arrived_at, {&links.arrived, &links.arrived_from});
}

}  // namespace

void meetNeighbours(Front& front, std::span<const std::int32_t> fresh, std::span<const std::int32_t> parents,
                    const OrderRules& rules) {
  if (fresh.empty()) return;
  const Attractors& attractors = front.attractors;
  const auto count = asIndex(attractors.size());
  const Runs runs(front.links.attractor, attractors.size());
  std::vector<Kept> kept(count);  // by number
  NeighbourMeeting meeting(front, fresh, parents, rules);
  sim::parallelFor(count, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      if (!isWaiting(attractors, asIndex(attractors.place[n]))) continue;
      const auto number = static_cast<std::int32_t>(n);
      kept[n] = meeting.meet(number, runs.from(n), runs.to(n), arrivalsAt(front.links, number));
    }
  });
  Links links;
  links.meetings = std::move(front.links.meetings);
  front.links = std::move(links);
  for (std::size_t n = 0; n < count; ++n) {
    const auto number = static_cast<std::int32_t>(n);
    if (kept[n].ends) {
      endAt(front, number, kept[n].arrived, Fate::reached, rules.trunk().iteration);
      continue;
    }
    for (const Neighbour& one : kept[n].neighbours) {
      front.links.attractor.push_back(number);
      front.links.node.push_back(one.node);
      front.links.state.push_back(static_cast<std::int32_t>(one.link));
    }
    for (const Arrival& one : kept[n].arrived) {
      front.links.arrived_at.push_back(number);
      front.links.arrived.push_back(one.node);
      front.links.arrived_from.push_back(one.from);
    }
  }
}

void letGoOfNeighbour(Front& front, std::int32_t node, std::int32_t attractor, int iteration) {
  Links& links = front.links;
  const auto [first, last] = std::equal_range(links.attractor.begin(), links.attractor.end(), attractor);
  const auto from = static_cast<std::size_t>(first - links.attractor.begin()),
             to = static_cast<std::size_t>(last - links.attractor.begin());
  const auto is = [&](std::size_t i, Link link) { return links.state[i] == static_cast<std::int32_t>(link); };
  std::size_t own = from;
  while (own < to && links.node[own] != node) ++own;
  if (own == to || !is(own, Link::pulls)) return;
  const sim::Vec3 at = placeOf(front, attractor);
  links.state[own] = static_cast<std::int32_t>(Link::let_go);
  addPull(front.pulls, node, front.nodes[asIndex(node)], at, -1);
  const auto place = asIndex(front.attractors.place[asIndex(attractor)]);
  const bool given_up = ++front.attractors.let_go[place] == kMostLetGo;
  bool reached = false, pulls = false;
  for (std::size_t i = from; i < to; ++i) {
    reached = reached || is(i, Link::near);
    if (!is(i, Link::pulls)) continue;
    pulls = true;
    if (given_up) addPull(front.pulls, links.node[i], front.nodes[asIndex(links.node[i])], at, -1);
  }
  if (!given_up && (pulls || !reached)) return;
  endAt(front, attractor, arrivalsAt(links, attractor), given_up ? Fate::given_up : Fate::reached, iteration);
  forget(links, attractor);
}

std::vector<std::int32_t> pulling(const Front& front, std::int32_t node) {
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < front.links.node.size(); ++i) {
    if (front.links.node[i] == node && front.links.state[i] == static_cast<std::int32_t>(Link::pulls))
      found.push_back(front.links.attractor[i]);
  }
  return found;
}

std::int32_t nearestPulling(const Front& front, std::int32_t node) {
  std::int32_t best = kNobody;
  double least2 = kFar;
  for (const std::int32_t number : pulling(front, node)) {
    const sim::Vec3 to = placeOf(front, number);
    const double away2 = distance2(front.nodes[asIndex(node)], to);
    if (away2 > least2 || (away2 == least2 && !before(to, front.attractors.at(best)))) continue;
    least2 = away2;
    best = front.attractors.place[asIndex(number)];
  }
  return best;
}

}  // namespace espalier::rules
