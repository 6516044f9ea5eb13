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

std::vector<TubeFrame> rotationMinimizingFrames(std::span<const TubeStation> line,
                                                std::span<const Vec3> along, Vec3 across) {
  std::vector<TubeFrame> frames(line.size());
  const auto square = [&](Vec3 v, std::size_t i) {
    const Vec3 flat = v - glm::dot(v, along[i]) * along[i];
    const double length2 = glm::dot(flat, flat);
    return length2 > 1e-12 ? flat / std::sqrt(length2) : anyPerpendicular(along[i]);
  };
  across = square(across, 0);
  frames[0] = {along[0], across, glm::cross(along[0], across)};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec3 step = line[i].centre_m - line[i - 1].centre_m;
    const Vec3 turned = reflected(across, step);
    across = square(reflected(turned, along[i] - reflected(along[i - 1], step)), i);
    frames[i] = {along[i], across, glm::cross(along[i], across)};
  }
  return frames;
}

std::vector<TubeFrame> rotationMinimizingFrames(std::span<const TubeStation> line) {
  if (line.size() < 2) return {};
  const std::vector<Vec3> along = tangents(line);
  return rotationMinimizingFrames(line, along, anyPerpendicular(along[0]));
}

std::vector<Vec3> chordsOverThickness(std::span<const TubeStation> line) {
  std::vector<Vec3> result(line.size());
  // The point at `reach` along the line from station i, towards the end (way 1) or the start (way -1).
  const auto reached = [&](std::size_t i, double reach, std::ptrdiff_t way) {
    const std::size_t end = way > 0 ? line.size() - 1 : 0;
    while (i != end) {
      const std::size_t next = i + static_cast<std::size_t>(way);
      const double length = glm::distance(line[i].centre_m, line[next].centre_m);
      if (length >= reach) return glm::mix(line[i].centre_m, line[next].centre_m, reach / length);
      reach -= length;
      i = next;
    }
    return line[end].centre_m;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec3 chord = reached(i, line[i].radius_m, 1) - reached(i, line[i].radius_m, -1);
    const std::size_t from = i + 1 < line.size() ? i : i - 1;
    result[i] = glm::dot(chord, chord) > 1e-6 * line[i].radius_m * line[i].radius_m
                    ? glm::normalize(chord)
                    : glm::normalize(line[from + 1].centre_m - line[from].centre_m);
  }
  return result;
}

namespace {

constexpr double kApart = 0.9;         // of the way to where two rings would touch
constexpr double kLeastThinned = 0.1;  // of its thickness that a tube keeps in a hairpin

/// How thick two neighbouring stations may be, as a share of their radii.
double shareApart(const TubeStation& a, Vec3 along_a, const TubeStation& b, Vec3 along_b) {
  const double turn = glm::length(glm::cross(along_a, along_b));
  if (glm::dot(along_a, along_b) <= 0.0) return kLeastThinned;
  const Vec3 step = b.centre_m - a.centre_m;
  const double room = std::min(glm::dot(step, along_a) / b.radius_m, glm::dot(step, along_b) / a.radius_m);
  return turn > 0.0 ? kApart * room / turn : room > 0.0 ? 1.0 : kLeastThinned;
}

void ease(std::span<TubeStation> line) {
  constexpr double kSlope = 0.5;
  const auto limit = [&](std::size_t i, std::size_t from) {
    const double reach = kSlope * glm::distance(line[i].centre_m, line[from].centre_m);
    line[i].radius_m = std::min(line[i].radius_m, line[from].radius_m + reach);
  };
  for (std::size_t i = 1; i < line.size(); ++i) limit(i, i - 1);
  for (std::size_t i = line.size(); i-- > 1;) limit(i - 1, i);
}

}  // namespace

std::vector<Vec3> keepRingsApart(std::vector<TubeStation>& line,
                                 const std::function<void(std::size_t)>& dropped) {
  if (line.size() < 2) return {};
  std::vector<Vec3> along = chordsOverThickness(line);
  std::vector<std::size_t> kept{0};
  const std::size_t last = line.size() - 1;
  // Rings that lie beyond each other's reach stay, however the line turns between them: else all that follows
  // a sharp bend would be left out.
  const auto apart = [&](std::size_t a, std::size_t b) {
    return shareApart(line[a], along[a], line[b], along[b]) >= 1.0 ||
           glm::distance(line[a].centre_m, line[b].centre_m) > line[a].radius_m + line[b].radius_m;
  };
  for (std::size_t i = 1; i < last; ++i) {
    if (apart(kept.back(), i)) kept.push_back(i);
  }
  while (kept.size() > 1 && !apart(kept.back(), last)) kept.pop_back();
  const auto fromLast = [&](std::size_t a) { return glm::distance(line[a].centre_m, line[last].centre_m); };
  if (fromLast(kept.back()) < 0.1 * line[last].radius_m) {  // a hairpin: its ends must not fall together
    std::size_t farthest = kept.back();
    for (std::size_t i = farthest + 1; i < last; ++i)
      if (fromLast(i) > fromLast(farthest)) farthest = i;
    if (farthest != kept.back()) kept.push_back(farthest);
  }
  kept.push_back(last);
  std::size_t k = 0;
  for (std::size_t i = 0; i < line.size() && dropped; ++i) {
    if (kept[k] == i) {
      ++k;
    } else {
      dropped(i);
    }
  }
  if (kept.size() < line.size()) {
    for (k = 0; k < kept.size(); ++k) line[k] = line[kept[k]];
    line.resize(kept.size());
    along = chordsOverThickness(line);
  }

  bool thinned = false;
  std::vector<double> share(line.size(), 1.0);
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double most = std::max(kLeastThinned, shareApart(line[i], along[i], line[i + 1], along[i + 1]));
    if (most >= 1.0) continue;
    thinned = true;
    share[i] = std::min(share[i], most);
    share[i + 1] = std::min(share[i + 1], most);
  }
  if (!thinned) return along;
  for (std::size_t i = 0; i < line.size(); ++i) line[i].radius_m *= share[i];
  ease(line);
  return chordsOverThickness(line);
}

void appendTube(ModelMesh& mesh, std::span<const TubeStation> line, int sides, std::uint32_t piece) {
  if (line.size() < 2) return;
  const std::vector<TubeFrame> frames = rotationMinimizingFrames(line);
  const auto count = static_cast<std::uint32_t>(sides);
  const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
  const std::size_t last = line.size() - 1;
  double v = 0.0;
  for (std::size_t i = 0; i < last; ++i) {
    for (std::uint32_t s = 0; s < count; ++s) {
      const float u = static_cast<float>(s) / static_cast<float>(count);
      const float angle = 2.0f * std::numbers::pi_v<float> * u;
      const Vec3 out = static_cast<double>(std::cos(angle)) * frames[i].across +
                       static_cast<double>(std::sin(angle)) * frames[i].up;
      appendVertex(mesh, line[i].centre_m + line[i].radius_m * out, out, u, v, line[i], piece);
    }
    v += glm::distance(line[i + 1].centre_m, line[i].centre_m);
  }
  appendVertex(mesh, line[last].centre_m, frames[last].along, 0.5f, v, line[last], piece);
  for (std::uint32_t i = 0; i + 1 < last; ++i) {
    const std::uint32_t lower = first + i * count, upper = lower + count;
    for (std::uint32_t s = 0; s < count; ++s) {
      const std::uint32_t next = (s + 1) % count;
      mesh.triangles.push_back({lower + s, lower + next, upper + next});
      mesh.triangles.push_back({lower + s, upper + next, upper + s});
    }
  }
  const std::uint32_t point = first + static_cast<std::uint32_t>(last) * count;
  for (std::uint32_t s = 0; s < count; ++s)
    mesh.triangles.push_back({point - count + s, point - count + (s + 1) % count, point});
}

}  // namespace espalier::render
