#include "sim/light/look.h"

#include <bit>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/light/look.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace espalier::sim::looking::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Words = hn::CappedTag<std::uint64_t, ClearBricks::kWords>;

constexpr std::size_t kWords = ClearBricks::kWords;
constexpr int kSide = ClearBricks::kSide;

/// The directions that are blocked near a place.
HWY_INLINE Mask blockedNear(const BitVolume& occupied, const Group& group, Voxel p) {
  const Words d;
  const Voxel size = occupied.size();
  const int x = p.x - kNear;
  Mask blocked;
  for (std::size_t r = 0; r < group.rows.size(); ++r) {
    const int y = p.y + group.rows[r][0], z = p.z + group.rows[r][1];
    if (y < 0 || y >= size.y || z < 0 || z >= size.z) continue;
    const std::uint64_t* const row = occupied.row(y, z) + (x >> 6);
    const std::uint64_t bits = (row[0] >> (x & 63)) | (row[1] << 1 << (63 - (x & 63)));
    for (std::size_t k = 0; k < kWords; k += hn::Lanes(d)) {
      auto all = hn::Load(d, blocked.words.data() + k);
      for (std::size_t n = 0; n < kFours; ++n)
        all = hn::Or(all, hn::Load(d, group.crossing[r][n][(bits >> (4 * n)) & 15u].words.data() + k));
      hn::Store(all, d, blocked.words.data() + k);
    }
  }
  return blocked;
}

/// The directions that meet nothing any more beyond what is near.
HWY_INLINE Mask clearBeyondNear(const Group& group, const ClearBricks& clear, Voxel p) {
  const Words d;
  const auto& in_x = group.leaving[0][static_cast<std::size_t>(p.x % kSide)];
  const auto& in_y = group.leaving[1][static_cast<std::size_t>(p.y % kSide)];
  const auto& in_z = group.leaving[2][static_cast<std::size_t>(p.z % kSide)];
  Mask found;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dx = -1; dx <= 1; ++dx) {
        const std::uint64_t* const row = clear.ofBrick(p / kSide + Voxel(dx, dy, dz));
        for (std::size_t k = 0; k < kWords; k += hn::Lanes(d)) {
          const auto across = hn::And(hn::Load(d, in_x[static_cast<std::size_t>(dx + 1)].words.data() + k),
                                      hn::Load(d, in_z[static_cast<std::size_t>(dz + 1)].words.data() + k));
          const auto up = hn::And(hn::Load(d, in_y[static_cast<std::size_t>(dy + 1)].words.data() + k), hn::LoadU(d, row + k));
          hn::Store(hn::Or(hn::Load(d, found.words.data() + k), hn::And(across, up)), d, found.words.data() + k);
        }
      }
    }
  }
  return found;
}

/// From where the legs end, with a look ahead after each period.
bool walkOn(const BitVolume& occupied, const Group& group, const ClearBricks& clear, Voxel p, std::size_t i) {
  const LatticeDirection& direction = group.directions[i];
  const std::size_t period = direction.crossed.size(), done = group.rays[i].near + kSteps;
  Voxel base = p + static_cast<int>(done / period) * direction.v;
  for (std::size_t k = done % period;; k = 0, base += direction.v) {
    for (; k < period; ++k) {
      const Voxel q = base + direction.crossed[k];
      if (!contains(occupied.size(), q)) return true;
      if (occupied.at(q)) return false;
    }
    if (clear.is(i, base + direction.v)) return true;
  }
}

/// What the legs are walked in.
struct Around {
  const std::uint64_t* words;
  std::ptrdiff_t start;  // the place, in bits from the first word
  bool rim;              // a step may lie above, below, before or behind the world
  std::size_t up, down, before, behind;  // voxels from the place to the rim
};

/// Whether one of the leg's steps is occupied. A step that would lie outside reads the first word, zeros.
template <bool kRim>
HWY_INLINE std::uint64_t hits(const Around& around, const Ray& ray, std::size_t within, std::size_t leg) {
  std::uint64_t hit = 0;
  for (std::size_t s = kLegs[leg - 1]; s < kLegs[leg]; s += 8) {
    for (std::size_t k = s; k < s + 8; ++k) {
      std::ptrdiff_t at = around.start + ray.steps[k];
      if (kRim) at = k < within ? at : 0;
      hit |= around.words[at >> 6] >> (at & 63);
    }
  }
  return hit & 1u;
}

template <bool kRim>
HWY_INLINE std::uint64_t walkLegs(const BitVolume& occupied, const Group& group, const ClearBricks& clear, const Around& around, Voxel p, std::size_t first, std::uint64_t ask) {
  std::uint64_t found = 0;
  for (std::size_t leg = 1; leg < kLegs.size() && ask != 0; ++leg) {
    std::uint64_t next = 0;
    for (; ask != 0; ask &= ask - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(ask));
      const Ray& ray = group.rays[first + i];
      std::size_t within = 0;
      if (kRim) {
        const Voxel v = group.directions[first + i].v;
        within = std::min(ray.within_y[v.y < 0 ? around.down : around.up], ray.within_z[v.z < 0 ? around.before : around.behind]);
      }
      const std::uint64_t free = hits<kRim>(around, ray, within, leg) ^ 1u;
      const std::uint64_t ends = clear.is(first + i, p + ray.beyond[leg]) ? 1 : 0;
      found |= (free & ends) << i;
      next |= (free & ~ends) << i;
    }
    ask = next;
  }
  for (; ask != 0; ask &= ask - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(ask));
    if (walkOn(occupied, group, clear, p, first + i)) found |= std::uint64_t{1} << i;
  }
  return found;
}

void Look(const BitVolume& occupied, const Group& group, const ClearBricks& clear,
          std::span<const Voxel> places, std::uint64_t* open, std::size_t stride) {
  const Voxel size = occupied.size();
  const std::size_t columns = (group.directions.size() + 63) / 64;
  const auto capped = [](int voxels) { return static_cast<std::size_t>(std::min(voxels, kFar - 1)); };
  for (const Voxel p : places) {
    const Mask blocked = blockedNear(occupied, group, p), at_once = clearBeyondNear(group, clear, p);
    Around around{occupied.words().data(), 0, false, capped(size.y - 1 - p.y), capped(p.y), capped(p.z), capped(size.z - 1 - p.z)};
    around.start = (occupied.row(p.y, p.z) - around.words) * BitVolume::kWordBits + p.x;
    around.rim = std::min({around.up, around.down, around.before, around.behind}) < kFar - 1;
    for (std::size_t k = 0; k < columns; ++k) {
      const std::size_t left = group.directions.size() - 64 * k;
      const std::uint64_t unblocked = ~blocked.words[k] & (left >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << left) - 1);
      const std::uint64_t ask = unblocked & ~at_once.words[k];
      open[k] = (unblocked & at_once.words[k]) |
                (around.rim ? walkLegs<true>(occupied, group, clear, around, p, 64 * k, ask)
                            : walkLegs<false>(occupied, group, clear, around, p, 64 * k, ask));
    }
    open += stride;
  }
}

void UniteShifted(std::uint8_t* target, const std::uint8_t* source, std::size_t bytes, int by,
                  std::uint64_t mask) {
  const auto unite = [&](auto shifted) HWY_ATTR {
    for (std::size_t i = 0; i < bytes; i += 8) {
      std::uint64_t from, to;
      std::memcpy(&from, source + i, 8);
      std::memcpy(&to, target + i, 8);
      to |= shifted(from) & mask;
      std::memcpy(target + i, &to, 8);
    }
  };
  if (by >= 0) {
    unite([by](std::uint64_t word) HWY_ATTR { return word >> by; });
  } else {
    unite([by](std::uint64_t word) HWY_ATTR { return word << -by; });
  }
}

}  // namespace espalier::sim::looking::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier::sim::looking {

HWY_EXPORT(Look);
HWY_EXPORT(UniteShifted);

void look(const BitVolume& occupied, const Group& group, const ClearBricks& clear,
          std::span<const Voxel> places, std::uint64_t* open, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(Look)(occupied, group, clear, places, open, stride);
}

void uniteShifted(std::uint8_t* target, const std::uint8_t* source, std::size_t bytes, int by,
                  std::uint64_t mask) {
  HWY_DYNAMIC_DISPATCH(UniteShifted)(target, source, bytes, by, mask);
}

}  // namespace espalier::sim::looking
#endif
