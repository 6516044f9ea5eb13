#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "rules/front/colonize.h"

/// The front as rules/front/front.h defines it, written from those words alone: everything is looked for
/// among all, again in each iteration. Slow, and short.
namespace espalier::tests {

struct Definition {
  using Vec3 = sim::Vec3;

  std::vector<Vec3> attractors;
  rules::FrontRules rules;
  std::vector<Vec3> nodes;
  std::vector<int> parent, trunks;
  std::vector<bool> waits;
  std::map<int, std::vector<int>> last_pulled;   // by node: what it was pulled by when it last grew
  std::map<int, bool> last_straight;             // and whether it went straight then
  std::map<std::pair<int, int>, bool> gone_for;  // (node, attractor), where nodes pick
  // Where attractors pull all around them.
  std::vector<int> joins, times_let_go;
  std::map<std::pair<int, int>, bool> let_go;  // (attractor, node)
  std::map<int, std::vector<int>> arrived;     // at an attractor, oldest first
  std::vector<std::pair<int, int>> meetings;   // to come
  mutable std::map<int, std::pair<std::size_t, std::vector<int>>> known_neighbours;  // among so many nodes
  std::vector<int> waves;  // of each attractor, if there are several
  rules::FrontRules last;  // as they are given: of the last wave
  int wave = 0;

  Definition(std::vector<Vec3> a, std::vector<Vec3> starts, rules::FrontRules r, std::vector<int> w = {})
      : attractors(std::move(a)),
        rules(r),
        waits(attractors.size(), true),
        times_let_go(attractors.size()),
        waves(std::move(w)),
        last(r) {
    reachIn(0);
    for (std::size_t i = 0; i < waves.size(); ++i) waits[i] = waves[i] == 0;
    for (const Vec3& start : starts) {
      trunks.push_back(static_cast<int>(nodes.size()));
      nodes.push_back(start);
      parent.push_back(-1);
      joins.push_back(-1);
    }
    kill(0);
  }

  static double away(Vec3 a, Vec3 b) { return std::sqrt(rules::distance2(a, b)); }
  static double away2(Vec3 a, Vec3 b) { return rules::distance2(a, b); }
  Vec3 at(int a) const { return attractors[static_cast<std::size_t>(a)]; }
  Vec3 node(int n) const { return nodes[static_cast<std::size_t>(n)]; }
  bool nearerStep(Vec3 from, Vec3 to) const { return 2.0 * away(from, to) > rules.step; }
  static bool before(Vec3 a, Vec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

  void reachIn(int now) {
    wave = now;
    const int left = waves.empty() ? 0 : *std::max_element(waves.begin(), waves.end()) - now;
    rules.influence = last.influence * std::pow(2.0, left);
    rules.kill = last.kill * std::pow(2.0, left);
  }

  void kill(std::size_t first_new) {
    if (rules.acts == rules::Acts::on_all_neighbours) {
      for (std::size_t a = 0; a < attractors.size(); ++a) endIfReached(static_cast<int>(a));
      return;
    }
    for (std::size_t a = 0; a < attractors.size(); ++a) {
      for (std::size_t n = first_new; n < nodes.size(); ++n) {
        if (away2(attractors[a], nodes[n]) < rules.kill * rules.kill) waits[a] = false;
      }
    }
  }

  /// Those that wait and lie within reach of a place, or anywhere.
  std::vector<int> inReach(Vec3 from, bool anywhere) const {
    std::vector<int> found;
    for (std::size_t a = 0; a < attractors.size(); ++a) {
      if (waits[a] && (anywhere || away2(attractors[a], from) < rules.influence * rules.influence))
        found.push_back(static_cast<int>(a));
    }
    return found;
  }
  int nearestOf(const std::vector<int>& some, Vec3 to) const {
    int best = -1;
    for (const int a : some) {
      if (best < 0 || away2(at(a), to) < away2(at(best), to) ||
          (away2(at(a), to) == away2(at(best), to) && before(at(a), at(best))))
        best = a;
    }
    return best;
  }

  /// What pulls each node: every attractor its nearest node, the older of equally near ones.
  std::map<int, std::vector<int>> pulled() const {
    std::map<int, std::vector<int>> by;
    for (std::size_t a = 0; a < attractors.size(); ++a) {
      if (!waits[a]) continue;
      int best = -1;
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        const double d2 = away2(attractors[a], nodes[n]);
        if (d2 < rules.influence * rules.influence && (best < 0 || d2 < away2(attractors[a], node(best))))
          best = static_cast<int>(n);
      }
      if (best >= 0) by[best].push_back(static_cast<int>(a));
    }
    return by;
  }

  bool isNear(int n, int a) const { return away2(node(n), at(a)) < rules.kill * rules.kill; }
  /// Of an attractor; nodes that stand where another stood before are none.
  const std::vector<int>& neighbours(int a) const {
    auto& [among, found] = known_neighbours[a];
    if (among == nodes.size()) return found;
    among = nodes.size();
    found.clear();
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const double mine = away2(nodes[n], at(a));
      bool is = joins[n] < 0 && mine < rules.influence * rules.influence;
      for (std::size_t u = 0; u < nodes.size() && is; ++u)
        is = !(std::max(away2(nodes[u], at(a)), away2(nodes[u], nodes[n])) < mine);
      if (is) found.push_back(static_cast<int>(n));
    }
    return found;
  }
  /// Those of them that it pulls.
  std::vector<int> pulledBy(int a) const {
    std::vector<int> found;
    if (!waits[static_cast<std::size_t>(a)]) return found;
    for (const int n : neighbours(a)) {
      if (!isNear(n, a) && !let_go.contains({a, n})) found.push_back(n);
    }
    return found;
  }
  std::map<int, std::vector<int>> pulledByAll() const {
    std::map<int, std::vector<int>> by;
    for (std::size_t a = 0; a < attractors.size(); ++a) {
      for (const int n : pulledBy(static_cast<int>(a))) by[n].push_back(static_cast<int>(a));
    }
    return by;
  }
  void endIfReached(int a) {
    if (!waits[static_cast<std::size_t>(a)] || !pulledBy(a).empty()) return;
    bool reached = false;
    for (const int n : neighbours(a)) reached = reached || isNear(n, a);
    if (!reached) return;
    waits[static_cast<std::size_t>(a)] = false;
    const std::vector<int>& all = arrived[a];
    for (std::size_t i = 1; i < all.size(); ++i) {
      const int from = parent[static_cast<std::size_t>(all[i])];
      if (from == all[0] || from == parent[static_cast<std::size_t>(all[0])] || node(all[i]) == node(all[0]))
        continue;
      meetings.emplace_back(all[i], all[0]);
    }
  }
  void letGo(int n, int a) {
    let_go[{a, n}] = true;
    if (++times_let_go[static_cast<std::size_t>(a)] == rules::kMostLetGo) {
      waits[static_cast<std::size_t>(a)] = false;
    } else {
      endIfReached(a);
    }
  }

  static Vec3 toward(Vec3 from, Vec3 to) { return (to - from) / away(from, to); }
  /// The sum of the unit vectors in whole multiples of 2^-40.
  Vec3 pull(int n, const std::vector<int>& by) const {
    std::int64_t x = 0, y = 0, z = 0;
    for (const int a : by) {
      if (at(a) == node(n)) continue;
      const Vec3 unit = (at(a) - node(n)) * (0x1p40 / away(node(n), at(a)));
      x += std::llrint(unit.x), y += std::llrint(unit.y), z += std::llrint(unit.z);
    }
    const Vec3 sum(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
    return sum == Vec3(0.0) ? sum : sum / std::sqrt(rules::distance2(sum, Vec3(0.0)));
  }

  struct Step {
    int from;
    Vec3 to;
    int onto;
    bool trunk = false;
  };

  void ofPulledNode(int n, std::vector<int> by, std::vector<Step>& steps) {
    const auto far = [&](const std::vector<int>& some) {
      std::vector<int> left;
      for (const int a : some) {
        if (rules.onto || nearerStep(node(n), at(a))) left.push_back(a);
      }
      return left;
    };
    const auto giveUp = [&](int a) {
      if (rules.acts == rules::Acts::on_all_neighbours) {
        letGo(n, a);
      } else {
        waits[static_cast<std::size_t>(a)] = false;
      }
      std::erase(by, a);
    };
    if (rules.repeated) {
      std::vector<int> order = far(by);
      std::sort(order.begin(), order.end(), [&](int a, int b) { return before(at(a), at(b)); });
      for (const int a : order)
        steps.push_back({n, rules.onto ? at(a) : node(n) + rules.step * toward(node(n), at(a)), a});
      if (order.empty()) {
        for (const int a : std::vector<int>(by)) giveUp(a);
      }
      return;
    }
    const bool same = !rules.onto && last_pulled.contains(n) && last_pulled[n] == by;
    bool straight = same;
    if (same && last_straight[n]) {
      giveUp(nearestOf(by, node(n)));
      straight = false;
    }
    Vec3 direction = by.empty() ? Vec3(0.0) : pull(n, by);
    int goal = -1;
    if (straight || direction == Vec3(0.0)) {
      straight = true;
      while (!by.empty()) {
        goal = nearestOf(by, node(n));
        if (rules.onto || nearerStep(node(n), at(goal))) break;
        giveUp(goal);
      }
      if (by.empty()) return;
      direction = at(goal) == node(n) ? Vec3(0, 1, 0) : toward(node(n), at(goal));
    }
    last_pulled[n] = by;
    last_straight[n] = straight;
    const Vec3 end = node(n) + rules.step * direction;
    if (rules.onto) goal = goal >= 0 ? goal : nearestOf(by, end);
    steps.push_back({n, rules.onto ? at(goal) : end, goal});
  }

  void ofPickers(std::vector<Step>& steps) {
    std::vector<int> pick(nodes.size(), -1);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      while ((pick[n] = nearestOf(inReach(nodes[n], false), nodes[n])) >= 0) {
        if (rules.onto || nearerStep(nodes[n], at(pick[n]))) break;
        waits[static_cast<std::size_t>(pick[n])] = false;
      }
    }
    std::vector<bool> used(attractors.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const int a = pick[n];
      if (a < 0 || !waits[static_cast<std::size_t>(a)]) continue;
      bool nearest = true;
      for (std::size_t m = 0; m < nodes.size(); ++m) {
        const double mine = away2(nodes[n], at(a)), its = away2(nodes[m], at(a));
        nearest = nearest && !(pick[m] == a && (its < mine || (its == mine && m < n)));
      }
      const auto self = static_cast<int>(n);
      if ((!nearest && !rules.repeated) || gone_for[{self, a}]) continue;
      if (rules.onto && used[static_cast<std::size_t>(a)]) continue;
      used[static_cast<std::size_t>(a)] = true;
      gone_for[{self, a}] = true;
      const Vec3 direction = at(a) == nodes[n] ? Vec3(0, 1, 0) : toward(nodes[n], at(a));
      steps.push_back({self, rules.onto ? at(a) : nodes[n] + rules.step * direction, a});
    }
  }

  bool step() {
    std::vector<Step> steps;
    if (rules.acts == rules::Acts::on_nearest_node) {
      for (const auto& [n, by] : pulled()) ofPulledNode(n, by, steps);
    } else if (rules.acts == rules::Acts::on_all_neighbours) {
      auto all = pulledByAll();
      for (int n = 0; n < static_cast<int>(nodes.size()); ++n) {
        if (!all.contains(n)) continue;
        const std::size_t before = let_go.size();
        ofPulledNode(n, all.at(n), steps);
        if (let_go.size() > before) all = pulledByAll();  // what one lets go of may end for the next
      }
    } else {
      ofPickers(steps);
    }
    std::vector<int> left;
    for (const int tip : trunks) {
      const std::vector<int> all = inReach(node(tip), true);
      if (all.empty()) continue;
      const Vec3 to = at(nearestOf(all, node(tip)));
      const double now = away(node(tip), to);
      if (now < rules.influence || !nearerStep(node(tip), to)) continue;
      const Vec3 upright = node(tip) + rules.step * Vec3(0, to.y < node(tip).y ? -1 : 1, 0);
      steps.push_back({tip,
                       away(upright, to) < now ? upright : node(tip) + rules.step * toward(node(tip), to), -1,
                       true});
      left.push_back(static_cast<int>(nodes.size() + steps.size()) - 1);
    }
    trunks = left;
    std::sort(meetings.begin(), meetings.end());
    meetings.erase(std::unique(meetings.begin(), meetings.end()), meetings.end());
    const auto meeting = meetings;
    meetings.clear();
    if (steps.empty() && meeting.empty()) return nextWave();
    const std::size_t first_new = nodes.size();
    std::map<int, std::vector<int>> by;
    for (std::size_t a = 0; a < attractors.size(); ++a)
      by[static_cast<int>(a)] = pulledBy(static_cast<int>(a));
    for (const Step& s : steps) {
      nodes.push_back(s.to);
      parent.push_back(s.from);
      joins.push_back(-1);
      if (rules.onto && s.onto >= 0) waits[static_cast<std::size_t>(s.onto)] = false;
    }
    for (std::size_t n = first_new; n < nodes.size(); ++n) {
      for (const auto& [a, pulled] : by) {
        if (std::count(pulled.begin(), pulled.end(), parent[n]) > 0 && isNear(static_cast<int>(n), a))
          arrived[a].push_back(static_cast<int>(n));
      }
    }
    for (const auto& [from, to] : meeting) {
      nodes.push_back(node(to));
      parent.push_back(from);
      joins.push_back(to);
    }
    kill(first_new);
    return true;
  }

  bool nextWave() {
    if (std::none_of(waves.begin(), waves.end(), [&](int w) { return w > wave; })) return false;
    reachIn(wave + 1);
    for (std::size_t a = 0; a < waves.size(); ++a) {
      if (waves[a] == wave) waits[a] = true;
    }
    last_pulled.clear();
    last_straight.clear();
    kill(0);
    return true;
  }
};

}  // namespace espalier::tests
