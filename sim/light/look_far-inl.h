// How rays are followed through coarse worlds, for look.cpp, once for each instruction set.
#if defined(ESPALIER_SIM_LIGHT_LOOK_FAR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SIM_LIGHT_LOOK_FAR_INL_H_
#undef ESPALIER_SIM_LIGHT_LOOK_FAR_INL_H_
#else
#define ESPALIER_SIM_LIGHT_LOOK_FAR_INL_H_
#endif

#include <hwy/highway.h>

#include "sim/light/look.h"

HWY_BEFORE_NAMESPACE();
namespace espalier::sim::looking::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Whether one of the first `count` of the next kAtOnce steps is occupied. If that is not all of them, others
/// may lie outside of the volume's words.
template <bool kSome>
HWY_INLINE bool anyOf(const std::uint64_t* words, std::ptrdiff_t start, const std::int64_t* steps,
                      std::size_t count) {
  const hn::CappedTag<std::int64_t, kAtOnce> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  auto hit = hn::Zero(du);
  for (std::size_t k = 0; k < kAtOnce; k += hn::Lanes(d)) {
    auto at = hn::Add(hn::LoadU(d, steps + k), hn::Set(d, start));
    if (kSome) {  // the first word holds zeros
      const auto meant =
          hn::Lt(hn::Iota(d, static_cast<std::int64_t>(k)), hn::Set(d, static_cast<std::int64_t>(count)));
      at = hn::IfThenElseZero(meant, at);
    }
    const auto read = hn::GatherIndex(du, words, hn::ShiftRight<6>(at));
    hit = hn::Or(hit, hn::Shr(read, hn::And(hn::BitCast(du, at), hn::Set(du, 63))));
  }
  return !hn::AllTrue(du, hn::Eq(hn::And(hit, hn::Set(du, 1)), hn::Zero(du)));
}

/// Whether one of the next `count` steps is occupied.
HWY_INLINE bool anyOfRun(const std::uint64_t* words, std::ptrdiff_t start, const std::int64_t* steps,
                         std::size_t count) {
  for (; count > kAtOnce; count -= kAtOnce, steps += kAtOnce) {
    if (anyOf<false>(words, start, steps, kAtOnce)) return true;
  }
  return anyOf<true>(words, start, steps, count);
}

/// Word k of the group's directions that are not blocked.
HWY_INLINE std::uint64_t unblockedIn(const Group& group, const Mask& blocked, std::size_t k) {
  const std::size_t left = group.directions.size() - 64 * k;
  return ~blocked.words[k] & (left >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << left) - 1);
}

/// Legs of a ray, or maps of directions.
using Whole = hn::CappedTag<std::int32_t, Horizons::kLanes>;

template <class M>
HWY_INLINE std::uint64_t bitsOf(M mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Whole(), mask, bytes);
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
}

/// How far along the directions anything lies, in steps along their axes of depth, and those along which it
/// may lie beyond what is near. A voxel that is beyond along another axis may be one less along that.
struct Farther {
  std::array<std::int32_t, 64 * ClearBricks::kWords> reach;
  Mask any;
};

HWY_INLINE void lookFarther(const Group& group, const Horizons& horizons, Voxel p, Farther& farther) {
  const Whole d;
  const hn::RebindToUnsigned<Whole> du;
  const auto x = hn::Set(d, p.x), y = hn::Set(d, p.y), z = hn::Set(d, p.z);
  farther.any = {};
  for (std::size_t i = 0; i < group.directions.size(); i += hn::Lanes(d)) {
    const auto read = [&](const std::int32_t* numbers) { return hn::LoadU(d, numbers + group.first + i); };
    const auto value = [&](const Horizons::Linear& of) {
      return hn::Add(hn::Add(hn::Mul(x, read(of.x.data())), hn::Mul(y, read(of.y.data()))),
                     hn::Add(hn::Mul(z, read(of.z.data())), read(of.rest.data())));
    };
    const auto column = hn::ShiftRightSame(value(horizons.place()[0]), horizons.shift());
    const auto line = hn::ShiftRightSame(value(horizons.place()[1]), horizons.shift());
    const auto square =
        hn::Add(hn::Add(read(horizons.firsts()), column), hn::Mul(line, read(horizons.lineLengths())));
    const auto two = hn::GatherIndex(du, horizons.squares(), hn::ShiftRight<1>(square));
    const auto half = hn::BitCast(du, hn::ShiftLeft<4>(hn::And(square, hn::Set(d, 1))));
    const auto bricks = hn::BitCast(d, hn::And(hn::Shr(two, half), hn::Set(du, 0xffff)));
    const auto end = hn::ShiftLeft<3>(bricks);  // the first depth behind the farthest brick
    static_assert(FilledAhead::kSide == 1 << 3);
    const auto reach = hn::Sub(hn::Sub(end, hn::Set(d, 1)), value(horizons.depth()));
    hn::StoreU(reach, d, farther.reach.data() + i);
    farther.any.words[i / 64] |= bitsOf(hn::Gt(reach, hn::Set(d, kNear - 1))) << (i % 64);
  }
}

/// Whether anything is met on a leg.
HWY_INLINE bool isBlocked(const BitVolume& occupied, const Group& group, std::size_t i, std::size_t leg,
                          Voxel p, std::ptrdiff_t start) {
  const Legs& legs = group.legs;
  const Legs::Ray& ray = group.legs.rays[i];
  const Voxel behind = p + Voxel(legs.x[leg + 1], legs.y[leg + 1], legs.z[leg + 1]);
  const std::size_t voxels = legs.voxels[leg], step = legs.step[leg];
  if (contains(occupied.size(), behind)) {  // so are all voxels before it
    return anyOfRun(occupied.words().data(), start + legs.period[leg] * ray.period,
                    legs.steps.data() + ray.first_step + step, voxels);
  }
  const LatticeDirection& direction = group.directions[i];
  const std::size_t period = direction.crossed.size();
  for (std::size_t k = step; k < step + voxels; ++k) {
    const Voxel q =
        p + direction.crossed[k % period] + (legs.period[leg] + static_cast<int>(k / period)) * direction.v;
    if (occupied.at(q)) return true;
  }
  return false;
}

/// The rest of a ray that meets nothing near, up to where it may meet anything. Legs whose bricks are empty
/// are passed many at a time.
HWY_INLINE bool reachesEdge(const BitVolume& occupied, const Group& group, const FilledAhead& ahead, Voxel p,
                            std::ptrdiff_t start, std::size_t i, std::int32_t reach) {
  const Whole d;
  const hn::RebindToUnsigned<Whole> du;
  const hn::Rebind<std::int16_t, Whole> half;
  const Legs::Ray& ray = group.legs.rays[i];
  const Voxel last = occupied.size() - 1, bricks = ahead.bricks(), v = group.directions[i].v;
  const std::uint32_t* const around = ahead.around(FilledAhead::octantOf(v));
  const auto read = [&](const std::vector<std::int16_t>& of, std::size_t leg) {
    return hn::PromoteTo(d, hn::LoadU(half, of.data() + leg));
  };
  // Of an axis: whether a leg goes on into the next brick, as 1 << 3.
  const auto leaves = [&](auto at, int axis) {
    const auto way = hn::Xor(at, hn::Set(d, v[axis] < 0 ? -1 : 0));
    return hn::And(
        hn::Add(hn::And(way, hn::Set(d, 7)), hn::Set(d, ray.spans[static_cast<std::size_t>(axis)])),
        hn::Set(d, 8));
  };
  for (std::size_t leg = ray.first; leg < ray.first + ray.count; leg += hn::Lanes(d)) {
    const auto x = hn::Add(hn::Set(d, p.x), read(group.legs.x, leg));
    const auto y = hn::Add(hn::Set(d, p.y), read(group.legs.y, leg));
    const auto z = hn::Add(hn::Set(d, p.z), read(group.legs.z, leg));
    // Negative where a leg begins outside of the world, or beyond all that may be met.
    const auto left =
        hn::Or(hn::Or(hn::Or(x, hn::Sub(hn::Set(d, last.x), x)), hn::Or(y, hn::Sub(hn::Set(d, last.y), y))),
               hn::Or(hn::Or(z, hn::Sub(hn::Set(d, last.z), z)),
                      hn::Sub(hn::Set(d, reach), read(group.legs.along, leg))));
    const auto counts = hn::Gt(left, hn::Set(d, -1));
    const auto brick =
        hn::Add(hn::ShiftRight<3>(x),
                hn::Mul(hn::Set(d, bricks.x),
                        hn::Add(hn::ShiftRight<3>(z), hn::Mul(hn::Set(d, bricks.z), hn::ShiftRight<3>(y)))));
    const auto number = hn::IfThenElseZero(counts, brick);
    const auto axes = hn::Or(hn::ShiftRight<3>(leaves(x, 0)),
                             hn::Or(hn::ShiftRight<2>(leaves(y, 1)), hn::ShiftRight<1>(leaves(z, 2))));
    const auto four = hn::GatherIndex(du, around, hn::ShiftRight<2>(number));
    const auto bit = hn::Or(hn::ShiftLeft<3>(hn::And(number, hn::Set(d, 3))), axes);
    const auto filled = hn::And(hn::BitCast(d, hn::Shr(four, hn::BitCast(du, bit))), hn::Set(d, 1));
    const auto may_meet = hn::And(counts, hn::Ne(filled, hn::Zero(d)));
    for (std::uint64_t ask = bitsOf(may_meet); ask != 0; ask &= ask - 1) {
      if (isBlocked(occupied, group, i, leg + static_cast<std::size_t>(std::countr_zero(ask)), p, start))
        return false;
    }
    if (!hn::AllTrue(d, counts)) return true;
  }
  return true;
}

/// The group's directions that reach the world's edge, of those that are not blocked near the place.
HWY_INLINE void lookFar(const BitVolume& occupied, const Group& group, const FilledAhead& ahead, Voxel p,
                        const Mask& blocked, std::uint64_t* open) {
  Farther farther;
  lookFarther(group, ahead.horizons(), p, farther);
  const std::ptrdiff_t start =
      (occupied.row(p.y, p.z) - occupied.words().data()) * BitVolume::kWordBits + p.x;
  for (std::size_t k = 0; 64 * k < group.directions.size(); ++k) {
    open[k] = unblockedIn(group, blocked, k);
    for (std::uint64_t ask = open[k] & farther.any.words[k]; ask != 0; ask &= ask - 1) {
      const std::size_t i = 64 * k + static_cast<std::size_t>(std::countr_zero(ask));
      if (!reachesEdge(occupied, group, ahead, p, start, i, farther.reach[i]))
        open[k] &= ~(std::uint64_t{1} << (i % 64));
    }
  }
}

}  // namespace espalier::sim::looking::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ESPALIER_SIM_LIGHT_LOOK_FAR_INL_H_
