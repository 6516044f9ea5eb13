#include "render/model/tubes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::render {
namespace {

using sim::Vec3;

Vec3 anyPerpendicular(Vec3 along) {
  // The vertical makes frames of neighbouring stems agree; a vertical stem takes x.
  const Vec3 helper = std::abs(along.y) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
  return glm::normalize(glm::cross(helper, along));
}

Vec3 reflected(Vec3 v, Vec3 across) {
  const double length2 = glm::dot(across, across);
  return length2 > 1e-18 ? v - (2.0 * glm::dot(across, v) / length2) * across : v;
}

/// Halfway between the directions of the two neighbouring pieces: rings then lie in the mitre planes.
std::vector<Vec3> tangents(std::span<const TubeStation> line) {
  std::vector<Vec3> result(line.size());
  Vec3 before = glm::normalize(line[1].centre_m - line[0].centre_m);
  result[0] = before;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec3 after = i + 1 < line.size() ? glm::normalize(line[i + 1].centre_m - line[i].centre_m) : before;
    const Vec3 sum = before + after;
    result[i] = glm::dot(sum, sum) > 1e-6 ? glm::normalize(sum) : before;
    before = after;
  }
  return result;
}

void appendVertex(ModelMesh& mesh, Vec3 p, Vec3 normal, float u, double v, const TubeStation& station,
                  std::uint32_t piece) {
  mesh.positions_m.emplace_back(p);
  mesh.normals.emplace_back(normal);
  mesh.uvs.emplace_back(u, static_cast<float>(v));
  mesh.exposures.push_back(station.exposure);
  mesh.youths.push_back(station.youth);
  mesh.pieces.push_back(piece);
}

}  // namespace

std::vector<TubeFrame> rotationMinimizingFrames(std::span<const TubeStation> line) {
  if (line.size() < 2) return {};
  const std::vector<Vec3> along = tangents(line);
  std::vector<TubeFrame> frames(line.size());
  Vec3 across = anyPerpendicular(along[0]);
  frames[0] = {along[0], across, glm::cross(along[0], across)};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec3 step = line[i].centre_m - line[i - 1].centre_m;
    const Vec3 turned = reflected(across, step);
    across = reflected(turned, along[i] - reflected(along[i - 1], step));
    across = glm::normalize(across - glm::dot(across, along[i]) * along[i]);
    frames[i] = {along[i], across, glm::cross(along[i], across)};
  }
  return frames;
}

void limitRadiusByBend(std::span<TubeStation> line) {
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const Vec3 a = line[i].centre_m - line[i - 1].centre_m, b = line[i + 1].centre_m - line[i].centre_m;
    const double la = glm::length(a), lb = glm::length(b);
    const double cosine = std::clamp(glm::dot(a, b) / (la * lb), -1.0, 1.0);
    const double half_tangent =
        std::sqrt((1.0 - cosine) / std::max(1.0 + cosine, 1e-9));  // tan of half the turn
    if (half_tangent > 0.0)
      line[i].radius_m = std::min(line[i].radius_m, 0.48 * std::min(la, lb) / half_tangent);
  }
  constexpr double kSlope = 0.5;
  const auto ease = [&](std::size_t i, std::size_t from) {
    const double reach = kSlope * glm::distance(line[i].centre_m, line[from].centre_m);
    line[i].radius_m = std::min(line[i].radius_m, line[from].radius_m + reach);
  };
  for (std::size_t i = 1; i < line.size(); ++i) ease(i, i - 1);
  for (std::size_t i = line.size(); i-- > 1;) ease(i - 1, i);
}

void appendTube(ModelMesh& mesh, std::span<const TubeStation> line, int sides, std::uint32_t piece) {
  if (line.size() < 2) return;
  const std::vector<TubeFrame> frames = rotationMinimizingFrames(line);
  std::vector<glm::vec2> circle;
  for (int s = 0; s < sides; ++s) {
    const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(s) / static_cast<float>(sides);
    circle.emplace_back(std::cos(angle), std::sin(angle));
  }
  const auto count = static_cast<std::uint32_t>(sides);
  const auto outward = [&](std::size_t i, std::uint32_t s) {
    const glm::vec2 c = circle[s % count];
    return static_cast<double>(c.x) * frames[i].across + static_cast<double>(c.y) * frames[i].up;
  };
  const auto ring = [&](std::size_t i, double v,
                        bool cap) {  // caps have no seam, walls repeat the first corner
    const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
    for (std::uint32_t s = 0; s < count + (cap ? 0u : 1u); ++s) {
      const Vec3 out = outward(i, s);
      appendVertex(mesh, line[i].centre_m + line[i].radius_m * out, cap ? -frames[i].along : out,
                   static_cast<float>(s) / static_cast<float>(count), v, line[i], piece);
    }
    return first;
  };

  const std::uint32_t base = ring(0, 0.0, true);
  for (std::uint32_t s = 1; s + 1 < count; ++s) mesh.triangles.push_back({base, base + s + 1, base + s});

  double v = 0.0;
  std::uint32_t lower = ring(0, v, false);
  for (std::size_t i = 1; i < line.size(); ++i) {
    v += glm::distance(line[i].centre_m, line[i - 1].centre_m);
    const std::uint32_t upper = ring(i, v, false);
    for (std::uint32_t s = 0; s < count; ++s) {
      mesh.triangles.push_back({lower + s, lower + s + 1, upper + s + 1});
      mesh.triangles.push_back({lower + s, upper + s + 1, upper + s});
    }
    lower = upper;
  }
  const std::size_t last = line.size() - 1;
  const auto point = static_cast<std::uint32_t>(mesh.positions_m.size());
  appendVertex(mesh, line[last].centre_m + line[last].radius_m * frames[last].along, frames[last].along, 0.5f,
               v + line[last].radius_m, line[last], piece);
  for (std::uint32_t s = 0; s < count; ++s) mesh.triangles.push_back({lower + s, lower + s + 1, point});
}

}  // namespace espalier::render
