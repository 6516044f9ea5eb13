#include "render/voxels/narrow_band.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/image/drawing.h"
#include "render/image/legend.h"
#include "render/voxels/pale_scene.h"
#include "render/voxels/section.h"
#include "sim/base/parallel.h"
#include "sim/tile/inside.h"

namespace espalier::render {
namespace {

constexpr sim::Colour kOutsideNear(0.16f, 0.42f, 0.62f), kOutsideFar(0.84f, 0.91f, 0.95f);
constexpr sim::Colour kInsideNear(0.80f, 0.42f, 0.16f), kInsideFar(0.98f, 0.90f, 0.78f);
constexpr Ink kOutline{sim::Colour(0.11f, 0.12f, 0.14f), 1.0f};

sim::Colour tintOf(float distance_vx) {
  const float far = std::clamp(std::abs(distance_vx) / static_cast<float>(kBand), 0.0f, 1.0f);
  return distance_vx < 0.0f ? glm::mix(kInsideNear, kInsideFar, far)
                            : glm::mix(kOutsideNear, kOutsideFar, far);
}

/// Where triangles cross the plane.
std::vector<std::array<glm::vec2, 2>> outlineOf(const std::vector<sim::Vec3>& corners_vx,
                                                const sim::Mesh& mesh, const CutPlane& plane) {
  std::vector<std::array<glm::vec2, 2>> outline;
  for (const auto& triangle : mesh.triangles) {
    std::array<glm::vec2, 3> ends;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const sim::Vec3 a = corners_vx[triangle[k]], b = corners_vx[triangle[(k + 1) % 3]];
      const double from_a = a[plane.axis] - plane.at, from_b = b[plane.axis] - plane.at;
      if ((from_a < 0.0) == (from_b < 0.0)) continue;
      const sim::Vec3 at = a + from_a / (from_a - from_b) * (b - a);
      ends[count++] = {static_cast<float>(at[plane.across]), static_cast<float>(at[plane.up])};
    }
    if (count == 2) outline.push_back({ends[0], ends[1]});
  }
  return outline;
}

std::vector<sim::Vec3> cornersOf(const sim::Mesh& mesh, const sim::Frame& frame) {
  std::vector<sim::Vec3> corners;
  corners.reserve(mesh.vertices_m.size());
  for (const sim::Vec3& at_m : mesh.vertices_m) corners.push_back(sim::voxelFromWorld(frame, at_m));
  return corners;
}

/// Those that come so near to the plane that its distances may be theirs.
std::vector<openvdb::Vec3I> nearTriangles(const sim::Mesh& mesh, const std::vector<sim::Vec3>& corners_vx,
                                          const CutPlane& plane) {
  std::vector<openvdb::Vec3I> near;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto [low, high] =
        std::minmax({corners_vx[a][plane.axis], corners_vx[b][plane.axis], corners_vx[c][plane.axis]});
    if (high > plane.at - kBand - 1 && low < plane.at + kBand + 1) near.emplace_back(a, b, c);
  }
  return near;
}

}  // namespace

BandCut bandCut(const sim::Mesh& mesh, const sim::Frame& frame, const CutPlane& plane) {
  sim::Frame slice = frame;
  slice.origin_m[plane.axis] += plane.at * frame.voxel_m;
  slice.size[plane.axis] = 1;
  const sim::BitVolume inside = sim::insideOf(mesh, slice);

  openvdb::initialize();
  const std::vector<sim::Vec3> corners = cornersOf(mesh, frame);
  std::vector<openvdb::Vec3s> points;
  points.reserve(corners.size());
  for (const sim::Vec3& at : corners) points.emplace_back(at.x, at.y, at.z);
  const std::vector<openvdb::Vec3I> near = nearTriangles(mesh, corners, plane);
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> triangles(points, near);
  openvdb::FloatGrid::Ptr grid;
  // On one thread: which of two equally near triangles comes first would depend on their number. As a level
  // set, although its signs are not used: unsigned distances are not made even, and are off by up to 0.3
  // voxels.
  sim::onThreads(1, [&] {
    grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
        triangles, *openvdb::math::Transform::createLinearTransform(1.0), static_cast<float>(kBand),
        static_cast<float>(kBand));
  });

  BandCut cut;
  cut.size = {frame.size[plane.across], frame.size[plane.up]};
  cut.outline = outlineOf(corners, mesh, plane);
  cut.has_inside = inside.count() > 0;
  auto voxels = grid->getConstAccessor();
  for (int y = 0; y < cut.size.y; ++y) {
    for (int x = 0; x < cut.size.x; ++x) {
      sim::Voxel v(0);
      v[plane.across] = x;
      v[plane.up] = y;
      const bool within = inside.at(v);
      v[plane.axis] = plane.at;
      float distance = 0.0f;
      const bool in_band = voxels.probeValue({v.x, v.y, v.z}, distance);
      cut.distance_vx.push_back(!in_band ? std::numeric_limits<float>::quiet_NaN()
                                : within ? -std::abs(distance)
                                         : std::abs(distance));
    }
  }
  return cut;
}

double bandBytes(const sim::Mesh& mesh, const sim::Frame& frame, const CutPlane& plane) {
  // Leaves of 8x8x8 voxels that a band six voxels wide touches hold a few times what lies in it; while it is
  // made, each voxel has the number of its nearest triangle too.
  constexpr double kBytes = 4 * 2.0 * 8 * 2 * kBand;
  const std::vector<sim::Vec3> corners = cornersOf(mesh, frame);
  double area = 0.0;
  for (const openvdb::Vec3I& t : nearTriangles(mesh, corners, plane)) {
    const sim::Vec3 a = corners[t[0]], b = corners[t[1]], c = corners[t[2]];
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return kBytes * area;
}

Image drawNarrowBand(const BandCut& cut, const BandLook& look) {
  const auto distanceAt = [&](glm::ivec2 v) {
    return cut.distance_vx[static_cast<std::size_t>(v.y) * static_cast<std::size_t>(cut.size.x) +
                           static_cast<std::size_t>(v.x)];
  };
  Image image = drawCells(cut.size, look.width_px, [&](glm::ivec2 v) -> std::optional<sim::Colour> {
    const float distance = distanceAt(v);
    return std::isnan(distance) ? std::nullopt : std::optional(tintOf(distance));
  });
  const float cell = static_cast<float>(look.width_px) / static_cast<float>(cut.size.x);
  const auto pixel = [&](glm::vec2 v) {
    return glm::vec2((v.x + 0.5f) * cell, static_cast<float>(image.height) - (v.y + 0.5f) * cell);
  };
  const float width = std::clamp(0.14f * cell, 1.0f, 3.0f);
  for (const auto& [a, b] : cut.outline) drawSegment(image, pixel(a), pixel(b), width, kOutline);

  // The band lies anywhere in the picture, so its legend stands below.
  const float line = std::max(9.0f, static_cast<float>(image.width) / 46.0f);
  Image sheet = paper(image.width, image.height + static_cast<int>(13.0f * line));
  paste(sheet, image, 0, 0);
  SwatchLegend legend{look.title, look.note, {{kOutline.colour, "the surface"}}};
  legend.swatches.push_back({tintOf(1.0f), fmt::format("outside, up to {} voxels away", kBand)});
  if (cut.has_inside)
    legend.swatches.push_back({tintOf(-1.0f), fmt::format("inside, up to {} voxels away", kBand)});
  drawLegend(sheet, legend);
  return sheet;
}

}  // namespace espalier::render
