#include "sim/light/places_before.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>

#include "sim/light/in_plane.h"
#include "sim/light/lie_alike.h"

namespace espalier::sim {
namespace {

// How places are chosen, in voxel widths. Found by trying (docs/decisions.md).
constexpr float kLoose = 0.1f;         // height that must do in narrow gaps
constexpr float kDepth = 2.0f;         // from the lowest to the highest place
constexpr float kRadius = 1.4f;        // places lie so near to the normal
constexpr float kDamping = 0.02f;      // added to the heights' variance, which may be little
constexpr float kDampingAside = 0.4f;  // and to that along the surface

using Tap = SurfaceSensors::Tap;

constexpr std::size_t kPatterns = 64;  // that are kept

std::uint32_t packed(Voxel way) {
  const Voxel w = way + kWayZero;
  return static_cast<std::uint32_t>((w.y << (2 * kWayBits)) | (w.z << kWayBits) | w.x);
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

enum class Found { free, opaque, none };

/// Walks up the columns of voxels along the normal's largest component; what lies behind something that takes
/// light does not see what the surface sees. ask(way, whether it matters) says what is there; where it does
/// not matter, it is too low for a place or a part of the surface itself.
template <class Ask>
Places placesBefore(Vec3f n, float offset, float clear, Ask ask) {
  const Vec3f size = glm::abs(n);
  const int up = longestAxis(n);
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
        const Found found = ask(way, h > skin || h >= clear);
        if (found == Found::opaque && h > skin) break;
        if (found != Found::free) continue;
        const float squared_lateral = glm::dot(o, o) - along * along;
        if (h >= clear && squared_lateral < kRadius * kRadius) places.add(way, squared_lateral);
      }
    }
  }
  return places;
}

Places placesBefore(const BitVolume& opaque, const BitVolume* nooks, const TiledVoxel& tiled, float clear) {
  return placesBefore(tiled.surface.normal, tiled.surface.offset_vx, clear, [&](Voxel way, bool) {
    const Voxel v = tiled.voxel + way;
    if (!contains(opaque.size(), v)) return Found::none;
    if (opaque.at(v)) return Found::opaque;
    return nooks && nooks->at(v) ? Found::none : Found::free;
  });
}

float clearOf(Vec3f normal) {
  return kClear * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
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

}  // namespace

PlacesBefore::PlacesBefore(const BitVolume& opaque, const BitVolume* nooks)
    : opaque_(opaque), nooks_(nooks), patterns_(kPatterns) {}

std::uint32_t PlacesBefore::appendPlainly(const TiledVoxel& tiled, std::vector<Tap>& taps) const {
  const Vec3f normal = tiled.surface.normal;
  const float clear = clearOf(normal);
  Places places = placesBefore(opaque_, nooks_, tiled, clear);
  if (places.count == 0) places = placesBefore(opaque_, nullptr, tiled, clear);
  if (places.count == 0) places = placesBefore(opaque_, nullptr, tiled, kLoose);
  if (places.count > 0) appendTaps(places, normal, tiled.surface.offset_vx, taps);
  return static_cast<std::uint32_t>(places.count);
}

std::uint32_t PlacesBefore::append(const TiledVoxel& tiled, std::vector<Tap>& taps) {
  const Surface& surface = tiled.surface;
  Pattern& pattern = patterns_[hashOf(surface) % kPatterns];
  if (!lieAlike(pattern.surface, surface)) {
    pattern.surface = surface;  // most on curved surfaces are met only once
    pattern.known = false;
    return appendPlainly(tiled, taps);
  }
  if (!pattern.known) learn(pattern);
  if (!holds(pattern, tiled.voxel)) return appendPlainly(tiled, taps);
  taps.insert(taps.end(), pattern.taps.begin(), pattern.taps.end());
  return static_cast<std::uint32_t>(pattern.taps.size());
}

void PlacesBefore::learn(Pattern& pattern) const {
  pattern.known = true;
  pattern.rows.clear();
  pattern.taps.clear();
  pattern.low_x = pattern.high_x = 0;
  const Vec3f normal = pattern.surface.normal;
  const float offset = pattern.surface.offset_vx;
  const Places places = placesBefore(normal, offset, clearOf(normal), [&](Voxel way, bool matters) {
    if (!matters) return Found::free;
    pattern.low_x = std::min(pattern.low_x, way.x);
    pattern.high_x = std::max(pattern.high_x, way.x);
    const auto same = [&](const Pattern::Row& row) { return row.y == way.y && row.z == way.z; };
    auto row = std::find_if(pattern.rows.begin(), pattern.rows.end(), same);
    if (row == pattern.rows.end()) row = pattern.rows.insert(row, {way.y, way.z, 0});
    row->free |= std::uint64_t{1} << (way.x + kWayZero);
    return Found::free;
  });
  if (places.count > 0) appendTaps(places, normal, offset, pattern.taps);
}

bool PlacesBefore::holds(const Pattern& pattern, Voxel voxel) const {
  const Voxel size = opaque_.size();
  if (pattern.taps.empty() || voxel.x + pattern.low_x < 0 || voxel.x + pattern.high_x >= size.x) return false;
  for (const Pattern::Row& row : pattern.rows) {
    const Voxel from(voxel.x - kWayZero, voxel.y + row.y, voxel.z + row.z);
    if (from.y < 0 || from.y >= size.y || from.z < 0 || from.z >= size.z) return false;
    if ((opaque_.from(from) & row.free) != 0) return false;
    if (nooks_ && (nooks_->from(from) & row.free) != 0) return false;
  }
  return true;
}

}  // namespace espalier::sim
