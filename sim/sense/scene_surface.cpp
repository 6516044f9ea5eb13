#include "sim/sense/scene_surface.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/base/error.h"

namespace espalier::sim {
namespace {

constexpr int kCell = 4;  // voxels
constexpr int kFewCells = 8;

/// Of a place in voxel space, cells beyond the world too.
Voxel cellOf(Vec3 at_vx) {
  return Voxel(glm::floor((at_vx + 0.5) / static_cast<double>(kCell)));
}

Vec3 nearestOnLine(Vec3 from, Vec3 to, Vec3 at) {
  const Vec3 way = to - from;
  const double length2 = glm::dot(way, way);
  return length2 > 0.0 ? from + std::clamp(glm::dot(at - from, way) / length2, 0.0, 1.0) * way : from;
}

Vec3 twiceArea(const std::array<Vec3, 3>& c) {
  return glm::cross(c[1] - c[0], c[2] - c[0]);
}

}  // namespace

Vec3 nearestOn(const std::array<Vec3, 3>& corners, Vec3 at) {
  const Vec3 normal = twiceArea(corners);
  bool inside = glm::dot(normal, normal) > 0.0;
  for (std::size_t i = 0; inside && i < 3; ++i) {
    const Vec3 from = corners[i], to = corners[(i + 1) % 3];
    inside = glm::dot(glm::cross(normal, to - from), at - from) >= 0.0;
  }
  if (inside) return at - glm::dot(at - corners[0], normal) / glm::dot(normal, normal) * normal;
  Vec3 best = nearestOnLine(corners[0], corners[1], at);
  for (const std::size_t i : {1u, 2u}) {
    const Vec3 other = nearestOnLine(corners[i], corners[(i + 1) % 3], at);
    if (glm::distance(other, at) < glm::distance(best, at)) best = other;
  }
  return best;
}

SceneSurface::SceneSurface(Voxel size, const std::vector<SurfaceTriangle>& triangles,
                           std::vector<std::string> regions)
    : cells_((size + (kCell - 1)) / kCell), regions_(std::move(regions)) {
  for (const SurfaceTriangle& triangle : triangles) {
    if (triangle.region >= regions_.size()) throw BrokenContract("a triangle of a surface has no region");
    const Vec3 normal = twiceArea(triangle.corners_vx);
    const double length = glm::length(normal);
    if (!(length > 0.0)) continue;
    triangles_.push_back({triangle.corners_vx, normal / length, triangle.region});
    const std::size_t before = listed_.size();
    list(static_cast<std::uint32_t>(triangles_.size() - 1), triangle.corners_vx);
    if (listed_.size() == before) {
      triangles_.pop_back();
      continue;
    }
    Ball ball{(triangle.corners_vx[0] + triangle.corners_vx[1] + triangle.corners_vx[2]) / 3.0};
    for (const Vec3 corner : triangle.corners_vx)
      ball.radius_vx = std::max(ball.radius_vx, glm::distance(corner, ball.middle_vx));
    ball.radius_vx *= 1.0 + 1e-9;
    balls_.push_back(ball);
  }
  std::sort(listed_.begin(), listed_.end());
  listed_.erase(std::unique(listed_.begin(), listed_.end()), listed_.end());
  for (std::uint32_t i = 0; i < listed_.size(); ++i) {
    auto& [from, to] = in_cell_.try_emplace(listed_[i].first, i, i).first->second;
    to = i + 1;
  }
}

std::shared_ptr<const SceneSurface> surfaceOf(const Frame& frame, const std::vector<TiledMesh>& meshes) {
  std::vector<SurfaceTriangle> triangles;
  std::vector<std::string> regions;
  std::map<std::string, std::uint32_t> numbers;
  for (const TiledMesh& tiled : meshes) {
    if (tiled.guide || !tiled.lines.empty()) continue;
    const Mesh& mesh = tiled.mesh;
    std::vector<Vec3> vertices_vx;
    for (const Vec3 vertex_m : mesh.vertices_m) vertices_vx.push_back(voxelFromWorld(frame, vertex_m));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const std::string& region = mesh.regions.at(mesh.region[t]);
      const auto [number, is_new] = numbers.try_emplace(region, static_cast<std::uint32_t>(regions.size()));
      if (is_new) regions.push_back(region);
      const auto& [a, b, c] = mesh.triangles[t];
      triangles.push_back({{vertices_vx[a], vertices_vx[b], vertices_vx[c]}, number->second});
    }
  }
  return std::make_shared<const SceneSurface>(frame.size, triangles, std::move(regions));
}

std::uint64_t SceneSurface::keyOf(Voxel cell) const {
  return (static_cast<std::uint64_t>(cell.y) * static_cast<std::uint64_t>(cells_.z) +
          static_cast<std::uint64_t>(cell.z)) *
             static_cast<std::uint64_t>(cells_.x) +
         static_cast<std::uint64_t>(cell.x);
}

/// In all cells of the world that a part of a triangle may touch, which is cut until those are few.
void SceneSurface::list(std::uint32_t number, const std::array<Vec3, 3>& part) {
  const Vec3 reach = Vec3(cells_ * kCell) + 1.0;  // whole numbers hold what lies no farther away
  Vec3 lowest = glm::min(glm::min(part[0], part[1]), part[2]);
  Vec3 highest = glm::max(glm::max(part[0], part[1]), part[2]);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(highest[axis] >= -1.0 && lowest[axis] <= reach[axis])) return;
  }
  const Voxel low = glm::clamp(cellOf(glm::clamp(lowest, Vec3(-1.0), reach)), Voxel(0), cells_ - 1);
  const Voxel high = glm::clamp(cellOf(glm::clamp(highest, Vec3(-1.0), reach)), Voxel(0), cells_ - 1);
  const Voxel span = high - low + 1;
  if (std::int64_t{span.x} * span.y * span.z <= kFewCells) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int z = low.z; z <= high.z; ++z) {
        for (int x = low.x; x <= high.x; ++x) listed_.emplace_back(keyOf({x, y, z}), number);
      }
    }
    return;
  }
  const Vec3 ab = 0.5 * (part[0] + part[1]), bc = 0.5 * (part[1] + part[2]), ca = 0.5 * (part[2] + part[0]);
  list(number, {part[0], ab, ca});
  list(number, {ab, part[1], bc});
  list(number, {ca, bc, part[2]});
  list(number, {ab, bc, ca});
}

std::optional<SceneSurface::Place> SceneSurface::nearest(Vec3 at_vx, double within_vx,
                                                         const Wanted& wanted) const {
  // Mostly it is near, and of a fine mesh a wide search meets thousands.
  constexpr double kFirst_vx = 1.0, kWider = 2.5;
  for (double reach_vx = std::min(kFirst_vx, within_vx);; reach_vx = std::min(kWider * reach_vx, within_vx)) {
    const auto place = nearestOf(at_vx, reach_vx, wanted);
    if (place || !(reach_vx < within_vx)) return place;
  }
}

std::optional<SceneSurface::Place> SceneSurface::nearestOf(Vec3 at_vx, double within_vx,
                                                           const Wanted& wanted) const {
  const Voxel low = glm::clamp(cellOf(at_vx - within_vx), Voxel(0), cells_ - 1);
  const Voxel high = glm::clamp(cellOf(at_vx + within_vx), Voxel(0), cells_ - 1);
  std::optional<Place> best;
  double far = within_vx;
  for (int y = low.y; y <= high.y; ++y) {
    for (int z = low.z; z <= high.z; ++z) {
      for (int x = low.x; x <= high.x; ++x) {
        const auto cell = in_cell_.find(keyOf({x, y, z}));
        if (cell == in_cell_.end()) continue;
        for (std::uint32_t i = cell->second.first; i < cell->second.second; ++i) {
          const std::uint32_t number = listed_[i].second;
          const Ball& ball = balls_[number];
          if (glm::distance(ball.middle_vx, at_vx) - ball.radius_vx > far) continue;
          const Triangle& triangle = triangles_[number];
          if (!wanted(triangle)) continue;
          const Vec3 there = nearestOn(triangle.corners_vx, at_vx);
          const double away = glm::distance(there, at_vx);
          if (!(away < far || (best && away == far && number < best->triangle))) continue;
          far = away;
          best = Place{there, number};
        }
      }
    }
  }
  return best;
}

void SceneSurface::trianglesIn(const LatticeBox& box, std::vector<std::uint32_t>& found) const {
  const auto place = [](LatticePoint p) { return Vec3(p) / static_cast<double>(kFixedOne); };
  const Vec3 lowest = place(box.low), highest = place(box.high);
  const Voxel low = glm::clamp(cellOf(lowest), Voxel(0), cells_ - 1);
  const Voxel high = glm::clamp(cellOf(highest), Voxel(0), cells_ - 1);
  found.clear();
  for (int y = low.y; y <= high.y; ++y) {
    for (int z = low.z; z <= high.z; ++z) {
      for (int x = low.x; x <= high.x; ++x) {
        const auto cell = in_cell_.find(keyOf({x, y, z}));
        if (cell == in_cell_.end()) continue;
        for (std::uint32_t i = cell->second.first; i < cell->second.second; ++i)
          found.push_back(listed_[i].second);
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::erase_if(found, [&](std::uint32_t number) {
    const auto& c = triangles_[number].corners_vx;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::min({c[0][axis], c[1][axis], c[2][axis]}) > highest[axis] ||
          std::max({c[0][axis], c[1][axis], c[2][axis]}) < lowest[axis])
        return true;
    }
    return false;
  });
}

}  // namespace espalier::sim
