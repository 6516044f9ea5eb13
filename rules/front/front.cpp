#include "rules/front/front.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "rules/front/neighbours.h"
#include "sim/base/error.h"

namespace espalier::rules {
namespace {

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

sim::Vec3 unitTo(sim::Vec3 from, sim::Vec3 to) {
  return (to - from) / std::sqrt(distance2(from, to));
}

/// Whether a step from there towards a place ends nearer to it.
bool leadsNearer(sim::Vec3 from, sim::Vec3 to, const FrontRules& rules) {
  return 2.0 * std::sqrt(distance2(from, to)) > rules.step;
}

/// Zero where nothing pulls, or all sides do.
sim::Vec3 pulled(const Front& front, std::size_t node) {
  const sim::Vec3 sum(static_cast<double>(front.pulls.x[node]), static_cast<double>(front.pulls.y[node]),
                      static_cast<double>(front.pulls.z[node]));
  const double long_ = std::sqrt(distance2(sum, sim::Vec3(0.0)));
  return long_ > 0.0 ? sum / long_ : sim::Vec3(0.0);
}

void setGait(Front& front, std::size_t node, std::int32_t tried, Gait gait) {
  front.tried[node] = tried;
  front.gait[node] = static_cast<std::int32_t>(gait);
}

/// Towards the nearest of a node's attractors; those that no step leads nearer to are given up. None is left
/// where the way's node is kNobody.
Way straightWay(Front& front, std::int32_t node, const FrontRules& rules) {
  const sim::Vec3 from = front.nodes[asIndex(node)];
  while (front.pulls.count[asIndex(node)] > 0) {
    const std::int32_t at = nearestWaiting(front.attractors, from, kEverywhere, node);
    const sim::Vec3 to = front.attractors.at(at);
    if (rules.onto || leadsNearer(from, to, rules)) {
      const sim::Vec3 direction = from == to ? sim::Vec3(0, 1, 0) : unitTo(from, to);
      return {node, 0, direction, front.attractors.number[asIndex(at)]};
    }
    end(front.attractors, at, Fate::given_up, rules.iteration, front.nodes, front.pulls);
  }
  return {kNobody};
}

/// What became of it with on_all_neighbours: as above, but that the others are pulled on.
Way straightWayOfNeighbour(Front& front, std::int32_t node, const FrontRules& own) {
  const sim::Vec3 from = front.nodes[asIndex(node)];
  while (front.pulls.count[asIndex(node)] > 0) {
    const std::int32_t at = nearestPulling(front, node);
    const sim::Vec3 to = front.attractors.at(at);
    const std::int32_t number = front.attractors.number[asIndex(at)];
    if (leadsNearer(from, to, own)) return {node, 0, unitTo(from, to), number};
    letGoOfNeighbour(front, node, number, own.iteration);
  }
  return {kNobody};
}

/// The same way as below, where an attractor pulls several nodes.
Way wayOfNeighbour(Front& front, std::int32_t node, const FrontRules& own) {
  const std::size_t n = asIndex(node);
  const bool same = front.tried[n] == front.pulls.count[n];
  bool straight = same;
  if (same && front.gait[n] == static_cast<std::int32_t>(Gait::straight)) {
    const std::int32_t at = nearestPulling(front, node);
    letGoOfNeighbour(front, node, front.attractors.number[asIndex(at)], own.iteration);
    straight = false;
  }
  Way way{node, 0, pulled(front, n)};
  straight = straight || way.direction == sim::Vec3(0.0);
  if (straight) way = straightWayOfNeighbour(front, node, own);
  setGait(front, n, front.pulls.count[n], straight ? Gait::straight : Gait::pulled);
  return way;
}

/// By the attractors that have the node as their nearest.
Way wayOf(Front& front, std::int32_t node, const FrontRules& rules) {
  const std::size_t n = asIndex(node);
  const bool same = front.tried[n] == front.pulls.count[n] && !rules.onto;
  Gait gait = same ? Gait::straight : Gait::pulled;
  if (same && front.gait[n] == static_cast<std::int32_t>(Gait::straight)) {
    const std::int32_t at = nearestWaiting(front.attractors, front.nodes[n], kEverywhere, node);
    end(front.attractors, at, Fate::given_up, rules.iteration, front.nodes, front.pulls);
    gait = Gait::pulled;
  }
  Way way{node, 0, pulled(front, n)};
  if (gait == Gait::straight || way.direction == sim::Vec3(0.0)) {
    gait = Gait::straight;
    way = straightWay(front, node, rules);
  }
  setGait(front, n, front.pulls.count[n], gait);
  return way;
}

/// A way to each of the attractors that have the node as their nearest.
void allWaysOf(Front& front, std::int32_t node, const FrontRules& rules, std::vector<Way>& ways) {
  const sim::Vec3 from = front.nodes[asIndex(node)];
  std::uint32_t count = 0;
  for (const std::int32_t at : waitingFor(front.attractors, node, from, rules.influence)) {
    const sim::Vec3 to = front.attractors.at(at);
    if (from != to && (rules.onto || leadsNearer(from, to, rules)))
      ways.push_back({node, count++, unitTo(from, to), front.attractors.number[asIndex(at)]});
  }
  // What is left after a node has gone for all is too near to all its ways.
  if (count == 0) straightWay(front, node, rules);
}

bool waits(const Attractors& attractors, std::int32_t number) {
  const auto at = asIndex(attractors.place[asIndex(number)]);
  return attractors.fate[at] == static_cast<std::int32_t>(Fate::waiting);
}

/// Of those that pick an attractor the nearest is remembered.
void compete(Front& front, std::int32_t node) {
  const std::size_t number = asIndex(front.tried[asIndex(node)]);
  const sim::Vec3 to = front.attractors.at(front.attractors.place[number]);
  const double away2 = distance2(front.nodes[asIndex(node)], to);
  if (away2 > front.picked2[number] || (away2 == front.picked2[number] && node > front.picker[number]))
    return;
  front.picked2[number] = away2;
  front.picker[number] = node;
}

/// The attractor that is nearest to a node, by number: the same until it ends; kNobody where none is within
/// reach any more. Those that no step leads nearer to are given up.
std::int32_t pickOf(Front& front, std::int32_t node, const FrontRules& rules) {
  const std::size_t n = asIndex(node);
  if (front.gait[n] == static_cast<std::int32_t>(Gait::spent)) return kNobody;
  // A state that was tampered with may name one that is not there.
  const bool known = front.tried[n] != kNobody && front.tried[n] < front.attractors.size();
  if (known && waits(front.attractors, front.tried[n])) {
    if (front.gait[n] != static_cast<std::int32_t>(Gait::straight)) compete(front, node);
    return front.tried[n];
  }
  setGait(front, n, kNobody, Gait::none);
  while (true) {
    const std::int32_t at = nearestWaiting(front.attractors, front.nodes[n], rules.influence);
    if (at == kNobody) return kNobody;
    const sim::Vec3 to = front.attractors.at(at);
    if (rules.onto || leadsNearer(front.nodes[n], to, rules)) {
      front.tried[n] = front.attractors.number[asIndex(at)];
      compete(front, node);
      return front.tried[n];
    }
    end(front.attractors, at, Fate::given_up, rules.iteration, front.nodes, front.pulls);
  }
}

/// The ways of nodes that pick an attractor each.
void waysOfPickers(Front& front, std::vector<std::int32_t>& active, const OrderRules& by_order,
                   std::vector<Way>& ways) {
  const FrontRules& rules = by_order.trunk();
  front.picker.resize(asIndex(front.attractors.size()), kNobody);
  front.picked2.resize(asIndex(front.attractors.size()), kEverywhere);
  std::erase_if(active, [&](std::int32_t node) {
    return pickOf(front, node, by_order.at(nextOrder(front, node))) == kNobody;
  });
  std::vector<bool> used(rules.onto ? asIndex(front.attractors.size()) : 0);
  for (const std::int32_t node : active) {
    const std::size_t n = asIndex(node), number = asIndex(front.tried[n]);
    const bool gone = front.gait[n] == static_cast<std::int32_t>(Gait::straight);
    if (gone || !waits(front.attractors, front.tried[n])) continue;
    if (!rules.repeated && front.picker[number] != node) continue;
    if (rules.onto) {
      if (used[number]) continue;
      used[number] = true;
    }
    const sim::Vec3 to = front.attractors.at(front.attractors.place[number]);
    setGait(front, n, front.tried[n], Gait::straight);
    ways.push_back(
        {node, 0, front.nodes[n] == to ? sim::Vec3(0, 1, 0) : unitTo(front.nodes[n], to), front.tried[n]});
  }
}

}  // namespace

Front frontOf(std::span<const sim::Vec3> attractors) {
  Front front;
  front.attractors = sortedAttractors(attractors);
  return front;
}

namespace {

/// Those of some nodes that reach as far as each other meet the attractors together.
void meetByReach(Front& front, std::span<const std::int32_t> nodes, const OrderRules& rules) {
  const auto reachOf = [&](std::int32_t order) {
    const FrontRules& own = rules.at(order);
    const double influence = rules.trunk().acts == Acts::on_nearest_node ? own.influence : 0.0;
    return Reach{influence, own.kill, rules.trunk().iteration};
  };
  const auto same = [](const Reach& a, const Reach& b) {
    return a.influence == b.influence && a.kill == b.kill;
  };
  std::vector<Reach> met;
  for (std::int32_t order = 0; order <= kTwig; ++order) {
    const Reach reach = reachOf(order);
    if (std::any_of(met.begin(), met.end(), [&](const Reach& r) { return same(r, reach); })) continue;
    met.push_back(reach);
    std::vector<std::int32_t> fresh;
    for (const std::int32_t node : nodes) {
      if (same(reachOf(front.order[asIndex(node)]), reach)) fresh.push_back(node);
    }
    meet(front.attractors, front.nodes, fresh, reach, front.pulls);
  }
}

}  // namespace

namespace {

/// Those of new nodes on which something may act meet the attractors.
void meetAsNeighbours(Front& front, std::int32_t first, std::span<const NewNode> nodes,
                      const OrderRules& rules) {
  std::vector<std::int32_t> fresh, parents;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].meets) continue;
    fresh.push_back(first + static_cast<std::int32_t>(i));
    parents.push_back(nodes[i].from);
  }
  meetNeighbours(front, fresh, parents, rules);
}

}  // namespace

void join(Front& front, std::span<const NewNode> nodes, const OrderRules& rules) {
  const auto first = static_cast<std::int32_t>(front.nodes.size());
  for (const NewNode& node : nodes) {
    front.nodes.push_back(node.at);
    front.order.push_back(node.from == kNobody ? 0 : nextOrder(front, node.from));
    front.sent.push_back(0);
    if (node.from != kNobody) ++front.sent[asIndex(node.from)];
  }
  const std::size_t count = front.nodes.size();
  front.pulls.x.resize(count);
  front.pulls.y.resize(count);
  front.pulls.z.resize(count);
  front.pulls.count.resize(count);
  front.tried.resize(count, kNobody);
  front.gait.resize(count, static_cast<std::int32_t>(Gait::none));
  if (rules.trunk().acts == Acts::on_all_neighbours) {
    meetAsNeighbours(front, first, nodes, rules);
  } else {
    std::vector<std::int32_t> fresh(nodes.size());
    std::iota(fresh.begin(), fresh.end(), first);
    meetByReach(front, fresh, rules);
  }
}

void meetAgain(Front& front, std::span<const std::int32_t> nodes, const OrderRules& rules) {
  for (const std::int32_t node : nodes) keepForLater(front, node);
  if (rules.trunk().acts == Acts::on_all_neighbours) {
    meetNeighbours(front, nodes, {}, rules);
  } else {
    meetByReach(front, nodes, rules);
  }
}

std::vector<Way> waysOf(Front& front, std::vector<std::int32_t>& active, const OrderRules& rules) {
  std::vector<Way> ways;
  if (rules.trunk().acts == Acts::on_every_node) {
    waysOfPickers(front, active, rules, ways);
    return ways;
  }
  std::erase_if(active, [&](std::int32_t node) { return front.pulls.count[asIndex(node)] == 0; });
  for (const std::int32_t node : active) {
    const FrontRules& own = rules.at(nextOrder(front, node));
    if (rules.trunk().acts == Acts::on_all_neighbours) {
      const Way way = wayOfNeighbour(front, node, own);
      if (way.node != kNobody) ways.push_back(way);
    } else if (rules.trunk().repeated) {
      allWaysOf(front, node, own, ways);
    } else if (const Way way = wayOf(front, node, own); way.node != kNobody) {
      ways.push_back(way);
    }
  }
  return ways;
}

Way trunkWay(const Front& front, std::int32_t tip, const OrderRules& by_order) {
  const FrontRules& rules = by_order.trunk();
  const sim::Vec3 from = front.nodes[asIndex(tip)];
  const std::int32_t at = nearestWaiting(front.attractors, from, kEverywhere);
  if (at == kNobody) return {kNobody};
  const sim::Vec3 to = front.attractors.at(at);
  const double away = std::sqrt(distance2(from, to));
  if (away < rules.influence || !leadsNearer(from, to, rules)) return {kNobody};
  const sim::Vec3 upright(0, to.y < from.y ? -1 : 1, 0);
  const bool nearer = std::sqrt(distance2(from + rules.step * upright, to)) < away;
  return {tip, 0, nearer ? upright : unitTo(from, to), kNobody, true};
}

Goal goalOf(const Front& front, const Way& way, sim::Vec3 direction, const OrderRules& by_order) {
  const FrontRules& rules = by_order.at(nextOrder(front, way.node));
  const sim::Vec3 end = front.nodes[asIndex(way.node)] + rules.step * direction;
  if (!rules.onto || way.trunk) return {end, way.attractor};
  const std::int32_t at = way.attractor != kNobody
                              ? front.attractors.place[asIndex(way.attractor)]
                              : nearestWaiting(front.attractors, end, kEverywhere, way.node);
  return {front.attractors.at(at), front.attractors.number[asIndex(at)]};
}

void taken(Front& front, std::int32_t attractor, const OrderRules& by_order) {
  const FrontRules& rules = by_order.trunk();
  if (!rules.onto || !waits(front.attractors, attractor)) return;
  end(front.attractors, front.attractors.place[asIndex(attractor)], Fate::taken, rules.iteration, front.nodes,
      front.pulls);
}

void giveUp(Front& front, std::int32_t node, const OrderRules& by_order) {
  if (by_order.trunk().acts == Acts::on_all_neighbours) {
    for (const std::int32_t number : pulling(front, node))
      letGoOfNeighbour(front, node, number, by_order.trunk().iteration);
    return;
  }
  const FrontRules& rules = by_order.at(front.order[asIndex(node)]);
  letGo(front.attractors, node, front.nodes, {rules.influence, rules.kill, rules.iteration}, front.pulls);
}

void handOver(Front& front, std::int32_t node, std::int32_t to, const OrderRules& by_order) {
  giveUp(front, node, by_order);
  if (by_order.trunk().acts == Acts::on_all_neighbours) return;  // it has met them when it joined
  const FrontRules& rules = by_order.at(front.order[asIndex(to)]);
  meet(front.attractors, front.nodes, {&to, 1}, {rules.influence, rules.kill, rules.iteration}, front.pulls);
}

void giveUpOne(Front& front, std::int32_t node, std::int32_t attractor, const OrderRules& by_order) {
  const FrontRules& rules = by_order.trunk();
  if (!waits(front.attractors, attractor)) return;
  if (rules.acts == Acts::on_all_neighbours) return letGoOfNeighbour(front, node, attractor, rules.iteration);
  const auto number = asIndex(attractor);
  if (rules.acts == Acts::on_nearest_node) {
    const std::int32_t at = front.attractors.place[number];
    if (front.attractors.nearest[asIndex(at)] == node)
      letGoOf(front.attractors, at, front.nodes, rules.iteration, front.pulls);
    return;
  }
  setGait(front, asIndex(node), kNobody, Gait::spent);
  if (front.picker[number] != node) return;
  front.picker[number] = kNobody;
  front.picked2[number] = kEverywhere;
  letGoOf(front.attractors, front.attractors.place[number], front.nodes, rules.iteration, front.pulls);
}

void keepForLater(Front& front, std::int32_t node) {
  setGait(front, asIndex(node), kNobody, Gait::none);
}

void requireNodes(const Front& front, std::span<const std::int32_t> numbers) {
  for (const std::int32_t number : numbers) {
    if (number < 0 || asIndex(number) >= front.nodes.size())
      throw sim::BrokenContract("a front was asked for a node that it has not");
  }
}

void requireSound(const FrontRules& rules) {
  const auto require = [](bool good, const char* what, double is, const char* expected) {
    if (!good) throw sim::InputError(fmt::format("the {} is {}; expected {}", what, is, expected));
  };
  require(std::isfinite(rules.step) && rules.step > 0.0, "step", rules.step, "a number above 0");
  require(rules.influence > 0.0, "influence radius", rules.influence, "a number above 0");
  require(std::isfinite(rules.kill) && rules.kill >= 0.0, "kill distance", rules.kill, "a number from 0 on");
}

}  // namespace espalier::rules
