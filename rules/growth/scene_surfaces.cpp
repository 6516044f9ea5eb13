#include "rules/growth/scene_surfaces.h"

#include <algorithm>

#include "rules/growth/nearest_among.h"
#include "sim/sense/scene_surface.h"

namespace espalier::rules {
namespace {

constexpr std::array kCorner{"a", "b", "c"};

/// Whether a ball meets the box of a triangle.
bool comesNear(const TriangleCorners& corners, sim::Vec3 about_vx, double reach_vx) {
  const sim::Vec3 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
  const sim::Vec3 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
  return glm::distance(glm::clamp(about_vx, low, high), about_vx) < reach_vx;
}

}  // namespace

sim::Columns columnsOf(std::span<const TriangleCorners> triangles_vx) {
  sim::Columns columns;
  for (std::size_t i = 0; i < kCorner.size(); ++i) {
    auto& corner = sim::column<sim::Vec3>(columns, kCorner[i]);
    for (const TriangleCorners& triangle : triangles_vx) corner.push_back(triangle[i]);
  }
  return columns;
}

SurfacesNear::SurfacesNear(const sim::Commons& commons, sim::Vec3 about_vx, double reach_vx) {
  const auto known = commons.find(kSceneSurfaces);
  if (known == commons.end()) return;
  const auto& a = sim::column<sim::Vec3>(known->second, kCorner[0]);
  const auto& b = sim::column<sim::Vec3>(known->second, kCorner[1]);
  const auto& c = sim::column<sim::Vec3>(known->second, kCorner[2]);
  for (std::size_t i = 0; i < std::min({a.size(), b.size(), c.size()}); ++i) {
    const TriangleCorners corners{a[i], b[i], c[i]};
    if (comesNear(corners, about_vx, reach_vx)) triangles_.push_back(corners);
  }
}

std::optional<sim::Vec3> SurfacesNear::nearest(sim::Vec3 at_vx, double within_vx) const {
  return nearestAmong(triangles_, at_vx, within_vx, [](const TriangleCorners& corners, sim::Vec3 at) {
    return sim::nearestOn(corners, at);
  });
}

}  // namespace espalier::rules
