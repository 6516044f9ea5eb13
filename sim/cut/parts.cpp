#include "sim/cut/parts.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "sim/base/parallel.h"
#include "sim/base/sets.h"
#include "sim/base/stop.h"
#include "sim/tile/joined.h"

namespace espalier::sim {
namespace {

/// Volume and middle by tetrahedra from its first point, so that far from the origin no digits are lost.
void measure(ClosedPart& part) {
  const Vec3 from = part.points.front();
  double sum = 0.0;
  Vec3 moment(0.0);
  for (const auto& t : part.triangles) {
    const Vec3 a = part.points[t[0]] - from, b = part.points[t[1]] - from, c = part.points[t[2]] - from;
    const double six = glm::dot(a, glm::cross(b, c));
    sum += six;
    moment += six * (a + b + c);
  }
  part.volume = sum / 6.0;
  part.middle = sum != 0.0 ? from + moment / (4.0 * sum) : from;
}

/// Whether a place lies inside: by the solid angle at which the surface is seen from there (Van Oosterom and
/// Strackee, 1983). Rays would run through corners, as these lie in rows.
bool holds(const ClosedPart& part, Vec3 p) {
  double angle = 0.0;
  for (const auto& t : part.triangles) {
    const Vec3 a = part.points[t[0]] - p, b = part.points[t[1]] - p, c = part.points[t[2]] - p;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    angle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                              la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return std::abs(angle) > 2.0 * M_PI;
}

void append(ClosedPart& part, const ClosedPart& cavity) {
  const auto first = static_cast<std::uint32_t>(part.points.size());
  part.points.insert(part.points.end(), cavity.points.begin(), cavity.points.end());
  for (const auto& [a, b, c] : cavity.triangles) part.triangles.push_back({first + a, first + b, first + c});
}

std::vector<ClosedPart> shellsOf(const QuadSurface& surface) {
  Sets sets(surface.points.size());
  for (const auto& q : surface.quads)
    for (int k = 1; k < 4; ++k) sets.join(q[0], q[static_cast<std::size_t>(k)]);
  std::vector<std::uint32_t> shell(surface.points.size()), number(surface.points.size());
  std::vector<ClosedPart> shells;
  for (std::uint32_t i = 0; i < surface.points.size(); ++i) {
    const std::uint32_t first = sets.of(i);  // the least of its own: it came before
    if (first == i) {
      shell[i] = static_cast<std::uint32_t>(shells.size());
      shells.emplace_back();
    }
    shell[i] = shell[first];
    number[i] = static_cast<std::uint32_t>(shells[shell[i]].points.size());
    shells[shell[i]].points.push_back(surface.points[i]);
  }
  const auto length2 = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 way = surface.points[a] - surface.points[b];
    return glm::dot(way, way);
  };
  for (const auto& q : surface.quads) {
    ClosedPart& part = shells[shell[q[0]]];
    const std::size_t from = length2(q[0], q[2]) <= length2(q[1], q[3]) ? 0 : 1;
    const auto at = [&](std::size_t k) { return number[q[(from + k) % 4]]; };
    part.triangles.push_back({at(0), at(1), at(2)});
    part.triangles.push_back({at(0), at(2), at(3)});
  }
  return shells;
}

}  // namespace

std::vector<ClosedPart> partsOf(const QuadSurface& surface) {
  std::vector<ClosedPart> shells = shellsOf(surface);
  parallelForEach(shells.size(), [&](std::size_t i) { measure(shells[i]); });
  std::stable_sort(shells.begin(), shells.end(), [](const ClosedPart& a, const ClosedPart& b) {
    return std::tuple(-a.volume, a.middle.x, a.middle.y, a.middle.z) <
           std::tuple(-b.volume, b.middle.x, b.middle.y, b.middle.z);
  });
  std::vector<ClosedPart> parts;
  for (ClosedPart& shell : shells) {
    throwIfStopped();
    if (shell.volume > 0.0) {
      parts.push_back(std::move(shell));
      continue;
    }
    // A cavity: of the smallest that holds it.
    for (std::size_t i = parts.size(); i-- > 0;) {
      if (!holds(parts[i], shell.points.front())) continue;
      append(parts[i], shell);
      measure(parts[i]);
      break;
    }
  }
  return parts;
}

OpenEdges openEdgesOf(const Mesh& mesh) {
  const Joined whole = joined(mesh);
  OpenEdges open;
  forEachEdge(whole, [&](const Side* sides, std::size_t sharing) {
    if (sharing % 2 == 0 || open.count++ > 0) return;
    const auto& places = whole.triangles[sides->triangle];
    const auto& corners = mesh.triangles[sides->triangle];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (std::minmax({places[k], places[next]}) == std::pair(sides->a, sides->b))
        open.at_m = 0.5 * (mesh.vertices_m[corners[k]] + mesh.vertices_m[corners[next]]);
    }
  });
  return open;
}

}  // namespace espalier::sim
