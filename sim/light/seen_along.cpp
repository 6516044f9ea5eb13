#include "sim/light/seen_along.h"

#include <algorithm>
#include <cmath>

#include "sim/light/in_plane.h"
#include "sim/light/lie_alike.h"
#include "sim/light/places_before.h"

namespace espalier::sim {
namespace {

constexpr float kAlongAxis = 0.998f;  // cosine: surfaces that have no stairs
constexpr float kFarthest = 4.0f;     // so far aside a low ray is followed: beyond, layers hide each other
constexpr std::size_t kKept = 64;

}  // namespace

SeenAlong::SeenAlong(const OpenTable& open, const DirectionSet& directions)
    : open_(open), rays_(kKept), numbers_(*open.where), seen_(open.words()) {
  for (const LatticeDirection& d : directions) units_.emplace_back(glm::normalize(Vec3(d.v)));
}

const std::uint64_t* SeenAlong::from(const TiledVoxel& tiled) {
  const Surface& surface = tiled.surface;
  if (std::abs(surface.normal[longestAxis(surface.normal)]) < kAlongAxis) return nullptr;
  Rays& rays = rays_[hashOf(surface) % kKept];
  if (!lieAlike(rays.surface, surface)) {
    rays.surface = surface;
    find(rays);
  }
  const Voxel size = open_.where->bits().size();
  const auto isPlace = [&](Voxel v) { return contains(size, v) && open_.where->has(v); };
  const Voxel before = tiled.voxel + rays.before;
  if (!isPlace(before)) return nullptr;
  std::fill(seen_.begin(), seen_.end(), 0);
  const std::uint64_t* mask = rays.masks.data();
  for (const Voxel aside : rays.aside) {
    // As far as places lead: what stands in between hides the direction from the last of them too.
    const int steps = std::max({std::abs(aside.x), std::abs(aside.y), std::abs(aside.z)});
    Voxel place = before;
    for (int i = 1; i <= steps; ++i) {
      const Voxel next =
          before + Voxel(glm::round(Vec3f(aside) * (static_cast<float>(i) / static_cast<float>(steps))));
      if (!isPlace(next)) break;
      place = next;
    }
    const std::uint64_t* const row = open_.row(numbers_(place)).data();
    for (std::size_t w = 0; w < seen_.size(); ++w) seen_[w] |= row[w] & *mask++;
  }
  return seen_.data();
}

void SeenAlong::find(Rays& rays) const {
  const int up = longestAxis(rays.surface.normal);
  const float side = rays.surface.normal[up] > 0.0f ? 1.0f : -1.0f;
  const float layer = std::max(1.0f, std::ceil(rays.surface.offset_vx + kClear));
  const float height = layer - rays.surface.offset_vx;
  rays.before = Voxel(0);
  rays.before[up] = static_cast<int>(side * layer);
  rays.aside.clear();
  rays.masks.clear();
  for (std::size_t d = 0; d < units_.size(); ++d) {
    Vec3f across = units_[d];
    const float rising = std::max(0.0f, side * across[up]);
    across[up] = 0.0f;
    const float flat = glm::length(across);
    // From the surface up to the layer, or as far as low rays are followed.
    const float along = height * flat <= kFarthest * rising ? height / std::max(rising, 1e-6f)
                                                            : kFarthest / std::max(flat, 1e-6f);
    const Voxel aside(glm::round(across * along));
    auto at =
        static_cast<std::size_t>(std::find(rays.aside.begin(), rays.aside.end(), aside) - rays.aside.begin());
    if (at == rays.aside.size()) {
      rays.aside.push_back(aside);
      rays.masks.resize(rays.masks.size() + seen_.size(), 0);
    }
    rays.masks[at * seen_.size() + d / 64] |= std::uint64_t{1} << (d % 64);
  }
}

}  // namespace espalier::sim
