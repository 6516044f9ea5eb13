#include "render/form/reshaped.h"

#include <algorithm>
#include <cstddef>

namespace espalier::render {
namespace {

using sim::NodeId;
using sim::Vec3;

/// The new plant's nodes as they come.
class Renumbered {
 public:
  Renumbered(const sim::Plant& plant, std::span<const Reshaped> ways)
      : plant_(plant), ways_(ways), first_(ways.size(), sim::kNoNode) {
    for (const auto& [name, values] : plant.skeleton.columns) skeleton_.columns[name];
    for (NodeId n = 0; n < plant.skeleton.size(); ++n) add(n);
  }

  sim::Skeleton take() { return std::move(skeleton_); }
  /// The new number of a point of a node's way.
  NodeId numberOf(NodeId node, std::size_t point) const {
    return first_[static_cast<std::size_t>(node)] + static_cast<NodeId>(point);
  }

 private:
  /// A way that leaves another comes after it.
  void add(NodeId node) {
    const auto n = static_cast<std::size_t>(node);
    if (first_[n] != sim::kNoNode) return;
    const Reshaped& way = ways_[n];
    const NodeId parent = plant_.skeleton.parent[n];
    NodeId below = sim::kNoNode;
    if (way.start) {
      add(way.start->way);
      below = numberOf(way.start->way, way.start->point);
    } else if (parent != sim::kNoNode) {
      add(parent);
      below = numberOf(parent, ways_[static_cast<std::size_t>(parent)].through.size() - 1);
    }
    first_[n] = skeleton_.size();
    for (const Vec3 place : way.through) {
      skeleton_.parent.push_back(below);
      below = skeleton_.size() - 1;
      skeleton_.position_vx.push_back(place);
      skeleton_.born.push_back(plant_.skeleton.born[n]);
      for (auto& [name, values] : skeleton_.columns)
        values.push_back(plant_.skeleton.columns.find(name)->second[n]);
    }
  }

  const sim::Plant& plant_;
  std::span<const Reshaped> ways_;
  std::vector<NodeId> first_;
  sim::Skeleton skeleton_;
};

/// How far along the segment from a to b the place next to p is, 0 to 1.
double shareOf(Vec3 a, Vec3 b, Vec3 p) {
  const Vec3 along = b - a;
  const double length2 = glm::dot(along, along);
  return length2 > 0.0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 1.0;
}

}  // namespace

void renumberJoins(const sim::Skeleton& old, const std::function<NodeId(NodeId)>& number,
                   sim::Skeleton& now) {
  const std::vector<float>* const were = sim::find(old, sim::kJoinsColumn);
  if (were == nullptr) return;
  std::vector<float>& joins = now.columns[sim::kJoinsColumn];
  joins.assign(now.parent.size(), 0.0f);
  for (NodeId n = 0; n < old.size(); ++n) {
    const auto joined = static_cast<NodeId>((*were)[static_cast<std::size_t>(n)]);
    if (joined > 0) joins[static_cast<std::size_t>(number(n))] = static_cast<float>(number(joined));
  }
}

void meetAgain(sim::Skeleton& skeleton) {
  const std::vector<float>* const joins = sim::find(skeleton, sim::kJoinsColumn);
  if (joins == nullptr) return;
  for (std::size_t n = 0; n < joins->size(); ++n) {
    if ((*joins)[n] > 0.0f)
      skeleton.position_vx[n] = skeleton.position_vx[static_cast<std::size_t>((*joins)[n])];
  }
}

sim::Plant reshaped(const sim::Plant& plant, std::span<const Reshaped> ways) {
  Renumbered numbers(plant, ways);
  sim::Plant result = plant;
  result.skeleton = numbers.take();
  renumberJoins(
      plant.skeleton,
      [&](NodeId n) { return numbers.numberOf(n, ways[static_cast<std::size_t>(n)].through.size() - 1); },
      result.skeleton);
  meetAgain(result.skeleton);
  const sim::Skeleton& was = plant.skeleton;
  for (sim::PlacedElement& element : result.elements) {
    const auto n = static_cast<std::size_t>(element.node);
    const Reshaped& way = ways[n];
    if (was.parent[n] == sim::kNoNode) {
      element.node = numbers.numberOf(element.node, 0);
      element.position_vx += way.through.back() - was.position_vx[n];
      continue;
    }
    const Vec3 from = was.position_vx[static_cast<std::size_t>(was.parent[n])], to = was.position_vx[n];
    const double share = shareOf(from, to, element.position_vx);
    const auto point = static_cast<std::size_t>(
        std::lower_bound(way.shares.begin(), way.shares.end() - 1, share) - way.shares.begin());
    element.node = numbers.numberOf(element.node, point);
    const auto end = static_cast<std::size_t>(element.node);
    const Vec3 start = result.skeleton.position_vx[static_cast<std::size_t>(result.skeleton.parent[end])];
    const double before = point > 0 ? way.shares[point - 1] : 0.0;
    const double width = way.shares[point] - before;
    const double within = width > 0.0 ? (share - before) / width : 1.0;
    element.position_vx += glm::mix(start, result.skeleton.position_vx[end], std::clamp(within, 0.0, 1.0)) -
                           glm::mix(from, to, share);
  }
  return result;
}

}  // namespace espalier::render
