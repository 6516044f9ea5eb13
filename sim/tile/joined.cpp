#include "sim/tile/joined.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "sim/base/stop.h"

namespace espalier::sim {

Joined joined(const Mesh& mesh) {
  std::vector<std::uint32_t> order(mesh.vertices_m.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto at = [&](std::uint32_t v) {
    const Vec3& p = mesh.vertices_m[v];
    return std::tuple(p.x, p.y, p.z);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return at(a) < at(b); });
  std::vector<std::uint32_t> place(order.size());
  std::uint32_t places = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && at(order[i]) != at(order[i - 1])) ++places;
    place[order[i]] = places;
  }
  Joined result;
  result.places = places + 1u;
  result.triangles.reserve(mesh.triangles.size());
  std::vector<bool> used(places + 1u);
  for (const auto& [a, b, c] : mesh.triangles) {
    result.triangles.push_back({place[a], place[b], place[c]});
    for (const std::uint32_t corner : result.triangles.back()) used[corner] = true;
  }
  result.corners = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  result.sides.reserve(3 * result.triangles.size());
  for (std::uint32_t t = 0; t < result.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = result.triangles[t][k], to = result.triangles[t][(k + 1) % 3];
      if (from != to) result.sides.push_back({std::min(from, to), std::max(from, to), t, from < to});
    }
  }
  std::sort(result.sides.begin(), result.sides.end(), [](const Side& p, const Side& q) {
    return std::tie(p.a, p.b, p.triangle) < std::tie(q.a, q.b, q.triangle);
  });
  return result;
}

WoundPatches woundPatches(const Joined& mesh) {
  struct Neighbour {
    std::uint32_t triangle;
    bool against;
  };
  const std::size_t count = mesh.triangles.size();
  std::vector<std::array<Neighbour, 3>> beside(count);
  std::vector<std::uint8_t> edges(count);  // of each triangle, that it shares with one other
  forEachEdge(mesh, [&](const Side* sides, std::size_t sharing) {
    const std::uint32_t a = sides[0].triangle;
    if (sharing != 2 || sides[1].triangle == a) return;
    const std::uint32_t b = sides[1].triangle;
    const bool against = sides[0].forward == sides[1].forward;
    beside[a][edges[a]++] = {b, against};
    beside[b][edges[b]++] = {a, against};
  });
  WoundPatches patches;
  patches.against.resize(count);
  std::vector<bool> met(count);
  for (std::size_t first = 0; first < count; ++first) {
    if (met[first]) continue;
    throwIfStopped();
    met[first] = true;
    std::vector<std::uint32_t> patch{static_cast<std::uint32_t>(first)};
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (std::size_t k = 0; k < edges[patch[i]]; ++k) {
        const Neighbour& other = beside[patch[i]][k];
        if (met[other.triangle]) continue;
        met[other.triangle] = true;
        patches.against[other.triangle] = patches.against[patch[i]] != other.against;
        patch.push_back(other.triangle);
      }
    }
    std::sort(patch.begin(), patch.end());
    patches.triangles.push_back(std::move(patch));
  }
  return patches;
}

}  // namespace espalier::sim
