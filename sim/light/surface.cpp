#include "sim/light/surface.h"

#include <algorithm>
#include <atomic>

#include "sim/base/parallel.h"
#include "sim/light/nooks.h"
#include "sim/light/open_surfaces.h"
#include "sim/light/places_before.h"

namespace espalier::sim {
namespace {

using Tap = SurfaceSensors::Tap;

/// Some of the surfaces in order, those that can be lit.
struct Stretch {
  std::vector<TiledVoxel> surfaces;
  std::vector<Tap> taps;
  std::vector<std::uint32_t> counts;

  void add(const BitVolume& opaque, PlacesBefore& places, const TiledVoxel& tiled) {
    if (tiled.surface.normal == Vec3f(0.0f) || isBuried(opaque, tiled.voxel)) return;
    const std::uint32_t count = places.append(tiled, taps);
    if (count == 0) return;
    surfaces.push_back(tiled);
    counts.push_back(count);
  }

  /// Parts share words of the rows; the order in which bits are set does not matter.
  void mark(BitVolume& places) const {
    std::size_t tap = 0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      for (std::uint32_t k = 0; k < counts[i]; ++k) {
        const Voxel v = surfaces[i].voxel + wayOf(taps[tap++]);
        std::atomic_ref(places.row(v.y, v.z)[v.x >> 6])
            .fetch_or(std::uint64_t{1} << (v.x & 63), std::memory_order_relaxed);
      }
    }
  }
};

SurfaceSensors joined(Voxel size, std::vector<Stretch> stretches) {
  BitVolume bits(size);
  parallelForEach(stretches.size(), [&](std::size_t p) { stretches[p].mark(bits); });
  SurfaceSensors sensors;
  sensors.places = std::make_shared<const VoxelSet>(std::move(bits));
  std::vector<std::size_t> surface(stretches.size() + 1);
  for (std::size_t p = 0; p < stretches.size(); ++p)
    surface[p + 1] = surface[p] + stretches[p].surfaces.size();
  sensors.surfaces.resize(surface.back());
  sensors.own.resize(surface.back());
  sensors.taps.resize(stretches.size());
  parallelForEach(stretches.size(), [&](std::size_t p) {
    Stretch mine = std::move(stretches[p]);
    SurfaceSensors::Own own{static_cast<std::uint32_t>(p), 0, 0};
    NearbyNumbers numbers(*sensors.places);
    for (std::size_t i = 0; i < mine.surfaces.size(); ++i) {
      const TiledVoxel& tiled = mine.surfaces[i];
      own.count = mine.counts[i];
      sensors.surfaces[surface[p] + i] = tiled;
      sensors.own[surface[p] + i] = own;
      for (; own.count > 0; --own.count, ++own.first) {
        Tap& tap = mine.taps[own.first];
        tap.place = static_cast<std::uint32_t>(numbers(tiled.voxel + wayOf(tap)));
      }
    }
    sensors.taps[p] = std::move(mine.taps);
  });
  return sensors;
}

}  // namespace

SurfaceSensors surfaceSensors(const World& world) {
  const Voxel size = world.frame().size;
  const BitVolume nooks = nooksOf(world);
  constexpr int kRowsAtOnce = 64;
  const auto across = static_cast<std::size_t>((size.z + kRowsAtOnce - 1) / kRowsAtOnce);
  std::vector<Stretch> stretches(static_cast<std::size_t>(size.y) * across);
  parallelForEach(stretches.size(), [&](std::size_t p) {
    Stretch& mine = stretches[p];
    PlacesBefore places(world.opaque(), &nooks);
    const int y = static_cast<int>(p / across), z = static_cast<int>(p % across) * kRowsAtOnce;
    forEachOpenSurface(world, y, z, std::min(z + kRowsAtOnce, size.z), [&](const TiledVoxel& tiled) {
      mine.add(world.opaque(), places, tiled);
      return true;
    });
    mine.taps.shrink_to_fit();
  });
  return joined(size, std::move(stretches));
}

bool anyCanBeLit(const World& world) {
  std::atomic<bool> found = false;
  const Voxel size = world.frame().size;
  parallelForEach(static_cast<std::size_t>(size.y), [&](std::size_t slice) {
    PlacesBefore places(world.opaque(), nullptr);
    forEachOpenSurface(world, static_cast<int>(slice), 0, size.z, [&](const TiledVoxel& tiled) {
      Stretch one;
      one.add(world.opaque(), places, tiled);
      if (!one.surfaces.empty()) found = true;
      return !found;
    });
  });
  return found;
}

SurfaceSensors surfaceSensors(const World& world, std::vector<TiledVoxel> surfaces) {
  constexpr std::size_t kChunk = 4096;
  const BitVolume nooks = nooksOf(world);
  std::vector<Stretch> stretches((surfaces.size() + kChunk - 1) / kChunk);
  parallelForEach(stretches.size(), [&](std::size_t p) {
    PlacesBefore places(world.opaque(), &nooks);
    const std::size_t last = std::min((p + 1) * kChunk, surfaces.size());
    for (std::size_t i = p * kChunk; i < last; ++i) stretches[p].add(world.opaque(), places, surfaces[i]);
    stretches[p].taps.shrink_to_fit();
  });
  return joined(world.frame().size, std::move(stretches));
}

}  // namespace espalier::sim
