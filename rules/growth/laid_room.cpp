#include "rules/growth/laid_room.h"

#include <algorithm>

#include "rules/growth/elements.h"
#include "sim/base/random.h"
#include "sim/grow/pieces.h"
#include "sim/tile/tiling.h"

namespace espalier::rules {
namespace {

using sim::Outcome;

/// An obstacle without room about it: what lies flat may touch it, and what stands may not stand in it.
bool blocks(const Outline& own, const Outline& obstacle) {
  return own.size() < 3 ? covers(obstacle, own.front()) : overlap(own, obstacle);
}

/// Lengths as small as this are none beside an element.
double slackOf(const Scaled& element) {
  return 1e-6 + 1e-6 * element.kind.reach * element.scale;
}

}  // namespace

Outline Scaled::outline() const {
  Outline scaled = kind.outline;
  for (glm::dvec2& corner : scaled) corner *= scale;
  return scaled;
}

void LaidRoom::look(const Stance& here, double reach_vx, double low_vx, double high_vx) {
  outlines_.clear();
  neighbours_.clear();
  thread_local std::vector<sim::NumberedElement> found;
  view_.pieces.elementsIn(boxAbout(here, reach_vx, 0.5 * reach_vx + 1.0), found);
  const int first = sim::numberOf(view_.world, view_.stand.front());
  for (const sim::NumberedElement& element : found) {
    const int plant = element.plant - first;
    if (plant < 0 || static_cast<std::size_t>(plant) >= view_.stand.size()) continue;
    const sim::PlacedElement& there = view_.stand[static_cast<std::size_t>(plant)].elements[element.number];
    outlines_.push_back(outlineAbout(here, there, (*site_.kinds)[static_cast<std::size_t>(there.shape)]));
    neighbours_.push_back(&there);
  }
  site_.ground->obstaclesAbout(here, reach_vx, low_vx, high_vx, outlines_);
}

std::optional<Outcome> LaidRoom::hinders(const Scaled& element, const LaidWay& way, bool seed) const {
  const Outline own = moved(element.outline(), way.turn, way.by);
  const double slack = slackOf(element), gap = diffusion_.gap_min.number;
  const bool neighbour_wanted = !seed && diffusion_.gap_max.number < kNoLimit;
  double nearest = kNoLimit;
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    // Without a gap what is exact decides alone: shingles lie over each other.
    if (gap == 0.0 && !neighbour_wanted) break;
    const double away = distance(own, outlines_[i]);
    nearest = std::min(nearest, away);
    if (away < gap - slack) return Outcome::blocked;
  }
  for (std::size_t i = neighbours_.size(); i < outlines_.size(); ++i) {
    if (element.kind.flat && gap > 0.0 ? distance(own, outlines_[i]) < gap - slack
                                       : blocks(own, outlines_[i]))
      return Outcome::blocked;
  }
  if (neighbour_wanted && nearest > diffusion_.gap_max.number + slack) return Outcome::too_far;
  return std::nullopt;
}

std::optional<Stance> LaidRoom::settle(const Scaled& element, const LaidWay& way, bool up) const {
  const sim::Vec3 wanted_vx = site_.stance.placed(way.by);
  // Surfaces that bend are met above or below; a wide search takes long.
  constexpr double kMostBend_vx = 24.0;
  const double within = std::min(0.5 * glm::length(way.by), kMostBend_vx) + diffusion_.off.number + 0.5;
  auto stance = site_.ground->goingOn(site_.stance, wanted_vx, within);
  if (!stance) return std::nullopt;
  // The ground goes on as far as any set of the plant lets it.
  const double cos_bend = sim::unitCircle(diffusion_.bend_deg / 360.0).x;
  if (glm::dot(stance->normal, site_.stance.normal) < cos_bend - 1e-6) return std::nullopt;
  const bool same_plane = stance->at_vx == wanted_vx;
  if (up) *stance = facing(*stance, {0, 1, 0});
  *stance = turned(*stance, way.turn);
  const sim::Voxel above = sim::voxelAt(openPlace(stance->at_vx, stance->normal));
  if (!sim::contains(view_.world.frame().size, above) || isScene(view_.world, above)) return std::nullopt;
  if (!element.kind.flat) return stance;
  if (!same_plane) *stance = evened(element, *stance);
  for (const glm::dvec2 corner : element.outline()) {
    if (!site_.ground->offFrom(*stance, stance->placed(corner), diffusion_.off.number)) return std::nullopt;
  }
  return stance;
}

/// Tilted as the surface is beneath all of it, if it bends.
Stance LaidRoom::evened(const Scaled& element, const Stance& stance) const {
  sim::Vec3 normal = stance.normal;
  for (const glm::dvec2 corner : element.outline()) {
    const auto there = site_.ground->goingOn(stance, stance.placed(corner),
                                             0.5 * glm::length(corner) + diffusion_.off.number);
    if (there) normal += there->normal;
  }
  Stance even = stance;
  even.normal = glm::normalize(normal);
  return facing(even, stance.y);
}

bool LaidRoom::keepsApart(const Scaled& element, const Stance& stance, bool as_wanted) const {
  constexpr double kOnBends = 0.8;
  const double gap = kOnBends * diffusion_.gap_min.number;
  const Outline own = element.outline();
  for (const sim::PlacedElement* const there : neighbours_) {
    const double away = glm::distance(there->position_vx, stance.at_vx);
    if (away < kOnePlace_vx) return false;
    if (as_wanted || gap == 0.0) continue;
    const LaidKind& other = (*site_.kinds)[static_cast<std::size_t>(there->shape)];
    const bool feet = !element.kind.flat && !other.flat;
    if ((feet ? away : distance(own, outlineAbout(stance, *there, other))) < gap - slackOf(element))
      return false;
  }
  return true;
}

bool LaidRoom::fits(sim::ProposedElement& laid, const Stance& stance) const {
  thread_local sim::Facets facets;
  thread_local sim::Nearby nearby;
  const Element& rule = *(*site_.kinds)[static_cast<std::size_t>(laid.element.shape)].rule;
  const auto part = view_.plant.element_parts[static_cast<std::size_t>(laid.element.shape)];
  if (!sim::place(laid.element, view_.pieces.shapeOf(part), facets) ||
      !sim::inside(view_.world.frame().size, facets))
    return false;
  if (!rule.crosses) {
    view_.pieces.gather(facets.box, 0, -1, nearby);
    if (nearby.clash(facets, {sim::latticePoint(laid.element.position_vx)})) return false;
  }
  if (site_.ground->clash(stance, facets)) return false;
  takeVoxels(laid, facets);
  return true;
}

void LaidRoom::takeVoxels(sim::ProposedElement& laid, const sim::Facets& facets) const {
  const sim::FacetShape& shape = *facets.shape;
  sim::tileTriangles(facets.corners, shape.triangles, laid.takes);
  const auto all = static_cast<double>(std::max<std::size_t>(1, laid.takes.size()));
  std::erase_if(laid.takes, [&](sim::Voxel v) { return isScene(view_.world, v); });
  const Element& rule = *(*site_.kinds)[static_cast<std::size_t>(laid.element.shape)].rule;
  double area = 0.0;
  for (const sim::CornerNumbers& t : shape.triangles) {
    area += 0.5 * glm::length(glm::cross(shape.corners[t[1]] - shape.corners[t[0]],
                                         shape.corners[t[2]] - shape.corners[t[0]]));
  }
  const double share = rule.opacity * area * laid.element.scale * laid.element.scale / all;
  laid.coverage = static_cast<float>(std::min(1.0, share));
  if (rule.crosses) laid.passage = sim::Passage::through;
}

}  // namespace espalier::rules
