#include "rules/growth/scene_surfaces.h"

#include <algorithm>
#include <numeric>

#include "rules/growth/nearest_among.h"
#include "sim/sense/scene_surface.h"

namespace espalier::rules {
namespace {

constexpr std::array kCorner{"a", "b", "c"};
constexpr const char *kLow = "low",
                     *kHigh = "high";  // of the boxes that hold so many triangles, one after the other
constexpr std::size_t kInABox = 32;

struct Box {
  sim::Vec3 low{INFINITY}, high{-INFINITY};

  void add(const TriangleCorners& corners) {
    for (const sim::Vec3& corner : corners) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  }
};

bool comesNear(const sim::Vec3& low, const sim::Vec3& high, sim::Vec3 about_vx, double reach_vx) {
  return glm::distance(glm::clamp(about_vx, low, high), about_vx) < reach_vx;
}

/// Whether a ball meets the box of a triangle.
bool comesNear(const TriangleCorners& corners, sim::Vec3 about_vx, double reach_vx) {
  Box box;
  box.add(corners);
  return comesNear(box.low, box.high, about_vx, reach_vx);
}

sim::Vec3 middleOf(const TriangleCorners& corners) {
  return (corners[0] + corners[1] + corners[2]) / 3.0;
}

/// Brings triangles that are near each other together: halves of them, and halves of those, as many as boxes
/// hold in each.
void gather(std::span<TriangleCorners> triangles) {
  if (triangles.size() <= kInABox) return;
  Box middles;
  for (const TriangleCorners& triangle : triangles) {
    const sim::Vec3 middle = middleOf(triangle);
    middles.add({middle, middle, middle});
  }
  const sim::Vec3 extent = middles.high - middles.low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  std::stable_sort(triangles.begin(), triangles.end(),
                   [axis](const TriangleCorners& a, const TriangleCorners& b) {
                     return middleOf(a)[axis] < middleOf(b)[axis];
                   });
  const std::size_t half = (triangles.size() / 2 + kInABox - 1) / kInABox * kInABox;
  gather(triangles.first(half));
  gather(triangles.subspan(half));
}

}  // namespace

sim::Columns columnsOf(std::span<const TriangleCorners> triangles_vx) {
  std::vector<TriangleCorners> gathered(triangles_vx.begin(), triangles_vx.end());
  gather(gathered);
  sim::Columns columns;
  for (std::size_t i = 0; i < kCorner.size(); ++i) {
    auto& corner = sim::column<sim::Vec3>(columns, kCorner[i]);
    for (const TriangleCorners& triangle : gathered) corner.push_back(triangle[i]);
  }
  auto& low = sim::column<sim::Vec3>(columns, kLow);
  auto& high = sim::column<sim::Vec3>(columns, kHigh);
  for (std::size_t first = 0; first < gathered.size(); first += kInABox) {
    Box box;
    for (std::size_t i = first; i < std::min(first + kInABox, gathered.size()); ++i) box.add(gathered[i]);
    low.push_back(box.low);
    high.push_back(box.high);
  }
  return columns;
}

SurfacesNear::SurfacesNear(const sim::Commons& commons, sim::Vec3 about_vx, double reach_vx) {
  const auto known = commons.find(kSceneSurfaces);
  if (known == commons.end()) return;
  const auto& a = sim::column<sim::Vec3>(known->second, kCorner[0]);
  const auto& b = sim::column<sim::Vec3>(known->second, kCorner[1]);
  const auto& c = sim::column<sim::Vec3>(known->second, kCorner[2]);
  const auto& low = sim::column<sim::Vec3>(known->second, kLow);
  const auto& high = sim::column<sim::Vec3>(known->second, kHigh);
  const std::size_t count = std::min({a.size(), b.size(), c.size()});
  for (std::size_t box = 0; box < std::min(low.size(), high.size()); ++box) {
    if (!comesNear(low[box], high[box], about_vx, reach_vx)) continue;
    for (std::size_t i = box * kInABox; i < std::min((box + 1) * kInABox, count); ++i) {
      const TriangleCorners corners{a[i], b[i], c[i]};
      if (comesNear(corners, about_vx, reach_vx)) triangles_.push_back(corners);
    }
  }
}

std::optional<sim::Vec3> SurfacesNear::nearest(sim::Vec3 at_vx, double within_vx) const {
  return nearestAmong(triangles_, at_vx, within_vx, [](const TriangleCorners& corners, sim::Vec3 at) {
    return sim::nearestOn(corners, at);
  });
}

}  // namespace espalier::rules
