#include "tests/bench/kd_tree_peer.h"

#if __has_include(<nanoflann.hpp>)
#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>

#include "sim/base/parallel.h"

namespace espalier::bench {
namespace {

using sim::Vec3;

struct Cloud {
  const std::vector<Vec3>& points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<int>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, std::uint32_t>;

struct Pulled {
  std::int32_t node, attractor;
};

std::size_t asIndex(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

class Peer {
 public:
  Peer(std::span<const Vec3> attractors, Vec3 start, const rules::FrontRules& rules)
      : attractors_(attractors), rules_(rules), alive_(attractors.size(), true), nearest_(attractors.size()) {
    join(start, rules::kNobody, 0);
  }

  bool step(int iteration) {
    findNearest();
    const std::size_t before = colony.position.size();
    for (auto first = pulled_.begin(); first != pulled_.end();) {
      const auto last =
          std::find_if(first, pulled_.end(), [&](const Pulled& p) { return p.node != first->node; });
      grow({first, last}, iteration);
      first = last;
    }
    return colony.position.size() > before;
  }

  rules::Colony colony;

 private:
  void join(Vec3 at, std::int32_t parent, int iteration) {
    colony.position.push_back(at);
    colony.parent.push_back(parent);
    colony.born.push_back(iteration);
    tried_.push_back(-1);
    straight_.push_back(false);
  }

  /// Kills what is near, and lists who pulls whom.
  void findNearest() {
    const Cloud cloud{colony.position};
    const Tree tree(3, cloud, {16});
    sim::parallelFor(attractors_.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (!alive_[i]) continue;
        std::uint32_t node = 0;
        double away2 = 0.0;
        tree.knnSearch(&attractors_[i].x, 1, &node, &away2);
        const bool acts = away2 < rules_.influence * rules_.influence;
        nearest_[i] = acts ? static_cast<std::int32_t>(node) : rules::kNobody;
        if (away2 < rules_.kill * rules_.kill) alive_[i] = 0;
      }
    });
    pulled_.clear();
    for (std::size_t i = 0; i < attractors_.size(); ++i) {
      if (alive_[i] && nearest_[i] != rules::kNobody)
        pulled_.push_back({nearest_[i], static_cast<std::int32_t>(i)});
    }
    std::sort(pulled_.begin(), pulled_.end(), [](const Pulled& a, const Pulled& b) {
      return a.node != b.node ? a.node < b.node : a.attractor < b.attractor;
    });
  }

  Vec3 unitTo(Vec3 from, Vec3 to) const { return (to - from) / std::sqrt(rules::distance2(from, to)); }

  void grow(std::span<const Pulled> by, int iteration) {
    const std::int32_t node = by.front().node;
    const Vec3 from = colony.position[asIndex(node)];
    std::vector<std::int32_t> left;
    for (const Pulled& p : by) left.push_back(p.attractor);
    const auto nearest = [&] {
      return *std::min_element(left.begin(), left.end(), [&](std::int32_t a, std::int32_t b) {
        return rules::distance2(attractors_[asIndex(a)], from) <
               rules::distance2(attractors_[asIndex(b)], from);
      });
    };
    const auto giveUp = [&](std::int32_t attractor) {
      alive_[asIndex(attractor)] = 0;
      std::erase(left, attractor);
    };
    const bool same = tried_[asIndex(node)] == static_cast<std::int32_t>(left.size());
    bool straight = same;
    if (same && straight_[asIndex(node)]) {
      giveUp(nearest());
      straight = false;
    }
    std::int64_t sum[3] = {0, 0, 0};
    for (const std::int32_t a : left) {
      const Vec3 to = attractors_[asIndex(a)] - from;
      const Vec3 unit = to * (rules::kPullOne / std::sqrt(rules::distance2(attractors_[asIndex(a)], from)));
      for (int axis = 0; axis < 3; ++axis) sum[axis] += std::llrint(unit[axis]);
    }
    const Vec3 pull(static_cast<double>(sum[0]), static_cast<double>(sum[1]), static_cast<double>(sum[2]));
    const double length = std::sqrt(rules::distance2(pull, Vec3(0.0)));
    Vec3 way = length > 0.0 ? pull / length : Vec3(0.0);
    if (straight || length == 0.0) {
      straight = true;
      while (!left.empty() &&
             2.0 * std::sqrt(rules::distance2(attractors_[asIndex(nearest())], from)) <= rules_.step)
        giveUp(nearest());
      if (left.empty()) return;
      way = unitTo(from, attractors_[asIndex(nearest())]);
    }
    tried_[asIndex(node)] = static_cast<std::int32_t>(left.size());
    straight_[asIndex(node)] = straight;
    join(from + rules_.step * way, node, iteration);
  }

  std::span<const Vec3> attractors_;
  rules::FrontRules rules_;
  std::vector<char> alive_;
  std::vector<std::int32_t> nearest_;  // node of each attractor
  std::vector<Pulled> pulled_;
  std::vector<std::int32_t> tried_;
  std::vector<bool> straight_;
};

}  // namespace

std::optional<rules::Colony> colonizeByKdTree(std::span<const Vec3> attractors, Vec3 start,
                                              const rules::FrontRules& rules, int iterations) {
  Peer peer(attractors, start, rules);
  while (peer.colony.iterations < iterations && peer.step(peer.colony.iterations)) ++peer.colony.iterations;
  return std::move(peer.colony);
}

}  // namespace espalier::bench
#else
namespace espalier::bench {
std::optional<rules::Colony> colonizeByKdTree(std::span<const sim::Vec3>, sim::Vec3, const rules::FrontRules&,
                                              int) {
  return std::nullopt;
}
}  // namespace espalier::bench
#endif
