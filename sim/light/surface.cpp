#include "sim/light/surface.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/matrix.hpp>

#include "sim/base/parallel.h"
#include "sim/light/nooks.h"
#include "sim/light/open_surfaces.h"

namespace espalier::sim {
namespace {

// How places are chosen, in voxel widths. Found by trying (docs/decisions.md).
constexpr float kClear = 0.4f;     // of |n.x| + |n.y| + |n.z|: above this height the stairs of a slanting
                                   // surface hide almost nothing; the stairs' tips reach up to a half of it
constexpr float kLoose = 0.1f;     // height that must do in narrow gaps
constexpr float kDepth = 2.0f;     // from the lowest to the highest place
constexpr float kRadius = 1.4f;    // places lie so near to the normal
constexpr float kDamping = 0.02f;  // added to the heights' variance, which may be little
constexpr float kDampingAside = 0.4f;  // and to that along the surface

using Tap = SurfaceSensors::Tap;

/// Until all places are known, a tap's place is the way from the surface to it.
constexpr int kWayBits = 5, kWayZero = 1 << (kWayBits - 1);

std::uint32_t packed(Voxel way) {
  const Voxel w = way + kWayZero;
  return static_cast<std::uint32_t>((w.y << (2 * kWayBits)) | (w.z << kWayBits) | w.x);
}
Voxel unpacked(std::uint32_t way) {
  const auto w = static_cast<int>(way);
  constexpr int kMask = (1 << kWayBits) - 1;
  return Voxel(w & kMask, w >> (2 * kWayBits), (w >> kWayBits) & kMask) - kWayZero;
}

/// The free places in front of a surface.
struct Places {
  static constexpr std::size_t kMost = 64;
  std::array<Voxel, kMost> way;
  std::array<float, kMost> nearness;
  std::size_t count = 0;

  void add(Voxel w, float squared_lateral) {
    if (count == kMost) return;
    const float n = 1.0f - squared_lateral / (kRadius * kRadius);
    way[count] = w;
    nearness[count++] = n * n;
  }
};

/// Walks up the columns of voxels along the normal's largest component; what lies behind something that takes
/// light does not see what the surface sees. Leaves out `nooks`, if given.
Places placesBefore(const BitVolume& opaque, const BitVolume* nooks, Voxel voxel, Vec3f n, float offset,
                    float clear) {
  const Vec3f size = glm::abs(n);
  const int up = size.y >= size.x && size.y >= size.z ? 1 : size.x >= size.z ? 0 : 2;
  const int u = (up + 1) % 3, w = (up + 2) % 3;
  const float skin = 0.5f * size[up] + 1e-3f;  // an open surface's own voxels reach so high
  Voxel low, high;
  for (int axis = 0; axis < 3; ++axis) {
    const float aside = kRadius * std::sqrt(std::max(0.0f, 1.0f - n[axis] * n[axis]));
    const float a = n[axis] * (offset + clear), b = n[axis] * (offset + clear + kDepth);
    low[axis] = static_cast<int>(std::ceil(std::min(a, b) - aside));
    high[axis] = static_cast<int>(std::floor(std::max(a, b) + aside));
  }
  const int step = n[up] > 0.0f ? 1 : -1;
  const int begin = step > 0 ? low[up] - 1 : high[up] + 1, end = step > 0 ? high[up] + 1 : low[up] - 1;
  Places places;
  Voxel way;
  for (way[u] = low[u]; way[u] <= high[u]; ++way[u]) {
    for (way[w] = low[w]; way[w] <= high[w]; ++way[w]) {
      for (way[up] = begin; way[up] != end; way[up] += step) {
        const Vec3f o(way);
        const float along = glm::dot(o, n), h = along - offset;
        if (h > clear + kDepth) break;
        const Voxel v = voxel + way;
        if (!contains(opaque.size(), v)) continue;
        if (opaque.at(v)) {
          if (h > skin) break;
          continue;
        }
        const float squared_lateral = glm::dot(o, o) - along * along;
        if (h >= clear && squared_lateral < kRadius * kRadius && !(nooks && nooks->at(v)))
          places.add(way, squared_lateral);
      }
    }
  }
  return places;
}

/// Appends the places with the weights by which what rises evenly from place to place, fitted to their
/// values, gives the value at the surface's own spot: before a floor at a wall's foot all places lie to one
/// side.
void appendTaps(const Places& places, Vec3f normal, float offset, std::vector<Tap>& taps) {
  float sum = 0.0f;
  Vec3f mean(0.0f);
  for (std::size_t i = 0; i < places.count; ++i) {
    sum += places.nearness[i];
    mean += places.nearness[i] * Vec3f(places.way[i]);
  }
  mean /= sum;
  glm::mat3 spread(0.0f);
  for (std::size_t i = 0; i < places.count; ++i) {
    const Vec3f d = Vec3f(places.way[i]) - mean;
    spread += places.nearness[i] / sum * glm::outerProduct(d, d);
  }
  spread += (kDamping - kDampingAside) * glm::outerProduct(normal, normal) + kDampingAside * glm::mat3(1.0f);
  const Vec3f slope = glm::inverse(spread) * (mean - offset * normal);
  for (std::size_t i = 0; i < places.count; ++i) {
    const float weight = places.nearness[i] / sum * (1.0f - glm::dot(slope, Vec3f(places.way[i]) - mean));
    taps.push_back({packed(places.way[i]), weight});
  }
}

/// Some of the surfaces in order, those that can be lit.
struct Stretch {
  std::vector<TiledVoxel> surfaces;
  std::vector<Tap> taps;
  std::vector<std::uint32_t> counts;

  void add(const BitVolume& opaque, const BitVolume* nooks, const TiledVoxel& tiled) {
    const Vec3f normal = tiled.surface.normal;
    if (normal == Vec3f(0.0f) || isBuried(opaque, tiled.voxel)) return;
    const float clear = kClear * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
    const float offset = tiled.surface.offset_vx;
    Places places = placesBefore(opaque, nooks, tiled.voxel, normal, offset, clear);
    if (places.count == 0) places = placesBefore(opaque, nullptr, tiled.voxel, normal, offset, clear);
    if (places.count == 0) places = placesBefore(opaque, nullptr, tiled.voxel, normal, offset, kLoose);
    if (places.count == 0) return;
    surfaces.push_back(tiled);
    counts.push_back(static_cast<std::uint32_t>(places.count));
    appendTaps(places, normal, offset, taps);
  }

  /// Parts share words of the rows; the order in which bits are set does not matter.
  void mark(BitVolume& places) const {
    std::size_t tap = 0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      for (std::uint32_t k = 0; k < counts[i]; ++k) {
        const Voxel v = surfaces[i].voxel + unpacked(taps[tap++].place);
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
        tap.place = static_cast<std::uint32_t>(numbers(tiled.voxel + unpacked(tap.place)));
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
  std::vector<Stretch> stretches(static_cast<std::size_t>(size.y));
  parallelForEach(stretches.size(), [&](std::size_t slice) {
    Stretch& mine = stretches[slice];
    forEachOpenSurface(world, static_cast<int>(slice), [&](const TiledVoxel& tiled) {
      mine.add(world.opaque(), &nooks, tiled);
      return true;
    });
    mine.taps.shrink_to_fit();
  });
  return joined(size, std::move(stretches));
}

bool anyCanBeLit(const World& world) {
  std::atomic<bool> found = false;
  parallelForEach(static_cast<std::size_t>(world.frame().size.y), [&](std::size_t slice) {
    forEachOpenSurface(world, static_cast<int>(slice), [&](const TiledVoxel& tiled) {
      Stretch one;
      one.add(world.opaque(), nullptr, tiled);
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
    const std::size_t last = std::min((p + 1) * kChunk, surfaces.size());
    for (std::size_t i = p * kChunk; i < last; ++i) stretches[p].add(world.opaque(), &nooks, surfaces[i]);
    stretches[p].taps.shrink_to_fit();
  });
  return joined(world.frame().size, std::move(stretches));
}

}  // namespace espalier::sim
