#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "render/model/model_mesh.h"
#include "sim/base/vec.h"

namespace espalier::tests {

/// What a surface is, by its points.
struct Topology {
  std::size_t points = 0, edges = 0, triangles = 0, components = 0;
  std::size_t bad_edges = 0;   ///< not walked once each way
  std::size_t bad_points = 0;  ///< whose triangles are not one closed fan
  std::size_t flat = 0;        ///< triangles with a point twice

  long euler() const {
    return static_cast<long>(points) - static_cast<long>(edges) + static_cast<long>(triangles);
  }
};

inline Topology topologyOf(const render::ModelMesh& mesh) {
  Topology result;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> walks;
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> after;  // around each point
  std::map<std::uint32_t, std::size_t> fans;
  std::vector<std::uint32_t> root(mesh.positions_m.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t p) {
    while (root[p] != p) p = root[p] = root[root[p]];
    return p;
  };
  for (const auto& t : mesh.triangles) {
    const std::array<std::uint32_t, 3> p{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
    result.flat += p[0] == p[1] || p[1] == p[2] || p[2] == p[0];
    for (std::size_t k = 0; k < 3; ++k) {
      ++walks[{p[k], p[(k + 1) % 3]}];
      after[p[k]][p[(k + 1) % 3]] = p[(k + 2) % 3];
      ++fans[p[k]];
      root[find(p[k])] = find(p[(k + 1) % 3]);
    }
  }
  for (const auto& [edge, count] : walks) {
    const auto back = walks.find({edge.second, edge.first});
    result.bad_edges += count != 1 || back == walks.end() || back->second != 1;
    result.edges += edge.first < edge.second;
  }
  std::set<std::uint32_t> components;
  for (const auto& [point, around] : after) {
    std::uint32_t at = around.begin()->first;
    std::size_t steps = 0;
    do {
      const auto next = around.find(at);
      if (next == around.end()) break;
      at = next->second;
      ++steps;
    } while (at != around.begin()->first && steps <= around.size());
    result.bad_points += steps != around.size() || steps != fans[point];
    components.insert(find(point));
  }
  result.points = after.size();
  result.triangles = mesh.triangles.size();
  result.components = components.size();
  return result;
}

/// How often a surface winds around a place.
inline double windingAt(const render::ModelMesh& mesh, sim::Vec3 p) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const sim::Vec3 a = sim::Vec3(mesh.positions_m[t[0]]) - p, b = sim::Vec3(mesh.positions_m[t[1]]) - p,
                    c = sim::Vec3(mesh.positions_m[t[2]]) - p;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    sum += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                            la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return sum / (4.0 * 3.14159265358979323846);
}

inline double volumeOf(const render::ModelMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    sum += glm::dot(sim::Vec3(mesh.positions_m[t[0]]),
                    glm::cross(sim::Vec3(mesh.positions_m[t[1]]), sim::Vec3(mesh.positions_m[t[2]]))) /
           6.0;
  }
  return sum;
}

}  // namespace espalier::tests
