#include "rules/growth/given_tree.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace espalier::rules {
namespace {

using sim::NodeId;
using sim::Vec3;

std::size_t at(std::int32_t n) {
  return static_cast<std::size_t>(n);
}

/// How far each node is from the root, along the limbs.
std::vector<double> lengthsOf(const GivenTree& tree) {
  std::vector<double> lengths(tree.parent.size(), 0.0);
  for (std::size_t n = 1; n < lengths.size(); ++n) {
    const auto parent = at(tree.parent[n]);
    lengths[n] = lengths[parent] + glm::distance(tree.position_vx[n], tree.position_vx[parent]);
  }
  return lengths;
}

std::vector<std::int32_t> tipsOf(const GivenTree& tree) {
  std::vector<std::int32_t> tips(tree.parent.size(), 0);
  for (std::size_t n = tips.size(); n-- > 0;) {
    tips[n] = std::max(tips[n], 1);
    if (n > 0) tips[at(tree.parent[n])] += tips[n];
  }
  return tips;
}

/// Each node's children: the limb that goes on, then the others in their order.
class Forks {
 public:
  explicit Forks(const GivenTree& tree) : begin_(tree.parent.size() + 1, 0) {
    for (std::size_t n = 1; n < tree.parent.size(); ++n) ++begin_[at(tree.parent[n]) + 1];
    for (std::size_t n = 1; n < begin_.size(); ++n) begin_[n] += begin_[n - 1];
    children_.resize(at(begin_.back()));
    std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t n = 1; n < tree.parent.size(); ++n)
      children_[at(next[at(tree.parent[n])]++)] = static_cast<NodeId>(n);
    const std::vector<std::int32_t> tips = tipsOf(tree);
    for (std::size_t n = 0; n < tree.parent.size(); ++n) putLimbFirst(tree, tips, n);
  }

  std::span<const NodeId> of(NodeId n) const {
    return std::span(children_).subspan(at(begin_[at(n)]), at(begin_[at(n) + 1] - begin_[at(n)]));
  }

 private:
  void putLimbFirst(const GivenTree& tree, const std::vector<std::int32_t>& tips, std::size_t n) {
    const auto first = children_.begin() + begin_[n], last = children_.begin() + begin_[n + 1];
    if (last - first < 2) return;
    const Vec3 here = tree.position_vx[n];
    const Vec3 heading = n == 0 ? Vec3(0, 1, 0) : glm::normalize(here - tree.position_vx[at(tree.parent[n])]);
    const auto rank = [&](NodeId child) {
      return std::tuple(tree.radius_vx.empty() ? 0.0f : tree.radius_vx[at(child)], tips[at(child)],
                        glm::dot(heading, glm::normalize(tree.position_vx[at(child)] - here)));
    };
    const auto limb = std::max_element(first, last, [&](NodeId a, NodeId b) { return rank(a) < rank(b); });
    std::rotate(first, limb, limb + 1);
  }

  std::vector<std::int32_t> begin_;
  std::vector<NodeId> children_;
};

/// In which iteration each node is placed.
std::vector<std::int32_t> pace(const std::vector<double>& lengths, double farthest, int iterations) {
  std::vector<std::int32_t> paced;
  for (const double length : lengths) {
    const double share = farthest > 0.0 ? length / farthest : 0.0;
    paced.push_back(std::clamp(static_cast<std::int32_t>(std::ceil(share * iterations)) - 1, 0,
                               std::max(0, iterations - 1)));
  }
  return paced;
}

ArrangedTree inWaves(const GivenTree& tree, const std::vector<std::int32_t>& iteration_of, int iterations) {
  const Forks forks(tree);
  ArrangedTree made;
  struct Waiting {
    NodeId parent = sim::kNoNode;  // its new number
    NodeId node = 0;               // its old one
    std::int32_t number = 0;
  };
  std::vector<std::vector<Waiting>> of_iteration(static_cast<std::size_t>(std::max(1, iterations)));
  std::int32_t wave = 0;
  const auto place = [&](const Waiting& one, std::int32_t iteration) {
    const auto fresh = static_cast<NodeId>(made.order.size());
    made.tree.parent.push_back(one.parent);
    made.tree.position_vx.push_back(tree.position_vx[at(one.node)]);
    if (!tree.radius_vx.empty()) made.tree.radius_vx.push_back(tree.radius_vx[at(one.node)]);
    made.order.push_back(one.parent == sim::kNoNode ? 0
                                                    : made.order[at(one.parent)] + (one.number > 0 ? 1 : 0));
    made.number.push_back(one.number);
    made.iteration.push_back(iteration);
    made.wave.push_back(wave);
    std::int32_t number = 0;
    for (const NodeId child : forks.of(one.node))
      of_iteration[at(iteration_of[at(child)])].push_back({fresh, child, number++});
  };
  place({}, 0);
  for (std::size_t i = 0; i < of_iteration.size(); ++i) {
    while (!of_iteration[i].empty()) {
      ++wave;
      std::vector<Waiting> now;
      now.swap(of_iteration[i]);
      std::sort(now.begin(), now.end(), [](const Waiting& a, const Waiting& b) {
        return std::tuple(a.parent, a.number) < std::tuple(b.parent, b.number);
      });
      for (const Waiting& one : now) place(one, static_cast<std::int32_t>(i));
    }
  }
  return made;
}

}  // namespace

std::vector<ArrangedTree> arranged(std::vector<GivenTree> trees, int iterations) {
  std::vector<std::vector<double>> lengths;
  double farthest = 0.0;
  for (const GivenTree& tree : trees) {
    lengths.push_back(lengthsOf(tree));
    farthest = std::max(farthest, *std::max_element(lengths.back().begin(), lengths.back().end()));
  }
  std::vector<ArrangedTree> all;
  for (std::size_t i = 0; i < trees.size(); ++i) {
    all.push_back(inWaves(trees[i], pace(lengths[i], farthest, iterations), iterations));
    trees[i] = {};
    lengths[i] = {};
  }
  return all;
}

}  // namespace espalier::rules
