#include "render/model/stem_curves.h"

#include <algorithm>

namespace espalier::render {
namespace {

using sim::NodeId;
using sim::Vec3;

constexpr double kSamePlace = 1e-6;  // voxel widths

Vec3 positionOf(const sim::Skeleton& skeleton, NodeId n) {
  return skeleton.position_vx[static_cast<std::size_t>(n)];
}

Vec3 unitOr(Vec3 v, Vec3 otherwise) {
  const double length = glm::length(v);
  return length > kSamePlace ? v / length : otherwise;
}

std::vector<std::vector<NodeId>> childrenOf(const sim::Skeleton& skeleton) {
  std::vector<std::vector<NodeId>> children(static_cast<std::size_t>(skeleton.size()));
  for (NodeId n = 0; n < skeleton.size(); ++n) {
    const NodeId parent = skeleton.parent[static_cast<std::size_t>(n)];
    if (parent != sim::kNoNode) children[static_cast<std::size_t>(parent)].push_back(n);
  }
  return children;
}

NodeId continuing(const sim::Skeleton& skeleton, std::span<const float> radii,
                  const std::vector<NodeId>& children, NodeId at, Vec3 heading) {
  return *std::max_element(children.begin(), children.end(), [&](NodeId a, NodeId b) {
    const float ra = radii[static_cast<std::size_t>(a)], rb = radii[static_cast<std::size_t>(b)];
    if (ra != rb) return ra < rb;
    const auto straightness = [&](NodeId n) {
      return glm::dot(heading, unitOr(positionOf(skeleton, n) - positionOf(skeleton, at), heading));
    };
    return straightness(a) < straightness(b);
  });
}

/// A stem leaves its parent half along the parent, as young shoots do, rather than with a kink.
std::optional<Vec3> leavingDerivative(const StemCurves& curves, std::span<const Vec3> points, NodeId fork) {
  const std::int32_t parent_stem = curves.stem_of[static_cast<std::size_t>(fork)];
  if (parent_stem < 0 || points.size() < 2) return {};
  const Vec3 chord = points[1] - points[0];
  const Vec3 along = curves.stems[static_cast<std::size_t>(parent_stem)].curve.derivative(
      curves.parameter_of[static_cast<std::size_t>(fork)]);
  const Vec3 out = glm::normalize(chord);
  const Vec3 ahead = unitOr(along, out);
  if (glm::dot(out, ahead) < -0.5) return {};
  return glm::length(chord) * glm::normalize(out + 0.7 * ahead);
}

}  // namespace

StemCurves stemCurves(const sim::Skeleton& skeleton, std::span<const float> radii) {
  const auto children = childrenOf(skeleton);
  StemCurves curves;
  curves.stem_of.assign(children.size(), -1);
  curves.parameter_of.assign(children.size(), 0.0);

  struct Start {
    NodeId fork, first;
    bool from_seed;
  };
  std::vector<Start> starts;
  for (NodeId seed = 0; seed < skeleton.size(); ++seed) {
    if (skeleton.parent[static_cast<std::size_t>(seed)] != sim::kNoNode) continue;
    const auto& first = children[static_cast<std::size_t>(seed)];
    if (first.empty()) continue;
    const NodeId main = continuing(skeleton, radii, first, seed, Vec3(0, 1, 0));
    starts.push_back({seed, main, true});
    for (const NodeId n : first)
      if (n != main) starts.push_back({seed, n, true});
  }
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const Start start = starts[s];
    const auto stem = static_cast<std::int32_t>(curves.stems.size());
    std::vector<NodeId> nodes{start.fork};
    std::vector<Vec3> points{positionOf(skeleton, start.fork)};
    if (start.from_seed) curves.stem_of[static_cast<std::size_t>(start.fork)] = stem;
    Vec3 heading(0, 1, 0);
    for (NodeId at = start.first;;) {
      const Vec3 p = positionOf(skeleton, at);
      if (glm::distance(p, points.back()) > kSamePlace) {
        heading = glm::normalize(p - points.back());
        points.push_back(p);
        nodes.push_back(at);
      }
      curves.stem_of[static_cast<std::size_t>(at)] = stem;
      curves.parameter_of[static_cast<std::size_t>(at)] = static_cast<double>(points.size() - 1);
      const auto& next = children[static_cast<std::size_t>(at)];
      if (next.empty()) break;
      const NodeId main = continuing(skeleton, radii, next, at, heading);
      for (const NodeId n : next)
        if (n != main) starts.push_back({at, n, false});
      at = main;
    }
    const auto leaving = start.from_seed ? std::nullopt : leavingDerivative(curves, points, start.fork);
    curves.stems.push_back({std::move(nodes), Spline(points, leaving), start.from_seed});
  }
  return curves;
}

Vec3 StemCurves::onStem(const sim::Skeleton& skeleton, NodeId node, Vec3 on_segment_vx) const {
  const std::int32_t stem = stem_of[static_cast<std::size_t>(node)];
  const NodeId parent = skeleton.parent[static_cast<std::size_t>(node)];
  if (stem < 0 || parent == sim::kNoNode) return positionOf(skeleton, node);
  const Vec3 a = positionOf(skeleton, parent), b = positionOf(skeleton, node);
  const double length2 = glm::dot(b - a, b - a);
  const double along = length2 > kSamePlace * kSamePlace
                           ? std::clamp(glm::dot(on_segment_vx - a, b - a) / length2, 0.0, 1.0)
                           : 1.0;
  const double t = parameter_of[static_cast<std::size_t>(node)];
  return stems[static_cast<std::size_t>(stem)].curve.position(std::max(t - 1.0 + along, 0.0));
}

}  // namespace espalier::render
