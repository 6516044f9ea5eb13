#include "sim/light/nooks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <span>

#include "sim/base/parallel.h"
#include "sim/light/in_plane.h"
#include "sim/light/open_surfaces.h"

namespace espalier::sim {
namespace {

// Found by trying (docs/decisions.md).
constexpr float kDeep = 0.45f;      // of |n.x| + |n.y| + |n.z|: below this height, in voxel widths
constexpr float kSlanting = 1.1f;   // |n.x| + |n.y| + |n.z|: walls nearer to an axis have no stairs so high
constexpr float kParallel = 0.99f;  // cosine between normals
constexpr int kPlain = 3;           // a wall that is plain so far has stairs

constexpr int kAround = 27;

Voxel wayAround(int i) {
  return Voxel(i % 3, i / 9, i / 3 % 3) - 1;
}

/// Whether the surface goes on as it is along both of its axes, to one side at least: in corners at a wall's
/// foot there is no other.
bool isPlain(const World& world, const TiledVoxel& tiled) {
  const int up = longestAxis(tiled.surface.normal), u = (up + 1) % 3, w = (up + 2) % 3;
  const auto goesOnAt = [&](Voxel way) {
    const auto surface = world.surfaceAt(tiled.voxel + way);
    return surface && goesOn(tiled.surface, *surface, way, kParallel);
  };
  const auto goesOnAlong = [&](int axis, int voxels) {
    Voxel aside(0);
    aside[axis] = voxels;
    const auto ways = inPlane(tiled.surface, up, aside);
    return goesOnAt(ways[0]) || goesOnAt(ways[1]);
  };
  return std::ranges::all_of(
      std::array{u, w}, [&](int axis) { return goesOnAlong(axis, kPlain) || goesOnAlong(axis, -kPlain); });
}

}  // namespace

BitVolume nooksOf(const World& world) {
  BitVolume nooks(world.frame().size);
  parallelForEach(static_cast<std::size_t>(nooks.size().y), [&](std::size_t slice) {
    forEachOpenSurface(world, static_cast<int>(slice), 0, nooks.size().z, [&](const TiledVoxel& tiled) {
      const Vec3f n = tiled.surface.normal;
      const float length = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
      if (length < kSlanting) return true;
      std::array<Voxel, kAround> deep;
      std::size_t count = 0;
      for (int i = 0; i < kAround; ++i) {
        const Voxel way = wayAround(i), v = tiled.voxel + way;
        if (glm::dot(Vec3f(way), n) - tiled.surface.offset_vx >= kDeep * length) continue;
        if (contains(nooks.size(), v) && !world.opaque().at(v)) deep[count++] = v;
      }
      if (count == 0 || !isPlain(world, tiled)) return true;
      for (const Voxel v : std::span(deep).first(count)) {
        // Slices share voxels; the order in which bits are set does not matter.
        std::atomic_ref(nooks.row(v.y, v.z)[v.x >> 6])
            .fetch_or(std::uint64_t{1} << (v.x & 63), std::memory_order_relaxed);
      }
      return true;
    });
  });
  return nooks;
}

}  // namespace espalier::sim
