#include "sim/light/seen_along.h"

#include <algorithm>
#include <bit>

namespace espalier::sim {
namespace {

constexpr std::size_t kShared = 128;  // that are kept

std::size_t slotOf(const Surface& surface, const std::vector<Voxel>& ways) {
  std::uint64_t hash = std::bit_cast<std::uint32_t>(surface.offset_vx);
  const auto mix = [&](std::uint64_t more) { hash = (hash ^ more) * 0x9e3779b97f4a7c15u; };
  for (int axis = 0; axis < 3; ++axis) mix(std::bit_cast<std::uint32_t>(surface.normal[axis]));
  for (const Voxel way : ways) mix(static_cast<std::uint64_t>(way.x + 1024 * way.y + 1024 * 1024 * way.z));
  return static_cast<std::size_t>(hash >> 40) % kShared;
}

}  // namespace

SeenAlong::SeenAlong(const OpenTable& open, const DirectionSet& directions, const std::vector<Voxel>& places)
    : open_(open), places_(places), shared_(kShared), seen_(open.words()) {
  for (const LatticeDirection& d : directions) units_.emplace_back(glm::normalize(Vec3(d.v)));
}

const std::uint64_t* SeenAlong::from(const TiledVoxel& tiled, std::span<const SurfaceSensors::Tap> taps) {
  ways_.clear();
  for (const auto& tap : taps) ways_.push_back(places_[tap.place] - tiled.voxel);
  Shared& shared = shared_[slotOf(tiled.surface, ways_)];
  if (shared.surface.normal != tiled.surface.normal || shared.surface.offset_vx != tiled.surface.offset_vx ||
      shared.ways != ways_) {
    shared.surface = tiled.surface;
    shared.ways = ways_;
    share(shared);
  }
  std::fill(seen_.begin(), seen_.end(), 0);
  const std::uint64_t* mask = shared.masks.data();
  for (const auto& tap : taps) {
    const std::uint64_t* const row = open_.row(tap.place).data();
    for (std::size_t w = 0; w < seen_.size(); ++w) seen_[w] |= row[w] & *mask++;
  }
  return seen_.data();
}

void SeenAlong::share(Shared& shared) const {
  shared.masks.assign(shared.ways.size() * seen_.size(), 0);
  if (shared.ways.empty()) return;
  std::vector<Vec3f> from_surface;
  for (const Voxel way : shared.ways)
    from_surface.push_back(Vec3f(way) - shared.surface.offset_vx * shared.surface.normal);
  for (std::size_t d = 0; d < units_.size(); ++d) {
    std::size_t nearest = 0;
    float least = 0.0f;
    for (std::size_t i = 0; i < from_surface.size(); ++i) {
      const Vec3f& p = from_surface[i];
      const float along = std::max(0.0f, glm::dot(p, units_[d]));
      const float squared = glm::dot(p, p) - along * along;
      if (i == 0 || squared < least) {
        least = squared;
        nearest = i;
      }
    }
    shared.masks[nearest * seen_.size() + d / 64] |= std::uint64_t{1} << (d % 64);
  }
}

}  // namespace espalier::sim
