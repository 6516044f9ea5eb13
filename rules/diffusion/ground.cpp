#include "rules/diffusion/ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "sim/base/random.h"
#include "sim/tile/clip.h"

namespace espalier::rules {
namespace {

using Triangle = sim::SceneSurface::Triangle;

constexpr double kFlat = 1e-6;  // how far unit normals of one plane may differ
constexpr double kInPlane_vx = 1e-4;
constexpr double kLattice_vx = 16'000.0;  // as far as the lattice goes; no world is wider
constexpr double kNearWorld_vx = 8.0;

sim::Vec3 placeOf(sim::LatticePoint p) {
  return sim::Vec3(p) / static_cast<double>(sim::kFixedOne);
}

bool onLattice(sim::Vec3 p_vx) {
  return glm::all(glm::lessThan(glm::abs(p_vx), sim::Vec3(kLattice_vx)));
}

/// A place in (x, y, height) about a stance.
sim::Vec3 aboutStance(const Stance& stance, sim::Vec3 p_vx) {
  const glm::dvec2 flat = stance.seen(p_vx);
  return {flat.x, flat.y, glm::dot(p_vx - stance.at_vx, stance.normal)};
}

/// Leaves of a line what lies in a box; false where nothing does.
bool cutLineToBox(sim::Vec3& from, sim::Vec3& to, sim::Vec3 low, sim::Vec3 high) {
  double begins = 0.0, ends = 1.0;
  const sim::Vec3 way = to - from;
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0.0 && (from[axis] < low[axis] || from[axis] > high[axis])) return false;
    if (way[axis] == 0.0) continue;
    const double a = (low[axis] - from[axis]) / way[axis], b = (high[axis] - from[axis]) / way[axis];
    begins = std::max(begins, std::min(a, b));
    ends = std::min(ends, std::max(a, b));
  }
  if (!(begins < ends)) return false;
  to = from + ends * way;
  from += begins * way;
  return true;
}

}  // namespace

sim::LatticeBox boxAbout(const Stance& stance, double reach_vx, double high_vx) {
  const sim::Vec3 n = stance.normal;
  const sim::Vec3 reach =
      reach_vx * glm::sqrt(glm::max(sim::Vec3(0.0), 1.0 - n * n)) + high_vx * glm::abs(n) + 1e-3;
  const sim::Vec3 most(kLattice_vx);
  return {sim::latticePoint(glm::clamp(stance.at_vx - reach, -most, most)),
          sim::latticePoint(glm::clamp(stance.at_vx + reach, -most, most))};
}

sim::Vec3 openPlace(sim::Vec3 at_vx, sim::Vec3 normal) {
  // A plane passes voxels whose centres are up to half of this away from it, and a voxel holds places as far
  // from its centre again.
  const sim::Vec3 size = glm::abs(normal);
  return at_vx + (size.x + size.y + size.z + 0.02) * normal;
}

Stance facing(Stance stance, sim::Vec3 way) {
  const sim::Vec3 flat = way - glm::dot(way, stance.normal) * stance.normal;
  if (glm::length(flat) > 1e-6) {
    stance.y = glm::normalize(flat);
    stance.x = glm::cross(stance.y, stance.normal);
  }
  return stance;
}

Stance turned(const Stance& stance, glm::dvec2 turn) {
  return facing(stance, turn.x * stance.y - turn.y * stance.x);
}

Ground::Ground(std::shared_ptr<const sim::SceneSurface> surface,
               const std::function<bool(const std::string& region)>& bears, double bend_deg, sim::Voxel size)
    : surface_(std::move(surface)),
      cos_bend_(sim::unitCircle(bend_deg / 360.0).x),
      world_size_(size),
      borders_(size) {
  for (const std::string& region : surface_->regions()) bears_.push_back(bears(region));
  findBorders();
}

/// A surface may be wound either way.
bool Ground::goesOn(const Triangle& triangle, const Stance& from) const {
  return bears_[triangle.region] && std::abs(glm::dot(triangle.normal, from.normal)) >= cos_bend_ - kFlat;
}

/// Edges of what bears beyond which it does not go on.
void Ground::findBorders() {
  struct Edge {
    std::array<double, 6> ends;  // the lower one first: the same from both sides
    std::uint32_t triangle = 0, number = 0;
  };
  const auto& triangles = surface_->triangles();
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (!bears_[triangles[t].region]) continue;
    for (std::uint32_t i = 0; i < 3; ++i) {
      sim::Vec3 p = triangles[t].corners_vx[i], q = triangles[t].corners_vx[(i + 1) % 3];
      if (std::tie(q.x, q.y, q.z) < std::tie(p.x, p.y, p.z)) std::swap(p, q);
      edges.push_back({{p.x, p.y, p.z, q.x, q.y, q.z}, t, i});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.ends, a.triangle, a.number) < std::tie(b.ends, b.triangle, b.number);
  });
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::find_if(first, edges.end(), [&](const Edge& e) { return e.ends != first->ends; });
    for (auto side = first; side != last; ++side) {
      const sim::Vec3 normal = triangles[side->triangle].normal;
      const bool joined = std::any_of(first, last, [&](const Edge& other) {
        return other.triangle != side->triangle &&
               std::abs(glm::dot(triangles[other.triangle].normal, normal)) >= cos_bend_ - kFlat;
      });
      if (!joined) addBorder(side->triangle, side->number);
    }
    first = last;
  }
}

/// Where another triangle's edges meet this one elsewhere than at its ends, parts of it may be no border.
void Ground::addBorder(std::uint32_t number, std::size_t edge) {
  const Triangle& triangle = surface_->triangles()[number];
  // As far as it comes near to the world.
  const sim::Vec3 margin(kNearWorld_vx);
  sim::Vec3 from = triangle.corners_vx[edge], to = triangle.corners_vx[(edge + 1) % 3];
  if (!cutLineToBox(from, to, -margin, sim::Vec3(world_size_) + margin)) return;
  const double length = glm::distance(from, to);
  constexpr double kPart_vx = 1.0;
  constexpr double kBeside_vx = 0.05;
  constexpr double kMostParts = 10'000.0;
  const auto parts = static_cast<int>(std::clamp(std::ceil(length / kPart_vx), 1.0, kMostParts));
  const sim::Vec3 out = kBeside_vx * glm::normalize(glm::cross(to - from, triangle.normal));
  Stance here;
  here.normal = triangle.normal;
  sim::Vec3 begins(0.0);
  bool begun = false;
  for (int i = 0; i <= parts; ++i) {
    const sim::Vec3 at = glm::mix(from, to, i / static_cast<double>(parts));
    const sim::Vec3 middle = glm::mix(from, to, std::min(1.0, (i + 0.5) / parts));
    const bool ends = i == parts || offFrom(here, middle + out, 0.5 * kBeside_vx);
    if (!ends && !begun) begins = at;
    begun = begun || !ends;
    if (!ends || !begun) continue;
    borders_.add(
        sim::Limb{sim::latticePoint(begins), sim::latticePoint(at), 1, static_cast<std::int32_t>(number)});
    begun = false;
  }
}

std::optional<Stance> Ground::nearest(sim::Vec3 from_vx, double within_vx) const {
  const auto place =
      surface_->nearest(from_vx, within_vx, [&](const Triangle& t) { return bears_[t.region]; });
  if (!place) return std::nullopt;
  Stance stance;
  stance.at_vx = place->at_vx;
  stance.normal = surface_->triangles()[place->triangle].normal;
  const double side = glm::dot(from_vx - place->at_vx, stance.normal);
  if (side < 0.0) stance.normal = -stance.normal;
  stance.x = sim::perpendicular(stance.normal);
  stance.y = glm::cross(stance.normal, stance.x);
  stance = facing(stance, {0, 0, -1});
  // The steepest way, where there is a slope to speak of.
  constexpr double kSlope = 0.02;
  const sim::Vec3 up = sim::Vec3(0, 1, 0) - stance.normal.y * stance.normal;
  return glm::length(up) > kSlope ? facing(stance, up) : stance;
}

std::optional<Stance> Ground::goingOn(const Stance& from, sim::Vec3 at_vx, double within_vx) const {
  const auto place = surface_->nearest(at_vx, within_vx, [&](const Triangle& t) { return goesOn(t, from); });
  if (!place) return std::nullopt;
  // Beyond an edge the nearest place lies aside, not below.
  constexpr double kBelow = 0.17;
  const sim::Vec3 aside = at_vx - place->at_vx;
  const double below = std::abs(glm::dot(aside, surface_->triangles()[place->triangle].normal));
  if (glm::length(aside) > kInPlane_vx && below < kBelow * glm::length(aside)) return std::nullopt;
  const auto towards = [&](sim::Vec3 normal) {
    return glm::dot(normal, from.normal) < 0.0 ? -normal : normal;
  };
  Stance stance = from;
  stance.at_vx = place->at_vx;
  const sim::Vec3 normal = towards(surface_->triangles()[place->triangle].normal);
  if (glm::length(normal - from.normal) < kFlat &&
      std::abs(glm::dot(place->at_vx - from.at_vx, from.normal)) < kInPlane_vx &&
      glm::distance(place->at_vx, at_vx) < kInPlane_vx) {
    stance.at_vx = at_vx;  // the same plane, to the last bit
    return stance;
  }
  stance.normal = normal;
  return facing(stance, from.y);
}

std::optional<double> Ground::offFrom(const Stance& from, sim::Vec3 at_vx, double within_vx) const {
  const auto place = surface_->nearest(at_vx, within_vx, [&](const Triangle& t) { return goesOn(t, from); });
  if (!place) return std::nullopt;
  return glm::distance(place->at_vx, at_vx);
}

const std::string* Ground::regionAt(sim::Vec3 at_vx, double within_vx) const {
  const auto place = surface_->nearest(at_vx, within_vx, [&](const Triangle& t) { return bears_[t.region]; });
  return place ? &surface_->regions()[surface_->triangles()[place->triangle].region] : nullptr;
}

void Ground::obstaclesAbout(const Stance& stance, double reach_vx, double low_vx, double high_vx,
                            std::vector<Outline>& outlines) const {
  const sim::LatticeBox box = boxAbout(stance, reach_vx, std::max(high_vx, -low_vx));
  thread_local std::vector<std::uint32_t> found;
  surface_->trianglesIn(box, found);
  for (const std::uint32_t number : found) {
    const Triangle& triangle = surface_->triangles()[number];
    if (goesOn(triangle, stance)) continue;
    // Sides of what bears hinder where they rise; where they go down the surface ends, or goes on.
    constexpr double kRises_vx = 0.02;
    const double low = bears_[triangle.region] ? std::max(low_vx, kRises_vx) : low_vx;
    const auto& c = triangle.corners_vx;
    const sim::CutPolygon polygon =
        sim::cutToBox({aboutStance(stance, c[0]), aboutStance(stance, c[1]), aboutStance(stance, c[2])},
                      {-reach_vx, -reach_vx, low}, {reach_vx, reach_vx, high_vx});
    if (polygon.count == 0) continue;
    std::vector<glm::dvec2> points;
    for (std::size_t i = 0; i < polygon.count; ++i) points.emplace_back(polygon.corner[i]);
    outlines.push_back(hullOf(std::move(points)));
  }
  thread_local sim::Nearby nearby;
  borders_.gather(box, 0, -1, nearby);
  for (const sim::Limb& border : nearby.limbs()) {
    // That of a side ends nothing that lies on top.
    if (!goesOn(surface_->triangles()[static_cast<std::size_t>(border.node)], stance)) continue;
    const sim::Vec3 from = aboutStance(stance, placeOf(border.from)),
                    to = aboutStance(stance, placeOf(border.to));
    if (std::max(from.z, to.z) < low_vx || std::min(from.z, to.z) > high_vx) continue;
    outlines.push_back({glm::dvec2(from), glm::dvec2(to)});
  }
}

bool Ground::clash(const Stance& stance, const sim::Facets& facets) const {
  thread_local std::vector<std::uint32_t> found;
  surface_->trianglesIn(facets.box, found);
  const auto crosses = [&](const std::array<sim::Vec3, 3>& c) {
    const sim::LatticeTriangle wall{sim::latticePoint(c[0]), sim::latticePoint(c[1]),
                                    sim::latticePoint(c[2])};
    return std::any_of(facets.shape->triangles.begin(), facets.shape->triangles.end(), [&](const auto& t) {
      return sim::cross(wall, {facets.corners[t[0]], facets.corners[t[1]], facets.corners[t[2]]});
    });
  };
  return std::any_of(found.begin(), found.end(), [&](std::uint32_t number) {
    const Triangle& triangle = surface_->triangles()[number];
    if (goesOn(triangle, stance)) return false;
    const auto& corners = triangle.corners_vx;
    if (std::all_of(corners.begin(), corners.end(), onLattice)) return crosses(corners);
    // Of one that reaches beyond the lattice the part about the element.
    const sim::CutPolygon part =
        sim::cutToBox(corners, placeOf(facets.box.low) - 1.0, placeOf(facets.box.high) + 1.0);
    for (std::size_t i = 2; i < part.count; ++i) {
      if (crosses({part.corner[0], part.corner[i - 1], part.corner[i]})) return true;
    }
    return false;
  });
}

}  // namespace espalier::rules
