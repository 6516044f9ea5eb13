#include "rules/growth/laid_measure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "rules/growth/laid_kinds.h"
#include "rules/growth/surface_points.h"
#include "rules/growth/voxel_widths.h"

namespace espalier::rules {
namespace {

constexpr double kMeasuredPoints = 1e6;
constexpr double kFarJoint = 3.0;  // times the gap that was asked

/// Something that lies flat.
struct Lying {
  Stance stance;
  Outline outline;  ///< about the stance
};

double farthestOf(const Outline& outline) {
  double far = 0.0;
  for (const glm::dvec2 p : outline) far = std::max(far, glm::length(p));
  return far;
}

/// How far a ray goes until it meets an outline; infinite where it does not.
double meets(glm::dvec2 from, glm::dvec2 way, const Outline& outline) {
  double nearest = kNoLimit;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 p = outline[i] - from, q = outline[(i + 1) % outline.size()] - from;
    const double hp = way.x * p.y - way.y * p.x, hq = way.x * q.y - way.y * q.x;
    if ((hp < 0.0) == (hq < 0.0)) continue;
    const double t = glm::dot(glm::mix(p, q, hp / (hp - hq)), way);
    if (t >= 0.0) nearest = std::min(nearest, t);
  }
  return nearest;
}

struct JointSums {
  double length = 0.0, first = 0.0, second = 0.0, rims = 0.0;
};

void measureJoints(const Lying& lying, std::span<const Outline> others, double asked_vx, JointSums& sums) {
  constexpr int kSamples = 16;  // of an edge
  const Outline& outline = lying.outline;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 from = outline[i], to = outline[(i + 1) % outline.size()];
    const double length = glm::length(to - from);
    if (!(length > 0.0)) continue;
    const glm::dvec2 way = (to - from) / length, out(way.y, -way.x);
    sums.rims += length;
    for (int k = 0; k < kSamples; ++k) {
      const glm::dvec2 at = glm::mix(from, to, (k + 0.5) / kSamples);
      double far = kNoLimit;
      for (const Outline& other : others) far = std::min(far, meets(at, out, other));
      if (!(far <= kFarJoint * asked_vx)) continue;
      const double share = length / kSamples;
      sums.length += share;
      sums.first += share * far;
      sums.second += share * far * far;
    }
  }
}

Joints jointsOf(const std::vector<Lying>& all, double asked_vx) {
  double reach = 0.0;
  for (const Lying& lying : all) reach = std::max(reach, farthestOf(lying.outline));
  const double far = 2.0 * reach + kFarJoint * asked_vx;
  std::map<std::tuple<int, int, int>, std::vector<const Lying*>> in_cell;
  const auto cellOf = [&](sim::Vec3 at_vx) { return glm::ivec3(glm::floor(at_vx / std::max(1.0, far))); };
  for (const Lying& lying : all) {
    const glm::ivec3 cell = cellOf(lying.stance.at_vx);
    in_cell[{cell.x, cell.y, cell.z}].push_back(&lying);
  }
  JointSums sums;
  std::vector<Outline> others;
  for (const Lying& lying : all) {
    others.clear();
    const glm::ivec3 about = cellOf(lying.stance.at_vx);
    for (int i = 0; i < 27; ++i) {
      const auto cell = in_cell.find({about.x + i % 3 - 1, about.y + i / 3 % 3 - 1, about.z + i / 9 - 1});
      if (cell == in_cell.end()) continue;
      for (const Lying* const other : cell->second) {
        if (other == &lying || glm::distance(other->stance.at_vx, lying.stance.at_vx) > far) continue;
        Outline seen;
        for (const glm::dvec2 p : other->outline) seen.push_back(lying.stance.seen(other->stance.placed(p)));
        others.push_back(std::move(seen));
      }
    }
    measureJoints(lying, others, asked_vx, sums);
  }
  Joints joints{asked_vx, 0.0, 0.0, sums.length, sums.rims};
  if (sums.length > 0.0) {
    joints.mean_vx = sums.first / sums.length;
    joints.deviation_vx =
        std::sqrt(std::max(0.0, sums.second / sums.length - joints.mean_vx * joints.mean_vx));
  }
  return joints;
}

}  // namespace

LaidMeasure measureLaid(const std::shared_ptr<const RuleSet>& rules, std::span<const sim::Plant> plants,
                        const std::shared_ptr<const sim::SceneSurface>& surface, const sim::World& world) {
  const RuleBook book(inVoxelWidths(rules, world.frame().voxel_m));
  const std::vector<LaidKind> kinds = laidKinds(book);
  const auto kindOf = [&](const sim::PlacedElement& element) -> const LaidKind& {
    return kinds[static_cast<std::size_t>(element.shape)];
  };
  std::vector<Stance> stances;
  std::vector<Lying> flat;
  for (const sim::Plant& plant : plants) {
    for (const sim::PlacedElement& element : plant.elements) {
      const LaidKind& kind = kindOf(element);
      stances.push_back(stanceOf(element, kind.rule->pose));
      if (kind.flat) flat.push_back({stances.back(), outlineAbout(stances.back(), element, kind)});
    }
  }
  LaidMeasure measure;
  SurfacePoints points = pointsAround(stances, *surface, book, world, kMeasuredPoints);
  for (const sim::Plant& plant : plants) {
    for (const sim::PlacedElement& element : plant.elements)
      cover(element, kindOf(element), book.top().diffusion.off.number, points);
  }
  measure.surface_vx2 = points.area();
  measure.covered_vx2 = points.coveredArea();
  const double asked_vx = book.top().diffusion.gap_min.number;
  if (asked_vx > 0.0 && !flat.empty()) measure.joints = jointsOf(flat, asked_vx);
  return measure;
}

}  // namespace espalier::rules
