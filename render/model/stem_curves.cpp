#include "render/model/stem_curves.h"

#include <algorithm>

#include "sim/base/parallel.h"

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

/// The first of the nodes in each node's place, going down from it.
std::vector<NodeId> placesOf(const sim::Skeleton& skeleton) {
  std::vector<NodeId> places(static_cast<std::size_t>(skeleton.size()));
  for (NodeId n = 0; n < skeleton.size(); ++n) {
    const NodeId parent = skeleton.parent[static_cast<std::size_t>(n)];
    const NodeId below = parent == sim::kNoNode ? n : places[static_cast<std::size_t>(parent)];
    const bool same = glm::distance(positionOf(skeleton, n), positionOf(skeleton, below)) <= kSamePlace;
    places[static_cast<std::size_t>(n)] = same ? below : n;
  }
  return places;
}

/// The places that grow from each place, in the order of their numbers.
class Children {
 public:
  Children(const sim::Skeleton& skeleton, const std::vector<NodeId>& places) : begin_(places.size() + 1) {
    const auto forEach = [&](auto visit) {
      for (std::size_t n = 0; n < places.size(); ++n) {
        const NodeId parent = skeleton.parent[n];
        if (parent == sim::kNoNode || places[n] != static_cast<NodeId>(n)) continue;
        visit(static_cast<NodeId>(n), static_cast<std::size_t>(places[static_cast<std::size_t>(parent)]));
      }
    };
    forEach([&](NodeId, std::size_t parent) { ++begin_[parent + 1]; });
    for (std::size_t n = 0; n < places.size(); ++n) begin_[n + 1] += begin_[n];
    nodes_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    forEach([&](NodeId node, std::size_t parent) { nodes_[next[parent]++] = node; });
  }

  std::span<const NodeId> of(NodeId n) const {
    const auto i = static_cast<std::size_t>(n);
    return {nodes_.data() + begin_[i], begin_[i + 1] - begin_[i]};
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<NodeId> nodes_;
};

NodeId continuing(const sim::Skeleton& skeleton, std::span<const float> radii,
                  std::span<const NodeId> children, NodeId at, Vec3 heading) {
  return *std::max_element(children.begin(), children.end(), [&](NodeId a, NodeId b) {
    const float ra = radii[static_cast<std::size_t>(a)], rb = radii[static_cast<std::size_t>(b)];
    if (ra != rb) return ra < rb;
    const auto straightness = [&](NodeId n) {
      return glm::dot(heading, unitOr(positionOf(skeleton, n) - positionOf(skeleton, at), heading));
    };
    return straightness(a) < straightness(b);
  });
}

std::uint8_t orderOf(const sim::Skeleton& skeleton, NodeId first, std::size_t generation) {
  constexpr std::size_t kMost = 255;
  const std::vector<float>* const counted = sim::find(skeleton, "order");
  if (counted == nullptr) return static_cast<std::uint8_t>(std::min(generation, kMost));
  const float order = (*counted)[static_cast<std::size_t>(first)];
  return order > 0.0f ? static_cast<std::uint8_t>(std::min(order, static_cast<float>(kMost)))
                      : std::uint8_t{0};
}

/// A stem leaves its parent half along the parent, as young shoots do, rather than with a kink; the less, the
/// thicker the parent is: from a trunk a twig goes straight out.
std::optional<Vec3> leavingDerivative(const StemCurves& curves, std::span<const float> radii,
                                      std::span<const Vec3> points, NodeId fork) {
  constexpr double kAlong = 0.7;
  const std::int32_t parent_stem = curves.stem_of[static_cast<std::size_t>(fork)];
  if (parent_stem < 0) return {};
  const Vec3 chord = points[1] - points[0];
  const Vec3 along = curves.stems[static_cast<std::size_t>(parent_stem)].curve.derivative(
      curves.parameter_of[static_cast<std::size_t>(fork)]);
  const double length = glm::length(chord);
  const Vec3 out = chord / length;
  const Vec3 ahead = unitOr(along, out);
  if (glm::dot(out, ahead) < -0.5) return {};
  const double thick = static_cast<double>(radii[static_cast<std::size_t>(fork)]) / length;
  return length * glm::normalize(out + kAlong * std::max(1.0 - 2.0 * thick, 0.0) * ahead);
}

}  // namespace

StemCurves stemCurves(const sim::Skeleton& skeleton, std::span<const float> radii, const Blocked& blocked) {
  const std::vector<NodeId> places = placesOf(skeleton);
  const Children children(skeleton, places);
  StemCurves curves;
  curves.stem_of.assign(places.size(), -1);
  curves.parameter_of.assign(places.size(), 0.0);

  struct Start {
    NodeId fork, first;
  };
  std::vector<Start> starts;
  std::vector<std::size_t> generation_of;
  for (NodeId seed = 0; seed < skeleton.size(); ++seed) {
    if (skeleton.parent[static_cast<std::size_t>(seed)] != sim::kNoNode || children.of(seed).empty())
      continue;
    starts.push_back({seed, continuing(skeleton, radii, children.of(seed), seed, Vec3(0, 1, 0))});
  }
  const std::size_t seeds = starts.size();
  curves.generations = {0};
  for (std::size_t s = 0, last = seeds; s < starts.size(); ++s) {
    if (s == last) {
      curves.generations.push_back(s);
      last = starts.size();
    }
    const Start start = starts[s];
    const auto stem = static_cast<std::int32_t>(s);
    std::vector<NodeId> nodes{start.fork};
    const auto fork = [&](NodeId at, NodeId main) {
      for (const NodeId n : children.of(at))
        if (n != main) starts.push_back({at, n});
    };
    if (s < seeds) {
      curves.stem_of[static_cast<std::size_t>(start.fork)] = stem;
      fork(start.fork, start.first);
    }
    for (NodeId at = start.first;;) {
      const Vec3 heading = glm::normalize(positionOf(skeleton, at) - positionOf(skeleton, nodes.back()));
      nodes.push_back(at);
      curves.stem_of[static_cast<std::size_t>(at)] = stem;
      curves.parameter_of[static_cast<std::size_t>(at)] = static_cast<double>(nodes.size() - 1);
      if (children.of(at).empty()) break;
      const NodeId main = continuing(skeleton, radii, children.of(at), at, heading);
      fork(at, main);
      at = main;
    }
    curves.stems.push_back(
        {std::move(nodes), {}, s < seeds, orderOf(skeleton, start.first, curves.generations.size() - 1)});
  }
  if (!starts.empty()) curves.generations.push_back(starts.size());
  for (std::size_t n = 0; n < places.size(); ++n) {
    const auto place = static_cast<std::size_t>(places[n]);
    curves.stem_of[n] = curves.stem_of[place];
    curves.parameter_of[n] = curves.parameter_of[place];
  }

  for (std::size_t g = 0; g + 1 < curves.generations.size(); ++g) {
    const std::size_t first = curves.generations[g];
    sim::parallelFor(curves.generations[g + 1] - first, 64, [&](std::size_t begin, std::size_t end) {
      std::vector<Vec3> points;
      for (std::size_t i = first + begin; i < first + end; ++i) {
        StemCurve& stem = curves.stems[i];
        points.clear();
        for (const NodeId n : stem.nodes) points.push_back(positionOf(skeleton, n));
        stem.curve = StemLine(
            points, g == 0 ? std::nullopt : leavingDerivative(curves, radii, points, stem.nodes[0]), blocked);
      }
    });
  }
  return curves;
}

std::uint8_t StemCurves::orderAt(NodeId node) const {
  const std::int32_t stem = stem_of[static_cast<std::size_t>(node)];
  return stem < 0 ? std::uint8_t{0} : stems[static_cast<std::size_t>(stem)].order;
}

}  // namespace espalier::render
