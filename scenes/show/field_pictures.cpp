#include "scenes/show/field_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/image/arrow_drawing.h"
#include "render/image/graph_drawing.h"
#include "render/image/legend.h"
#include "rules/front/lengths.h"
#include "sim/base/parallel.h"
#include "sim/base/random.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;

constexpr std::size_t kMostLookedAt = 20'000;         // attractors
constexpr double kAcross = 15.0, kOnSurfaces = 18.0;  // arrows along the longest side
constexpr int kMostLattices = 3;                      // of a field in space
constexpr double kLatticesApart = 5.0;                // in arrows

/// Some of the attractors at which the field says something.
std::vector<Vec3> activeOf(const ShownField& field) {
  const std::vector<Vec3> all = field.attractors_vx();
  const std::size_t step = all.size() / kMostLookedAt + 1;
  std::vector<Vec3> active;
  for (std::size_t i = 0; i < all.size(); i += step) {
    if (field.at(all[i]) != Vec3(0.0)) active.push_back(all[i]);
  }
  return active;
}

struct Bounds {
  Vec3 low{INFINITY}, high{-INFINITY};
};

Bounds boundsOf(const std::vector<Vec3>& points) {
  Bounds bounds;
  for (const Vec3& p : points) {
    bounds.low = glm::min(bounds.low, p);
    bounds.high = glm::max(bounds.high, p);
  }
  return bounds;
}

/// Those of the points that keep their distance from all before.
std::vector<Vec3> apart(const std::vector<Vec3>& points, double least) {
  std::vector<Vec3> kept;
  for (const Vec3& p : points) {
    if (std::none_of(kept.begin(), kept.end(), [&](const Vec3& k) { return glm::distance(k, p) < least; }))
      kept.push_back(p);
  }
  return kept;
}

/// Lattices across an axis, wide enough for all, where attractors are near.
ArrowPlaces layers(const ShownField& field, const std::vector<Vec3>& active) {
  const rules::Guide& guide = field.guide();
  const Vec3 axis =
      guide.axis == rules::GuideAxis::direction ? glm::normalize(guide.direction) : Vec3(0.0, 1.0, 0.0);
  const Vec3 u = sim::perpendicular(axis), v = glm::cross(axis, u);
  const auto turned = [&](Vec3 p) { return Vec3(glm::dot(p, u), glm::dot(p, axis), glm::dot(p, v)); };
  std::vector<Vec3> in;
  for (const Vec3& p : active) in.push_back(turned(p));
  const auto [low, high] = boundsOf(in);
  const Vec3 extent = high - low, start = turned(field.starts_vx().front());
  ArrowPlaces places;
  places.apart_vx = std::max({extent.x, extent.z, 1.0}) / kAcross;
  const rules::Attractors near = rules::sortedAttractors(active);
  const double reach = std::max(0.7 * places.apart_vx, 1.5 * rules::spacingOf(near));
  const auto first = [&](double from, double least) {
    return from + std::ceil((least - from) / places.apart_vx) * places.apart_vx;
  };
  const int count = std::clamp(static_cast<int>(std::lround(extent.y / (kLatticesApart * places.apart_vx))),
                               1, kMostLattices);
  for (int layer = 0; layer < count; ++layer) {
    const double y = low.y + extent.y * (layer + 0.5) / count;
    for (double z = first(start.z, low.z); z <= high.z; z += places.apart_vx) {
      for (double x = first(start.x, low.x); x <= high.x; x += places.apart_vx) {
        const Vec3 at = x * u + y * axis + z * v;
        if (glm::distance(near.at(rules::nearestOfAll(near, at)), at) <= reach && field.at(at) != Vec3(0.0))
          places.at_vx.push_back(at);
      }
    }
  }
  return places;
}

std::string legendNote(const ShownField& field, double least, double most) {
  const std::string strength =
      most == 0.0           ? "it says nothing at the attractors that its fronts grow to"
      : most - least < 5e-3 ? fmt::format("strength {:.3g}", most)
                            : fmt::format("strength {:.3g} to {:.3g}, by the length of arrows", least, most);
  return fmt::format("{}\nangle {:g} degrees", strength, field.guide().angle_deg);
}

}  // namespace

ArrowPlaces arrowPlaces(const ShownField& field) {
  const std::vector<Vec3> active = activeOf(field);
  if (active.empty()) return {};
  if (!field.onSurfaces()) return layers(field, active);
  const auto [low, high] = boundsOf(active);
  const Vec3 extent = high - low;
  const double spacing = std::max({extent.x, extent.y, extent.z, 1.0}) / kOnSurfaces;
  return {apart(active, spacing), spacing};
}

void drawField(render::Image& picture, const ShownField& field, const std::string& title,
               const sim::Frame& frame, const render::Camera& camera, const Sight* sight) {
  const auto [places, apart_vx] = arrowPlaces(field);
  std::vector<Vec3> vectors;
  double least = INFINITY, most = 0.0;
  for (const Vec3& place : places) {
    vectors.push_back(field.at(place));
    least = std::min(least, glm::length(vectors.back()));
    most = std::max(most, glm::length(vectors.back()));
  }
  render::PointGraph graph;
  for (const Vec3& at : field.attractors_vx()) graph.ended.push_back({sim::worldFromVoxel(frame, at)});
  for (const Vec3& at : field.starts_vx()) graph.nodes.push_back({{sim::worldFromVoxel(frame, at)}});
  std::vector<render::SpaceArrow> arrows(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3 half = 0.45 * apart_vx * vectors[i] / most;
    arrows[i] = {sim::worldFromVoxel(frame, places[i] - half), sim::worldFromVoxel(frame, places[i] + half)};
  }
  const auto hides = [&](Vec3 at_m) { return sight != nullptr && sight->hides(at_m); };
  sim::parallelForEach(graph.ended.size(),
                       [&](std::size_t i) { graph.ended[i].hidden = hides(graph.ended[i].at_m); });
  sim::parallelForEach(arrows.size(), [&, &places = places](std::size_t i) {
    const Vec3 at_m = sim::worldFromVoxel(frame, places[i]);
    // A surface that stands nowhere hides its far side all the same.
    const bool behind = field.onSurfaces() && glm::dot(field.normalAt(places[i]), camera.eye_m - at_m) < 0.0;
    arrows[i].hidden = behind || hides(at_m);
  });
  render::drawPoints(picture, graph, camera, render::sizesFor(graph, camera, picture.width, picture.height));
  render::drawArrows(picture, arrows, camera, 0.05 * apart_vx * frame.voxel_m);

  render::SwatchLegend legend{title, legendNote(field, least, most), {}};
  legend.swatches = {{render::colourOfWay({1, 0, 0}), "along x"},
                     {render::colourOfWay({0, 1, 0}), "along y, up and down"},
                     {render::colourOfWay({0, 0, 1}), "along z"}};
  render::drawLegend(picture, legend);
}

}  // namespace espalier::scenes
