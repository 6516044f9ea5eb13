#include "scenes/show/cube_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "render/image/legend.h"
#include "render/image/tone.h"
#include "render/voxels/cube_drawing.h"
#include "scenes/problem.h"
#include "sim/base/counted.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;

/// Objects that a legend names; of a forest nobody reads the names.
constexpr std::size_t kMostNamed = 6;

bool lower(Vec3 a, Vec3 b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

struct SideOrder {
  bool operator()(const std::pair<Vec3, Vec3>& a, const std::pair<Vec3, Vec3>& b) const {
    return lower(a.first, b.first) || (!lower(b.first, a.first) && lower(a.second, b.second));
  }
};

std::pair<Vec3, Vec3> sideOf(const std::array<Vec3, 3>& corners, std::size_t k) {
  const Vec3 a = corners[k], b = corners[(k + 1) % 3];
  return lower(b, a) ? std::pair(b, a) : std::pair(a, b);
}

/// Sides at which triangles in one plane meet are no borders: a polygon was cut there. Real meshes share no
/// corners, so sides are known by their places.
void markBorders(std::vector<render::CubeTriangle>& triangles) {
  constexpr double kFlat = 1.0 - 1e-6;  // the cosine of what is no bend
  struct Side {
    int count = 0;
    Vec3 normal{0.0};
    bool flat = true;
  };
  std::map<std::pair<Vec3, Vec3>, Side, SideOrder> sides;
  const auto normalOf = [](const std::array<Vec3, 3>& c) {
    const Vec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    const double length = glm::length(normal);
    return length > 0.0 ? normal / length : normal;
  };
  for (const render::CubeTriangle& triangle : triangles) {
    const Vec3 normal = normalOf(triangle.corners_m);
    for (std::size_t k = 0; k < 3; ++k) {
      Side& side = sides[sideOf(triangle.corners_m, k)];
      if (++side.count == 1) side.normal = normal;
      side.flat = side.flat && std::abs(glm::dot(side.normal, normal)) > kFlat;
    }
  }
  for (render::CubeTriangle& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Side& side = sides[sideOf(triangle.corners_m, k)];
      triangle.border[k] = side.count == 1 || !side.flat;
    }
  }
}

void addMesh(const sim::TiledMesh& tiled, render::CubeWorld& shown) {
  const sim::Mesh& mesh = tiled.mesh;
  if (!tiled.lines.empty()) {  // its triangles are what the lines look like
    const sim::Colour colour = mesh.materials.empty() ? sim::Colour(0.3f) : mesh.materials.front().colour;
    for (const sim::Line& line : tiled.lines) shown.lines.push_back({line.from_m, line.to_m, colour});
    return;
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    render::CubeTriangle triangle;
    for (std::size_t k = 0; k < 3; ++k) triangle.corners_m[k] = mesh.vertices_m[mesh.triangles[t][k]];
    triangle.colour = mesh.materials[mesh.material[t]].colour;
    shown.triangles.push_back(triangle);
  }
}

void addGrown(const sim::Plant& plant, const sim::Frame& frame, render::CubeWorld& shown) {
  const sim::Skeleton& skeleton = plant.skeleton;
  for (std::size_t n = 0; n < skeleton.parent.size(); ++n) {
    if (skeleton.parent[n] == sim::kNoNode) continue;
    const Vec3 from = skeleton.position_vx[static_cast<std::size_t>(skeleton.parent[n])];
    shown.lines.push_back({sim::worldFromVoxel(frame, from),
                           sim::worldFromVoxel(frame, skeleton.position_vx[n]), plant.stem_colour});
  }
  for (const sim::PlacedElement& element : plant.elements) {
    const sim::ElementShape& shape = plant.shapes[static_cast<std::size_t>(element.shape)];
    for (const auto& polygon : shape.polygons) {
      for (std::size_t k = 2; k < polygon.size(); ++k) {  // a fan, as where they are tiled
        render::CubeTriangle triangle;
        const std::array corners{polygon[0], polygon[k - 1], polygon[k]};
        for (std::size_t i = 0; i < 3; ++i)
          triangle.corners_m[i] = sim::worldFromVoxel(frame, sim::placed(element, corners[i]));
        triangle.colour = shape.colour;
        shown.triangles.push_back(triangle);
      }
    }
  }
}

/// How many voxels each object occupies, in its own colour.
render::SwatchLegend cubesLegend(const sim::World& world, const std::vector<sim::TiledVoxel>& surfaces,
                                 const ImageSpec& image) {
  const sim::Voxel size = world.frame().size;
  render::SwatchLegend legend;
  legend.title =
      image.caption.empty() ? fmt::format("{} x {} x {} voxels", size.x, size.y, size.z) : image.caption;
  std::vector<std::pair<std::string, std::size_t>> objects;
  std::vector<sim::Colour> sums;
  for (const sim::TiledVoxel& tiled : surfaces) {
    const std::string& name = world.part(tiled.surface.part).object;
    auto at = std::find_if(objects.begin(), objects.end(), [&](const auto& o) { return o.first == name; });
    if (at == objects.end()) {
      at = objects.insert(at, {name, 0});
      sums.emplace_back(0.0f);
    }
    ++at->second;
    sums[static_cast<std::size_t>(at - objects.begin())] += tiled.surface.colour;
  }
  if (objects.size() > kMostNamed) {
    legend.note = sim::counted(surfaces.size(), "voxel") + " of " + sim::counted(objects.size(), "object");
    return legend;
  }
  for (std::size_t i = 0; i < objects.size(); ++i)
    legend.swatches.push_back({render::srgbFromLinear(sums[i] / static_cast<float>(objects[i].second)),
                               objects[i].first + ": " + sim::counted(objects[i].second, "voxel")});
  return legend;
}

}  // namespace

void requireCubesSeen(const Scene& scene, const sim::Frame& frame) {
  const auto image = std::find_if(scene.images.begin(), scene.images.end(),
                                  [](const ImageSpec& one) { return one.kind == ImageKind::voxels; });
  const int longest = std::max({frame.size.x, frame.size.y, frame.size.z});
  if (image == scene.images.end() || longest <= kMostCubes) return;
  throw PlacedError({problemAt(
      scene.images_place, scene.file,
      fmt::format("image {}: {} x {} x {} voxels are too many to be seen one by one; expected at most {} "
                  "along each side, as with a voxel of {:.3g} m",
                  inQuotes(image->name), frame.size.x, frame.size.y, frame.size.z, kMostCubes,
                  frame.voxel_m * longest / (kMostCubes - 1)))});
}

render::Image drawCubes(const Finished& finished, const ImageSpec& image, const render::Camera& camera,
                        glm::ivec2 size_px) {
  render::CubeWorld shown;
  shown.frame = finished.world.frame();
  const std::vector<sim::TiledVoxel> surfaces = finished.world.surfaces();
  for (const sim::TiledVoxel& tiled : surfaces) shown.cubes.push_back({tiled.voxel, tiled.surface.colour});
  for (const sim::TiledMesh& tiled : finished.meshes) {
    if (!tiled.guide) addMesh(tiled, shown);
  }
  for (const sim::Plant& plant : finished.growth.plants) addGrown(plant, shown.frame, shown);
  markBorders(shown.triangles);
  render::Image picture = render::drawCubes(shown, camera, size_px.x, size_px.y);
  render::drawLegend(picture, cubesLegend(finished.world, surfaces, image));
  return picture;
}

}  // namespace espalier::scenes
