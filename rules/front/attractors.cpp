#include "rules/front/attractors.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "rules/front/leaf.h"
#include "sim/base/parallel.h"

namespace espalier::rules {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr int kMortonBits = 21;  // along each axis
/// Levels of lists below each other, each at most as long as the one before: one for every three bits of the
/// curve, and one for each halving of what lies in one place.
constexpr std::size_t kRoom = 2 + kMortonBits + 32;
constexpr std::size_t kWorthTasks = 100'000;  // new nodes times attractors that are worth tasks of their own

std::size_t asIndex(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

bool before(sim::Vec3 a, sim::Vec3 b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// Every third bit, from bit 0 on.
std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 32) & 0x1f00000000ffffULL;
  v = (v | v << 16) & 0x1f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2) & 0x1249249249249249ULL;
}

struct Keyed {
  std::uint64_t morton = 0;
  std::int32_t number = 0;
};

std::vector<Keyed> alongTheCurve(std::span<const sim::Vec3> places) {
  sim::Vec3 low(kFar), high(-kFar);
  for (const sim::Vec3& place : places) low = glm::min(low, place), high = glm::max(high, place);
  const double side = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const double scale = side > 0.0 ? ((1 << kMortonBits) - 1) / side : 0.0;
  std::vector<Keyed> keyed(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const sim::Vec3 at = (places[i] - low) * scale;
    keyed[i] = {spread(static_cast<std::uint64_t>(at.x)) | spread(static_cast<std::uint64_t>(at.y)) << 1 |
                    spread(static_cast<std::uint64_t>(at.z)) << 2,
                static_cast<std::int32_t>(i)};
  }
  std::sort(keyed.begin(), keyed.end(), [&](const Keyed& a, const Keyed& b) {
    if (a.morton != b.morton) return a.morton < b.morton;
    const sim::Vec3 at = places[asIndex(a.number)], other = places[asIndex(b.number)];
    return at != other ? before(at, other) : a.number < b.number;
  });
  return keyed;
}

void appendNode(Attractors& to, std::int32_t first, std::int32_t last) {
  to.first.push_back(first);
  to.last.push_back(last);
  to.waiting.push_back(0);
  to.child.push_back(0);
  to.children.push_back(0);
  to.low.emplace_back(kFar);
  to.high.emplace_back(-kFar);
  to.farthest2.push_back(kFar);
}

/// Children of a tree node, by the next three bits at which the codes in it differ.
void split(Attractors& to, std::int32_t node, const std::vector<Keyed>& keyed) {
  const std::int32_t first = to.first[asIndex(node)], last = to.last[asIndex(node)];
  const std::uint64_t differ = keyed[asIndex(first)].morton ^ keyed[asIndex(last - 1)].morton;
  if (last - first <= static_cast<std::int32_t>(kLeaf)) {
    to.waiting[asIndex(node)] = last - first;
    return;
  }
  to.child[asIndex(node)] = static_cast<std::int32_t>(to.first.size());
  if (differ == 0) {  // all in one place, or as good as
    const std::int32_t middle = first + (last - first) / 2;
    appendNode(to, first, middle);
    appendNode(to, middle, last);
    to.children[asIndex(node)] = 2;
    return;
  }
  const int shift = (63 - std::countl_zero(differ)) / 3 * 3;
  for (std::int32_t begin = first; begin < last;) {
    const std::uint64_t octant = keyed[asIndex(begin)].morton >> shift;
    const auto end = std::partition_point(keyed.begin() + begin, keyed.begin() + last,
                                          [&](const Keyed& k) { return k.morton >> shift <= octant; });
    const auto until = static_cast<std::int32_t>(end - keyed.begin());
    appendNode(to, begin, until);
    ++to.children[asIndex(node)];
    begin = until;
  }
}

void findBoxes(Attractors& of) {
  for (std::size_t node = of.first.size(); node-- > 0;) {
    if (of.children[node] == 0) {
      for (std::int32_t i = of.first[node]; i < of.last[node]; ++i) {
        of.low[node] = glm::min(of.low[node], of.at(i));
        of.high[node] = glm::max(of.high[node], of.at(i));
      }
    }
    for (std::int32_t c = 0; c < of.children[node]; ++c) {
      of.low[node] = glm::min(of.low[node], of.low[asIndex(of.child[node] + c)]);
      of.high[node] = glm::max(of.high[node], of.high[asIndex(of.child[node] + c)]);
    }
  }
}

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
        std::vector<std::int64_t> own(near * kRoom + Leaf::kPadding);
        std::copy(these, these + near, own.begin());
        at(asIndex(in.child[node]) + c, own.data(), near);
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

Attractors sortedAttractors(std::span<const sim::Vec3> places) {
  const std::vector<Keyed> keyed = alongTheCurve(places);
  Attractors sorted;
  for (const Keyed& k : keyed) {
    const sim::Vec3 at = places[asIndex(k.number)];
    sorted.x.push_back(at.x);
    sorted.y.push_back(at.y);
    sorted.z.push_back(at.z);
    sorted.number.push_back(k.number);
  }
  sorted.nearest2.assign(places.size(), kFar);
  sorted.nearest.assign(places.size(), kNobody);
  sorted.fate.assign(places.size(), static_cast<std::int32_t>(Fate::waiting));
  sorted.let_go.assign(places.size(), 0);
  sorted.ended.assign(places.size(), -1);
  sorted.place.resize(places.size());
  for (std::int32_t i = 0; i < sorted.size(); ++i) sorted.place[asIndex(sorted.number[asIndex(i)])] = i;
  if (places.empty()) return sorted;
  appendNode(sorted, 0, sorted.size());
  for (std::size_t node = 0; node < sorted.first.size(); ++node)
    split(sorted, static_cast<std::int32_t>(node), keyed);
  findBoxes(sorted);
  return sorted;
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
  std::vector<std::int64_t> which(count * kRoom + Leaf::kPadding);
  std::iota(which.begin(), which.begin() + static_cast<std::ptrdiff_t>(count), 0);
  const Meeting meeting{attractors,
                        nodes,
                        {x.data(), y.data(), z.data(), fresh.data()},
                        reach.influence * reach.influence,
                        reach.kill * reach.kill,
                        reach.iteration,
                        pulls};
  meeting.at(0, which.data(), count);
}

namespace {

/// What is sought: those of one node alone, if it is not kNobody, and not one that is left out.
struct Sought {
  std::int32_t of_node = kNobody, but = kNobody;
};
struct Nearest {
  double distance2;
  std::int32_t at = kNobody;
};

void seek(const Attractors& in, std::size_t node, sim::Vec3 to, const Sought& sought, Nearest& best) {
  if (in.farthest2[node] < 0.0) return;
  for (std::int32_t i = in.first[node]; i < in.first[node] + in.waiting[node]; ++i) {
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
  if (!attractors.first.empty()) seek(attractors, 0, to, {of_node, kNobody}, best);
  return best.at;
}

std::int32_t nearestOther(const Attractors& attractors, std::int32_t at) {
  Nearest best{kFar};
  seek(attractors, 0, attractors.at(at), {kNobody, at}, best);
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

void letGo(Attractors& attractors, std::int32_t node, std::span<const sim::Vec3> nodes, Reach reach,
           Pulls& pulls) {
  std::vector<std::int32_t> numbers;  // as they change places where one ends
  for (const std::int32_t i : waitingFor(attractors, node, nodes[asIndex(node)], reach.influence))
    numbers.push_back(attractors.number[asIndex(i)]);
  for (const std::int32_t number : numbers) {
    const std::int32_t i = attractors.place[asIndex(number)];
    if (++attractors.let_go[asIndex(i)] == kMostLetGo) {
      end(attractors, i, Fate::given_up, reach.iteration, nodes, pulls);
      continue;
    }
    leave(node, attractors.at(i), nodes, pulls);
    attractors.nearest[asIndex(i)] = kNobody;
    attractors.nearest2[asIndex(i)] = kFar;
    raiseFarthest(attractors, i);
  }
}

}  // namespace espalier::rules
