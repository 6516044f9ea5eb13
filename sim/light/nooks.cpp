#include "sim/light/nooks.h"

#include <atomic>
#include <cmath>

#include "sim/base/parallel.h"
#include "sim/light/open_surfaces.h"

namespace espalier::sim {
namespace {

// Found by trying (docs/decisions.md).
constexpr float kDeep = 0.45f;      // of |n.x| + |n.y| + |n.z|: below this height, in voxel widths
constexpr float kSlanting = 1.1f;   // |n.x| + |n.y| + |n.z|: walls nearer to an axis have no stairs so high
constexpr float kParallel = 0.99f;  // cosine between normals
constexpr int kPlain = 8;           // of the 27 voxels around face alike

template <class Visit>
void forEachAround(Voxel size, Voxel voxel, Visit visit) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Voxel way(dx, dy, dz);
        if (contains(size, voxel + way)) visit(way, voxel + way);
      }
    }
  }
}

bool isPlain(const World& world, const TiledVoxel& tiled) {
  int alike = 0;
  forEachAround(world.frame().size, tiled.voxel, [&](Voxel, Voxel v) {
    const auto surface = world.surfaceAt(v);
    alike += surface && glm::dot(surface->normal, tiled.surface.normal) > kParallel ? 1 : 0;
  });
  return alike >= kPlain;
}

}  // namespace

BitVolume nooksOf(const World& world) {
  BitVolume nooks(world.frame().size);
  parallelForEach(static_cast<std::size_t>(nooks.size().y), [&](std::size_t slice) {
    forEachOpenSurface(world, static_cast<int>(slice), [&](const TiledVoxel& tiled) {
      const Vec3f n = tiled.surface.normal;
      const float length = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
      if (length < kSlanting || !isPlain(world, tiled)) return true;
      forEachAround(nooks.size(), tiled.voxel, [&](Voxel way, Voxel v) {
        if (world.opaque().at(v)) return;
        if (glm::dot(Vec3f(way), n) - tiled.surface.offset_vx >= kDeep * length) return;
        // Slices share voxels; the order in which bits are set does not matter.
        std::atomic_ref(nooks.row(v.y, v.z)[v.x >> 6])
            .fetch_or(std::uint64_t{1} << (v.x & 63), std::memory_order_relaxed);
      });
      return true;
    });
  });
  return nooks;
}

}  // namespace espalier::sim
