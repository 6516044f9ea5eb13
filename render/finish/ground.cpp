#include "render/finish/ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace espalier::render {
namespace {

using sim::Vec3;

constexpr double kGoodPart = 0.3;   // of the scene's plan
constexpr double kThinSlab = 0.05;  // of the plan's diagonal
constexpr sim::Colour kPlain(0.30f, 0.29f, 0.27f);

struct Level {
  double area = 0.0;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  Vec3 area_colour{0.0};
};

}  // namespace

Ground groundOf(const std::vector<const sim::Mesh*>& meshes, double voxel_m) {
  Vec3 low(std::numeric_limits<double>::infinity()), high(-low);
  std::map<std::int64_t, Level> levels;
  for (const sim::Mesh* mesh : meshes) {
    for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
      const auto& corners = mesh->triangles[t];
      const Vec3 a = mesh->vertices_m[corners[0]], b = mesh->vertices_m[corners[1]],
                 c = mesh->vertices_m[corners[2]];
      low = glm::min(low, glm::min(a, glm::min(b, c)));
      high = glm::max(high, glm::max(a, glm::max(b, c)));
      const Vec3 normal = glm::cross(b - a, c - a);
      const double area = 0.5 * glm::length(normal);
      const bool level_enough = std::abs(normal.y) > 1.98 * area;  // within 8 degrees, either way up
      if (!level_enough || area == 0.0) continue;
      const double height = (a.y + b.y + c.y) / 3.0;
      Level& level = levels[static_cast<std::int64_t>(std::floor(height / voxel_m))];
      level.area += area;
      level.lowest = std::min(level.lowest, height);
      level.highest = std::max(level.highest, height);
      // Of what has a picture the colour is a factor alone.
      const sim::Material& material = mesh->materials[mesh->material[t]];
      level.area_colour += area * Vec3(material.texture == nullptr ? material.colour : kPlain);
    }
  }
  if (!(low.y <= high.y)) return {};
  // The top of a thin slab rather than its underside, but never a plane that would drown what stands on a
  // plinth.
  const double width = high.x - low.x, depth = high.z - low.z;
  const double highest = low.y + kThinSlab * std::sqrt(width * width + depth * depth);
  const Level* floor = nullptr;
  for (const auto& [bin, level] : levels) {
    if (level.area >= kGoodPart * width * depth && level.lowest <= highest) floor = &level;
  }
  if (floor) {
    // Uneven flags may lie on both sides of a level's edge.
    const auto under = levels.find(static_cast<std::int64_t>(std::floor(floor->lowest / voxel_m)) - 1);
    const bool uneven = under != levels.end() && floor->lowest - under->second.highest < 0.5 * voxel_m;
    return {uneven ? under->second.lowest : floor->lowest, sim::Colour(floor->area_colour / floor->area)};
  }
  return {low.y, kPlain};
}

}  // namespace espalier::render
