#include "scenes/inspect/winding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/base/parallel.h"

namespace espalier::scenes {
namespace {

/// The solid angle of a triangle, signed; 0 from a point in its plane. Van Oosterom and Strackee (1983).
double solidAngle(const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c) {
  constexpr double kFlat = 1e-9;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double volume = glm::dot(a, glm::cross(b, c));
  if (std::abs(volume) <= kFlat * la * lb * lc) return 0.0;
  return 2.0 *
         std::atan2(volume, la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

}  // namespace

std::vector<double> windingAbout(const sim::Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
  std::vector<double> windings(triangles.size());
  sim::parallelForEach(triangles.size(), [&](std::size_t i) {
    const auto cornersOf = [&](std::uint32_t t) {
      const auto& [a, b, c] = mesh.triangles[t];
      return std::array{mesh.vertices_m[a], mesh.vertices_m[b], mesh.vertices_m[c]};
    };
    const auto own = cornersOf(triangles[i]);
    const sim::Vec3 middle = (own[0] + own[1] + own[2]) / 3.0;
    double sum = 0.0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (t == triangles[i]) continue;
      const auto [a, b, c] = cornersOf(t);
      sum += solidAngle(a - middle, b - middle, c - middle);
    }
    windings[i] = sum / (2.0 * std::numbers::pi);
  });
  return windings;
}

std::size_t affordableWindings(std::size_t triangles) {
  constexpr std::size_t kMost = 2000, kLeast = 8, kSolidAngles = 20'000'000;
  return std::clamp(kSolidAngles / std::max<std::size_t>(1, triangles), kLeast, kMost);
}

}  // namespace espalier::scenes
