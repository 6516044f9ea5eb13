#include "scenes/inspect/mesh_shape.h"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/import/placing.h"

namespace espalier::scenes {

double MeshShape::longest() const {
  return std::max({size().x, size().y, size().z});
}

double areaOf(const sim::Mesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return 0.5 * glm::length(glm::cross(mesh.vertices_m[b] - mesh.vertices_m[a],
                                      mesh.vertices_m[c] - mesh.vertices_m[a]));
}

MeshShape shapeOf(const sim::Mesh& mesh) {
  constexpr double kAlong = 0.985, kBeside = 0.174;  // cosine and sine of 10 degrees
  constexpr double kRather = 0.707;
  MeshShape shape;
  for (const auto& [a, b, c] : mesh.triangles) {
    const sim::Vec3 &p = mesh.vertices_m[a], &q = mesh.vertices_m[b], &r = mesh.vertices_m[c];
    shape.low = glm::min(shape.low, glm::min(p, glm::min(q, r)));
    shape.high = glm::max(shape.high, glm::max(p, glm::max(q, r)));
    const sim::Vec3 twice = glm::cross(q - p, r - p);
    const double length = glm::length(twice);
    shape.area += 0.5 * length;
    shape.net += 0.5 * twice;
    shape.middle += 0.5 * length * ((p + q + r) / 3.0);
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      if (std::abs(twice[axis]) >= kAlong * length) shape.across[k] += 0.5 * length;
      if (std::abs(twice[axis]) >= kRather * length) shape.level[k] += 0.5 * length;
      if (std::abs(twice[axis]) <= kBeside * length) shape.beside[k] += 0.5 * length;
    }
  }
  shape.net /= shape.area;
  shape.middle /= shape.area;
  for (auto* const shares : {&shape.across, &shape.beside, &shape.level}) {
    for (double& share : *shares) share /= shape.area;
  }
  return shape;
}

bool isOfALength(const MeshShape& shape) {
  return shape.longest() >= kLeastLength && shape.longest() <= kMostLength && shape.area > 0.0;
}

bool isTooHighForAHouse(const MeshShape& shape_m, UpAxis up) {
  constexpr double kWalls = 0.2;
  const int axis = up == UpAxis::z ? 2 : 1;
  return shape_m.size()[axis] >= kLarge_m && shape_m.beside[static_cast<std::size_t>(axis)] >= kWalls;
}

std::vector<UnitReading> likelyUnits(double longest) {
  constexpr double kLeast_m = 1.0, kMost_m = 100.0, kUsual_m = 10.0;
  std::vector<UnitReading> likely;
  for (const LengthUnit unit : {LengthUnit::m, LengthUnit::cm, LengthUnit::mm}) {
    const double metres = Placing({.unit = unit}).length(longest);
    if (metres >= kLeast_m && metres <= kMost_m) likely.push_back({unit, metres});
  }
  const auto off = [](const UnitReading& reading) {
    return std::max(reading.longest_m / kUsual_m, kUsual_m / reading.longest_m);
  };
  std::stable_sort(likely.begin(), likely.end(),
                   [&](const UnitReading& a, const UnitReading& b) { return off(a) < off(b); });
  return likely;
}

std::string inDigits(double number) {
  return number >= 100.0 ? fmt::format("{:.0f}", number) : fmt::format("{:.3g}", number);
}

std::string sizeText(const sim::Vec3& size_m) {
  return fmt::format("{} x {} x {} m", inDigits(size_m.x), inDigits(size_m.y), inDigits(size_m.z));
}

}  // namespace espalier::scenes
