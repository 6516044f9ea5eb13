#include "rules/growth/front_bend.h"

#include <algorithm>
#include <cmath>

#include "sim/base/parallel.h"
#include "sim/base/random.h"

namespace espalier::rules {
namespace {

const Colonization& ruleFor(const RuleBook& book, std::int32_t order) {
  return book.ofOrder(order).colonization;
}

sim::Vec3 normalOf(const Front& front, const Guidance& guidance, const Errand& errand, sim::Vec3 at,
                   GuideAxis axis) {
  if (guidance.normals == nullptr || guidance.normals->empty()) return sim::Vec3(0.0);
  const Attractors& attractors = front.attractors;
  std::int32_t nearest = kNobody;
  if (axis == GuideAxis::node_normal) nearest = nearestOfAll(attractors, at);
  if (axis == GuideAxis::attractor_normal)
    nearest = nearestWaiting(attractors, at, HUGE_VAL, errand.from.front);
  if (nearest == kNobody) return sim::Vec3(0.0);
  return (*guidance.normals)[asIndex(attractors.number[asIndex(nearest)])];
}

sim::Vec3 guided(const Errand& errand, const Front& front, const sim::Skeleton& skeleton,
                 const Guidance& guidance) {
  const sim::Vec3 at = front.nodes[asIndex(errand.from.front)];
  sim::Vec3 sum(0.0);
  for (const Guide& guide : guidance.guides) {
    sum += guideAt(guide,
                   {at, skeleton.position_vx.front(), guidance.farthest_vx[asIndex(errand.from.plant)],
                    normalOf(front, guidance, errand, at, guide.axis), nextOrder(front, errand.from.front)});
  }
  return guidedWay(errand.direction, sum);
}

sim::Vec3 headingOf(const sim::Skeleton& skeleton, sim::NodeId node) {
  const sim::NodeId parent = skeleton.parent[asIndex(node)];
  if (parent == sim::kNoNode) return sim::Vec3(0.0);
  return glm::normalize(skeleton.position_vx[asIndex(node)] - skeleton.position_vx[asIndex(parent)]);
}

/// Whether the errand comes nearer to what it goes for alone, another way too: or it would stall.
bool leadsNearer(const Errand& errand, sim::Vec3 from, sim::Vec3 way, const Front& front) {
  const sim::Vec3 to = front.attractors.at(front.attractors.place[asIndex(errand.attractor)]);
  const sim::Vec3 end = from + glm::length(errand.end_vx - from) * way;
  return distance2(end, to) < distance2(from, to);
}

}  // namespace

std::vector<double> farthestOf(const Attractors& attractors, const std::vector<sim::Vec3>& starts) {
  std::vector<double> farthest(starts.size(), 0.0);
  for (std::int32_t i = 0; i < attractors.size(); ++i) {
    std::size_t nearest = 0;
    double least2 = HUGE_VAL;
    for (std::size_t k = 0; k < starts.size(); ++k) {
      const double away2 = distance2(attractors.at(i), starts[k]);
      if (away2 < least2) nearest = k;
      least2 = std::min(least2, away2);
    }
    if (!starts.empty()) farthest[nearest] = std::max(farthest[nearest], std::sqrt(least2));
  }
  return farthest;
}

void aim(Errand& errand, const Front& front, const Way& way, const OrderRules& rules) {
  const Goal goal = goalOf(front, way, way.direction, rules);
  errand.direction = way.direction;
  errand.end_vx = goal.end;
  errand.attractor = goal.attractor;
}

void bend(std::vector<Errand>& errands, const Front& front, const sim::StandView& stand, const RuleBook& book,
          const OrderRules& rules, const Guidance& guidance) {
  sim::parallelFor(errands.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Errand& errand = errands[i];
      if (errand.trunk || errand.meets != sim::kNoNode) continue;
      const sim::Skeleton& skeleton = stand.plants[asIndex(errand.from.plant)].skeleton;
      const sim::Vec3 from = skeleton.position_vx[asIndex(errand.from.node)];
      sim::Vec3 way = errand.direction;
      if (!guidance.guides.empty()) {
        way = guided(errand, front, skeleton, guidance);
        if (errand.gait != Gait::pulled && !leadsNearer(errand, from, way, front)) way = errand.direction;
      }
      const std::int32_t order = nextOrder(front, errand.from.front);
      const Branching& branching = ruleFor(book, order).branching;
      const bool branches = front.sent[asIndex(errand.from.front)] > 0;
      const double least = branches ? branching.angle_min_deg : 0.0;
      if (least > 0.0 || branching.angle_max_deg < 180.0)
        way = withinAngles(way, headingOf(skeleton, errand.from.node), least, branching.angle_max_deg);
      if (way == errand.direction) continue;
      if (book.top().colonization.onto) {  // it ends on an attractor: perhaps on another one
        if (errand.gait == Gait::pulled) aim(errand, front, {errand.from.front, errand.number, way}, rules);
        continue;
      }
      errand.end_vx = from + glm::length(errand.end_vx - from) * way;
      errand.direction = way;
    }
  });
}

bool mayBranch(const sim::StandView& stand, const RuleBook& book, const FrontNode& node, std::int32_t order) {
  int sent = 0;
  stand.kin[asIndex(node.plant)].forEachChild(node.node, [&](sim::NodeId) { ++sent; });
  if (sent == 0) return true;
  const Branching& branching = ruleFor(book, order).branching;
  const sim::Skeleton& skeleton = stand.plants[asIndex(node.plant)].skeleton;
  const double above = std::abs(skeleton.position_vx[asIndex(node.node)].y - skeleton.position_vx.front().y);
  return sent <= branching.most && above >= branching.above.number;
}

sim::Vec3 withinAngles(sim::Vec3 way, sim::Vec3 heading, double least_deg, double most_deg) {
  if (heading == sim::Vec3(0.0)) return way;
  constexpr double kDegree = 3.14159265358979323846 / 180.0;
  const double angle = std::acos(std::clamp(glm::dot(way, heading), -1.0, 1.0));
  const double wanted = std::clamp(angle, least_deg * kDegree, most_deg * kDegree);
  if (wanted == angle) return way;
  const sim::Vec3 across = way - glm::dot(way, heading) * heading;
  const double length = glm::length(across);
  const sim::Vec3 aside = length > 1e-9 ? across / length : sim::perpendicular(heading);
  return glm::normalize(std::cos(wanted) * heading + std::sin(wanted) * aside);
}

}  // namespace espalier::rules
