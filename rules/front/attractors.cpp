#include "rules/front/attractors.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "rules/front/attractor_tree.h"
#include "rules/front/leaf.h"
#include "sim/base/parallel.h"

namespace espalier::rules {
namespace {

/// Levels of lists below each other, each at most as long as the one before: one for every three bits of the
/// curve, and one for each halving of what lies in one place.
constexpr std::size_t kRoom = 2 + kCurveBits + 32;
constexpr std::size_t kWorthTasks = 100'000;  // new nodes times attractors that are worth tasks of their own

/// From the box of a tree node; never more than distance2 of anything in it, whichever way that rounds.
double boxDistance2(const Attractors& of, std::size_t node, sim::Vec3 p) {
  const sim::Vec3 away = glm::max(glm::max(of.low[node] - p, p - of.high[node]), sim::Vec3(0.0));
  return glm::dot(away, away) * (1.0 - 1e-14);
}

/// The unit vector from a node to an attractor, in the whole numbers of pulls; zero where they coincide.
std::array<std::int64_t, 3> pullOf(sim::Vec3 node, sim::Vec3 attractor) {
  const double long_ = std::sqrt(distance2(node, attractor));
  if (long_ == 0.0) return {0, 0, 0};
  // Whole numbers by a sum too large to hold more: half to even, so the same to both sides of zero.
  constexpr double kWhole = 0x1.8p52;
  const sim::Vec3 whole = ((attractor - node) * (kPullOne / long_) + kWhole) - kWhole;
  return {static_cast<std::int64_t>(whole.x), static_cast<std::int64_t>(whole.y),
          static_cast<std::int64_t>(whole.z)};
}

void exchange(Attractors& in, std::size_t a, std::size_t b) {
  std::swap(in.x[a], in.x[b]);
  std::swap(in.y[a], in.y[b]);
  std::swap(in.z[a], in.z[b]);
  std::swap(in.nearest2[a], in.nearest2[b]);
  std::swap(in.nearest[a], in.nearest[b]);
  std::swap(in.number[a], in.number[b]);
  std::swap(in.fate[a], in.fate[b]);
  std::swap(in.let_go[a], in.let_go[b]);
  std::swap(in.ended[a], in.ended[b]);
  in.place[asIndex(in.number[a])] = static_cast<std::int32_t>(a);
  in.place[asIndex(in.number[b])] = static_cast<std::int32_t>(b);
}

/// One that waited no longer does: it changes its place with the last that does.
void leaveLeaf(Attractors& in, std::size_t leaf, std::size_t at, Fate fate, int iteration) {
  in.ended[at] = iteration;
  in.fate[at] = static_cast<std::int32_t>(fate);
  exchange(in, at, asIndex(in.first[leaf] + --in.waiting[leaf]));
}

void findFarthest(Attractors& in, std::size_t node) {
  double farthest2 = -1.0;
  for (std::int32_t i = in.first[node]; i < in.first[node] + in.waiting[node]; ++i)
    farthest2 = std::max(farthest2, in.nearest2[asIndex(i)]);
  for (std::int32_t c = 0; c < in.children[node]; ++c)
    farthest2 = std::max(farthest2, in.farthest2[asIndex(in.child[node] + c)]);
  in.farthest2[node] = farthest2;
}

/// What a leaf's attractors change about nodes, summed before it is told to others.
class Changes {
 public:
  explicit Changes(std::span<const sim::Vec3> nodes) : nodes_(nodes) {}

  /// An attractor comes to a node, or leaves it: sign 1 or -1.
  void note(std::int32_t node, sim::Vec3 attractor, int sign) {
    if (count_ == 0 || sums_[last_].node != node) {
      last_ = 0;
      while (last_ < count_ && sums_[last_].node != node) ++last_;
      if (last_ == count_) sums_[count_++] = {node, 0, {0, 0, 0}};
    }
    const auto pull = pullOf(nodes_[asIndex(node)], attractor);
    for (std::size_t axis = 0; axis < 3; ++axis) sums_[last_].pull[axis] += sign * pull[axis];
    sums_[last_].count += sign;
  }

  /// Several tasks may do so at once.
  void tell(Pulls& pulls) {
    for (std::size_t i = 0; i < count_; ++i) {
      const Sum& sum = sums_[i];
      const auto n = asIndex(sum.node);
      add(pulls.x[n], sum.pull[0]);
      add(pulls.y[n], sum.pull[1]);
      add(pulls.z[n], sum.pull[2]);
      add(pulls.count[n], sum.count);
    }
  }

 private:
  struct Sum {
    std::int32_t node, count;
    std::array<std::int64_t, 3> pull;
  };
  template <typename Number>
  static void add(Number& to, Number what) {
    std::atomic_ref(to).fetch_add(what, std::memory_order_relaxed);
  }

  std::span<const sim::Vec3> nodes_;
  std::array<Sum, 2 * kLeaf> sums_;  // each of a leaf's attractors leaves one and comes to one
  std::size_t count_ = 0, last_ = 0;
};

/// New nodes on their way down the tree.
struct Meeting {
  Attractors& in;
  std::span<const sim::Vec3> nodes;
  PointList points;  ///< the new ones
  double influence2, kill2;
  int iteration;
  Pulls& pulls;

  void atLeaf(std::size_t node, std::span<const std::int64_t> which) const {
    Leaf leaf;
    const std::size_t first = asIndex(in.first[node]);
    leaf.count = asIndex(in.waiting[node]);
    for (std::size_t i = 0; i < leaf.count; ++i) {
      leaf.x[i] = in.x[first + i], leaf.y[i] = in.y[first + i], leaf.z[i] = in.z[first + i];
      leaf.nearest2[i] = in.nearest2[first + i];
      leaf.nearest[i] = in.nearest[first + i];
      leaf.new2[i] = kFar;
    }
    for (std::size_t i = leaf.count; i < leaf.count + Leaf::kPadding; ++i)  // whole vectors are looked at
      leaf.x[i] = leaf.y[i] = leaf.z[i] = leaf.nearest2[i] = leaf.nearest[i] = leaf.new2[i] = 0.0;
    comeBy(leaf, which, points, influence2);
    Changes changes(nodes);
    for (std::size_t i = leaf.count; i-- > 0;) {  // from behind, as those that end change places
      const std::size_t at = first + i;
      const auto old = in.nearest[at], now = static_cast<std::int32_t>(leaf.nearest[i]);
      const bool ends = leaf.new2[i] < kill2;
      if (now == old && !ends) continue;
      const sim::Vec3 place{in.x[at], in.y[at], in.z[at]};
      if (old != kNobody) changes.note(old, place, -1);
      in.nearest2[at] = leaf.nearest2[i];
      in.nearest[at] = now;
      if (ends) {
        leaveLeaf(in, node, at, Fate::reached, iteration);
      } else {
        changes.note(now, place, 1);
      }
    }
    changes.tell(pulls);
  }

  /// The first `count` of `which` come to a tree node; behind them there is room for kRoom times as many.
  void at(std::size_t node, std::int64_t* which, std::size_t count) const {
    if (in.farthest2[node] < 0.0) return;
    const double within2 = std::max(std::min(in.farthest2[node], influence2), kill2);
    const std::size_t near = nearBox(points, which, count, in.low[node], in.high[node], within2);
    if (near == 0) return;
    std::int64_t* const these = which + count;
    const std::int32_t held = in.last[node] - in.first[node];
    if (in.children[node] == 0) {
      atLeaf(node, {these, near});
    } else if (near * asIndex(held) > kWorthTasks) {
      sim::parallelForEach(asIndex(in.children[node]), [&](std::size_t c) {
        const auto own = std::make_unique_for_overwrite<std::int64_t[]>(near * kRoom + Leaf::kPadding);
        std::copy(these, these + near, own.get());
        at(asIndex(in.child[node]) + c, own.get(), near);
      });
    } else {
      for (std::int32_t c = 0; c < in.children[node]; ++c) at(asIndex(in.child[node] + c), these, near);
    }
    findFarthest(in, node);
  }
};

}  // namespace

double distance2(sim::Vec3 a, sim::Vec3 b) {
  const sim::Vec3 d = a - b, s = d * d;
  const double least = std::min(s.x, std::min(s.y, s.z)), most = std::max(s.x, std::max(s.y, s.z));
  const double middle = std::max(std::min(s.x, s.y), std::min(std::max(s.x, s.y), s.z));
  return least + middle + most;
}

void meet(Attractors& attractors, std::span<const sim::Vec3> nodes, std::span<const std::int32_t> fresh,
          Reach reach, Pulls& pulls) {
  if (attractors.first.empty() || fresh.empty()) return;
  const auto count = fresh.size();
  std::vector<double> x(count), y(count), z(count);
  for (std::size_t i = 0; i < count; ++i) {
    const sim::Vec3 at = nodes[asIndex(fresh[i])];
    x[i] = at.x, y[i] = at.y, z[i] = at.z;
  }
  const auto which = std::make_unique_for_overwrite<std::int64_t[]>(count * kRoom + Leaf::kPadding);
  std::iota(which.get(), which.get() + count, 0);
  const Meeting meeting{attractors,
                        nodes,
                        {x.data(), y.data(), z.data(), fresh.data()},
                        reach.influence * reach.influence,
                        reach.kill * reach.kill,
                        reach.iteration,
                        pulls};
  meeting.at(0, which.get(), count);
}

namespace {

/// What is sought: those of one node alone, if it is not kNobody, and not one that is left out; those that
/// wait, or all.
struct Sought {
  std::int32_t of_node = kNobody, but = kNobody;
  bool all = false;
};
struct Nearest {
  double distance2;
  std::int32_t at = kNobody;
};

void seek(const Attractors& in, std::size_t node, sim::Vec3 to, const Sought& sought, Nearest& best) {
  if (in.farthest2[node] < 0.0 && !sought.all) return;
  const std::int32_t last = in.children[node] > 0 ? in.first[node]
                            : sought.all          ? in.last[node]
                                                  : in.first[node] + in.waiting[node];
  for (std::int32_t i = in.first[node]; i < last; ++i) {
    if (i == sought.but || (sought.of_node != kNobody && in.nearest[asIndex(i)] != sought.of_node)) continue;
    const double away2 = distance2(in.at(i), to);
    if (away2 < best.distance2 ||
        (away2 == best.distance2 && best.at != kNobody && before(in.at(i), in.at(best.at))))
      best = {away2, i};
  }
  std::array<std::pair<double, std::size_t>, 8> order;
  std::size_t count = 0;
  for (std::int32_t c = 0; c < in.children[node]; ++c) {
    const std::size_t child = asIndex(in.child[node] + c);
    order[count++] = {boxDistance2(in, child, to), child};
  }
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::size_t i = 0; i < count && order[i].first <= best.distance2; ++i)
    seek(in, order[i].second, to, sought, best);
}

/// The child of a tree node that holds an attractor.
std::size_t childOf(const Attractors& in, std::size_t node, std::int32_t at) {
  std::int32_t c = in.children[node] - 1;
  while (in.first[asIndex(in.child[node] + c)] > at) --c;
  return asIndex(in.child[node] + c);
}

std::size_t leafOf(const Attractors& in, std::int32_t at) {
  std::size_t node = 0;
  while (in.children[node] > 0) node = childOf(in, node, at);
  return node;
}

/// The greatest distance of a leaf has grown.
void raiseFarthest(Attractors& in, std::int32_t at) {
  std::size_t node = 0;
  while (true) {
    in.farthest2[node] = kFar;
    if (in.children[node] == 0) return;
    node = childOf(in, node, at);
  }
}

void list(const Attractors& in, std::size_t tree_node, std::int32_t node, sim::Vec3 at, double within2,
          std::vector<std::int32_t>& found) {
  if (in.farthest2[tree_node] < 0.0 || boxDistance2(in, tree_node, at) >= within2) return;
  for (std::int32_t i = in.first[tree_node]; i < in.first[tree_node] + in.waiting[tree_node]; ++i) {
    if (in.nearest[asIndex(i)] == node) found.push_back(i);
  }
  for (std::int32_t c = 0; c < in.children[tree_node]; ++c)
    list(in, asIndex(in.child[tree_node] + c), node, at, within2, found);
}

}  // namespace

std::vector<std::int32_t> waitingFor(const Attractors& attractors, std::int32_t node, sim::Vec3 at,
                                     double within) {
  std::vector<std::int32_t> found;
  if (!attractors.first.empty()) list(attractors, 0, node, at, within * within, found);
  std::sort(found.begin(), found.end(),
            [&](std::int32_t a, std::int32_t b) { return before(attractors.at(a), attractors.at(b)); });
  return found;
}

std::int32_t nearestWaiting(const Attractors& attractors, sim::Vec3 to, double within, std::int32_t of_node) {
  Nearest best{within * within};
  if (!attractors.first.empty()) seek(attractors, 0, to, {.of_node = of_node}, best);
  return best.at;
}

std::int32_t nearestOfAll(const Attractors& attractors, sim::Vec3 to) {
  Nearest best{kFar};
  if (!attractors.first.empty()) seek(attractors, 0, to, {.all = true}, best);
  return best.at;
}

std::int32_t nearestOther(const Attractors& attractors, std::int32_t at) {
  Nearest best{kFar};
  seek(attractors, 0, attractors.at(at), {.but = at, .all = true}, best);
  return best.at;
}

namespace {

void leave(std::int32_t node, sim::Vec3 attractor, std::span<const sim::Vec3> nodes, Pulls& pulls) {
  Changes changes(nodes);
  changes.note(node, attractor, -1);
  changes.tell(pulls);
}

}  // namespace

void end(Attractors& attractors, std::int32_t at, Fate fate, int iteration, std::span<const sim::Vec3> nodes,
         Pulls& pulls) {
  const auto n = asIndex(at);
  if (const std::int32_t node = attractors.nearest[n]; node != kNobody)
    leave(node, attractors.at(at), nodes, pulls);
  leaveLeaf(attractors, leafOf(attractors, at), n, fate, iteration);
}

void bring(Attractors& attractors, std::int32_t at) {
  const std::size_t leaf = leafOf(attractors, at);
  attractors.fate[asIndex(at)] = static_cast<std::int32_t>(Fate::waiting);
  const std::int32_t to = attractors.first[leaf] + attractors.waiting[leaf]++;
  exchange(attractors, asIndex(at), asIndex(to));
  raiseFarthest(attractors, to);
}

void addPull(Pulls& pulls, std::int32_t node, sim::Vec3 node_at, sim::Vec3 attractor_at, int sign) {
  const auto pull = pullOf(node_at, attractor_at);
  const auto add = [sign]<typename Number>(Number& to, Number what) {
    std::atomic_ref(to).fetch_add(static_cast<Number>(sign * what), std::memory_order_relaxed);
  };
  const std::size_t n = asIndex(node);
  add(pulls.x[n], pull[0]);
  add(pulls.y[n], pull[1]);
  add(pulls.z[n], pull[2]);
  add(pulls.count[n], 1);
}

void letGoOf(Attractors& attractors, std::int32_t at, std::span<const sim::Vec3> nodes, int iteration,
             Pulls& pulls) {
  const auto n = asIndex(at);
  if (++attractors.let_go[n] == kMostLetGo)
    return end(attractors, at, Fate::given_up, iteration, nodes, pulls);
  if (attractors.nearest[n] == kNobody) return;
  leave(attractors.nearest[n], attractors.at(at), nodes, pulls);
  attractors.nearest[n] = kNobody;
  attractors.nearest2[n] = kFar;
  raiseFarthest(attractors, at);
}

void letGo(Attractors& attractors, std::int32_t node, std::span<const sim::Vec3> nodes, Reach reach,
           Pulls& pulls) {
  std::vector<std::int32_t> numbers;  // as they change places where one ends
  for (const std::int32_t i : waitingFor(attractors, node, nodes[asIndex(node)], reach.influence))
    numbers.push_back(attractors.number[asIndex(i)]);
  for (const std::int32_t number : numbers)
    letGoOf(attractors, attractors.place[asIndex(number)], nodes, reach.iteration, pulls);
}

}  // namespace espalier::rules
