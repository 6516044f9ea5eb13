#include "render/model/leaves.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::render {
namespace {

using sim::Vec3;

constexpr double kNoArea = 1e-12;  // squared voxel widths at scale 1

/// Twice the vector area (Newell).
Vec3 areaVector(std::span<const Vec3> corners) {
  Vec3 sum(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += glm::cross(corners[i], corners[(i + 1) % corners.size()]);
  return sum;
}

struct Extent {
  Vec3 low{0.0}, size{1.0};
};

Extent extentOf(const sim::ElementShape& shape) {
  Extent extent;
  bool first = true;
  Vec3 high(0.0);
  for (const auto& polygon : shape.polygons) {
    for (const Vec3 corner : polygon) {
      extent.low = first ? corner : glm::min(extent.low, corner);
      high = first ? corner : glm::max(high, corner);
      first = false;
    }
  }
  if (!first) extent.size = glm::max(high - extent.low, Vec3(1e-9));
  return extent;
}

}  // namespace

Vec3 centreOf(std::span<const Vec3> corners) {
  Vec3 sum(0.0);
  for (const Vec3 corner : corners) sum += corner;
  return sum / static_cast<double>(std::max<std::size_t>(corners.size(), 1));
}

Fan fanOf(std::span<const Vec3> corners) {
  const Vec3 area = areaVector(corners);
  if (corners.size() < 3 || glm::dot(area, area) < kNoArea * kNoArea) return {};
  Fan fan;
  const auto count = static_cast<std::uint32_t>(corners.size());
  for (std::uint32_t i = 1; i + 1 < count; ++i) {
    const double facing = glm::dot(area, glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]));
    fan.with_centre |= facing < 0.0;
    fan.triangles.push_back({0, i, i + 1});
  }
  if (fan.with_centre) {
    fan.triangles.clear();
    for (std::uint32_t i = 0; i < count; ++i) fan.triangles.push_back({count, i, (i + 1) % count});
  }
  return fan;
}

Vec3 bladeBase(const sim::ElementShape& shape) {
  Vec3 base(0.0);
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& polygon : shape.polygons) {
    for (const Vec3 corner : polygon) {
      if (glm::dot(corner, corner) < nearest) {
        nearest = glm::dot(corner, corner);
        base = corner;
      }
    }
  }
  return base;
}

void appendElement(ModelMesh& mesh, const sim::PlacedElement& element, const sim::ElementShape& shape,
                   const sim::Frame& frame, const LeafPlace& place, std::uint32_t piece) {
  const Extent extent = extentOf(shape);
  for (const auto& polygon : shape.polygons) {
    std::vector<Vec3> corners = polygon;
    if (areaVector(corners).z < 0.0)
      std::reverse(corners.begin() + 1, corners.end());  // corner 0 stays the fan's
    const Fan fan = fanOf(corners);
    if (fan.triangles.empty()) continue;
    const Vec3 normal = glm::normalize(areaVector(corners));
    if (fan.with_centre) corners.push_back(centreOf(corners));
    const int across = std::abs(normal.x) > std::abs(normal.z) ? 2 : 0;
    const sim::Colour tint = leafTint(piece, place, element.exposure, shape.varies);
    const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
    for (const Vec3 corner : corners) {
      const Vec3 uv = (corner - extent.low) / extent.size;
      mesh.positions_m.emplace_back(sim::worldFromVoxel(frame, sim::placed(element, corner)));
      mesh.normals.emplace_back(normal.x * element.x + normal.y * element.y + normal.z * element.z);
      mesh.uvs.emplace_back(uv[across], uv.y);
      mesh.tints.push_back(tint);
      mesh.exposures.push_back(element.exposure);
      mesh.youths.push_back(place.youth);
      mesh.pieces.push_back(piece);
    }
    for (const auto& t : fan.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

}  // namespace espalier::render
