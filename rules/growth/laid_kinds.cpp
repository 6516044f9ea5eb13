#include "rules/growth/laid_kinds.h"

#include <algorithm>

#include "rules/diffusion/beside.h"

namespace espalier::rules {
namespace {

LaidKind kindOf(const Element& element) {
  LaidKind kind;
  kind.rule = &element;
  kind.flat = liesFlat(element.pose);
  std::vector<glm::dvec2> points;
  double nearest = kNoLimit;
  for (const auto& polygon : element.polygons) {
    for (const sim::Vec3 corner : polygon) {
      points.emplace_back(corner);
      nearest = std::min(nearest, glm::length(corner));
      kind.reach = std::max(kind.reach, glm::length(corner));
      kind.low = std::min(kind.low, corner.z);
      kind.high = std::max(kind.high, corner.z);
    }
  }
  if (!points.empty()) kind.off_foot = nearest;
  if (!kind.flat || points.empty()) return kind;
  kind.outline = hullOf(std::move(points));
  kind.edges = distinctEdges(kind.outline);
  return kind;
}

}  // namespace

std::vector<LaidKind> laidKinds(const RuleBook& book) {
  std::vector<LaidKind> kinds(book.shapes().size());
  forEachSet(book.top(), [&](const RuleSet& set, const std::string&) {
    const auto first = static_cast<std::size_t>(book.firstShape(set));
    for (std::size_t i = 0; i < set.elements.size(); ++i) kinds[first + i] = kindOf(set.elements[i]);
  });
  return kinds;
}

Stance stanceOf(const sim::PlacedElement& element, Pose pose) {
  Stance stance;
  stance.at_vx = element.position_vx;
  const bool faces_out = liesFlat(pose) || pose == Pose::light;
  stance.normal = faces_out ? element.z : element.y;
  stance.y = faces_out ? element.y : element.z;
  stance.x = glm::cross(stance.y, stance.normal);
  return stance;
}

Outline outlineAbout(const Stance& stance, const sim::PlacedElement& element, const LaidKind& kind) {
  Outline outline;
  for (const glm::dvec2 p : kind.outline)
    outline.push_back(stance.seen(sim::placed(element, {p.x, p.y, 0.0})));
  if (areaOf(outline) < 0.0) std::reverse(outline.begin(), outline.end());
  return outline;
}

double widestBend(const RuleBook& book) {
  double widest = 0.0;
  forEachSet(book.top(), [&](const RuleSet& set, const std::string&) {
    widest = std::max(widest, set.diffusion.bend_deg);
  });
  return widest;
}

double farthestFoot(const Diffusion& diffusion, double beside_vx, double own_vx) {
  constexpr double kMostDeviations = 3.5 * 1.5;  // to each of two sides
  const double far = highest(diffusion.far());
  switch (diffusion.around) {
    case Around::ring:
      return far;
    case Around::gaussian:
      return kMostDeviations * far;
    case Around::edges:
      return std::max(far,
                      beside_vx + diffusion.gap_min.number + own_vx);  // by chance beside what is not flat
    case Around::steps:
      break;
  }
  double step = 0.0;
  for (const glm::dvec2 s : diffusion.steps) step = std::max(step, glm::length(s));
  return step + kMostDeviations * far;
}

double mostReach(const RuleBook& book, const std::vector<LaidKind>& kinds) {
  double most = 0.0;
  forEachSet(book.top(), [&](const RuleSet& set, const std::string&) {
    double radius = 0.0;
    const auto first = static_cast<std::size_t>(book.firstShape(set));
    for (std::size_t i = 0; i < set.elements.size(); ++i) {
      const double scale = highest(set.elements[i].size) * std::max(1.0, set.light.boost);
      radius = std::max(radius, kinds[first + i].reach * scale);
    }
    const Diffusion& d = set.diffusion;
    const double far = farthestFoot(d, radius, radius);
    most = std::max(most, far + radius + d.gap_min.number);
  });
  return most;
}

}  // namespace espalier::rules
