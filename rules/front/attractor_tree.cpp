#include "rules/front/attractor_tree.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace espalier::rules {
namespace {

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
  const double scale = side > 0.0 ? ((1 << kCurveBits) - 1) / side : 0.0;
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
  if (last - first <= kMostInLeaf) {
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

}  // namespace

bool before(sim::Vec3 a, sim::Vec3 b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
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

}  // namespace espalier::rules
