#include "sim/sense/feelers.h"

#include <algorithm>
#include <array>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/sense/feelers.cpp"
// Vectors whose length is known when compiling.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

namespace espalier::sim::feelers {

// What all lanes share. Shared by the instruction sets, so it stands before and outside of them.
#ifndef ESPALIER_SIM_SENSE_FEELERS_SHARED
#define ESPALIER_SIM_SENSE_FEELERS_SHARED
struct Start {
  int side_bits;
  std::int32_t index;      // of the first voxel, in the cube's bits
  std::int32_t within[3];  // how far in its voxel the segments begin, 0 .. 4095
};
/// Bits of a cube as words that lanes read.
using Bits = const std::uint32_t*;
#endif

}  // namespace espalier::sim::feelers

HWY_BEFORE_NAMESPACE();
namespace espalier::sim::feelers::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Whole = hn::ScalableTag<std::int32_t>;
using Words = hn::ScalableTag<std::uint32_t>;
using I = hn::Vec<Whole>;

HWY_INLINE I set(std::int32_t value) {
  return hn::Set(Whole(), value);
}

/// Whether a bit is set, lane by lane.
HWY_INLINE auto bitAt(Bits bits, I index) {
  const Words words;
  const auto word = hn::GatherIndex(words, bits, hn::ShiftRight<5>(index));
  const auto shift = hn::BitCast(words, hn::And(index, set(31)));
  return hn::RebindMask(Whole(), hn::TestBit(hn::Shr(word, shift), hn::Set(words, 1u)));
}

/// Segments on their way through the planes between voxels, as tileSegment's walk takes them.
struct Walk {
  I index, left;  // the voxel's bit in the cube; planes that are still to cross
  I step_x, step_y, step_z;
  I length_x, length_y, length_z;  // times the distance between planes
  I xy, xz, yz;                    // below 0 where the first crosses its next plane before the second

  HWY_INLINE Walk(const Start& start, I dx, I dy, I dz) {
    index = set(start.index);
    const Axis x(start.within[0], dx, 0), y(start.within[1], dy, 2 * start.side_bits),
        z(start.within[2], dz, start.side_bits);
    left = hn::Add(hn::Add(x.planes, y.planes), z.planes);
    step_x = x.step, step_y = y.step, step_z = z.step;
    xy = lead(x, y), xz = lead(x, z), yz = lead(y, z);
    length_x = hn::ShiftLeft<12>(x.length);
    length_y = hn::ShiftLeft<12>(y.length);
    length_z = hn::ShiftLeft<12>(z.length);
  }

  HWY_INLINE auto active() const { return hn::Gt(left, hn::Zero(Whole())); }

  /// Crosses a plane in the lanes that have one left.
  HWY_INLINE void advance() {
    const I none = hn::Zero(Whole());
    const auto x_first = hn::And(hn::Lt(xy, none), hn::Lt(xz, none));
    const auto y_first = hn::AndNot(hn::Lt(xy, none), hn::Lt(yz, none));
    const I moved = hn::IfThenElse(x_first, step_x, hn::IfThenElse(y_first, step_y, step_z));
    index = hn::Add(index, hn::IfThenElseZero(active(), moved));
    xy = hn::Add(xy, hn::IfThenElse(x_first, length_y, hn::IfThenElseZero(y_first, hn::Neg(length_x))));
    xz = hn::Add(xz, hn::IfThenElse(x_first, length_z, hn::IfThenZeroElse(y_first, hn::Neg(length_x))));
    yz = hn::Add(yz, hn::IfThenElse(y_first, length_z, hn::IfThenZeroElse(x_first, hn::Neg(length_y))));
    left = hn::Sub(left, set(1));
  }

 private:
  struct Axis {
    I length, to_plane, step, planes;
    typename hn::Mask<Whole> up;

    HWY_INLINE Axis(std::int32_t within, I d, int shift) {
      const I none = hn::Zero(Whole());
      up = hn::Gt(d, none);
      length = hn::Abs(d);
      to_plane = hn::IfThenElse(up, set(static_cast<std::int32_t>(kFixedOne) - within),
                                hn::IfThenElse(hn::Lt(d, none), set(within), set(1)));
      step = hn::IfThenElse(up, set(1 << shift), set(-(1 << shift)));
      planes = hn::Abs(hn::ShiftRight<12>(hn::Add(d, set(within))));
    }
  };
  HWY_INLINE static I lead(const Axis& a, const Axis& b) {
    const I apart = hn::Sub(hn::Mul(a.to_plane, b.length), hn::Mul(b.to_plane, a.length));
    return hn::Sub(apart, hn::IfThenElseZero(a.up, set(1)));
  }
};

/// Bits of a mask from number i on.
template <class Mask>
HWY_INLINE std::uint64_t bitsOf(Mask mask, std::size_t i) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Whole(), mask, bytes);
  std::uint64_t bits;
  hwy::CopyBytes<sizeof(bits)>(bytes, &bits);
  return bits << i;
}

/// Where each segment first meets something, as a bit of the cube. Returns which ones meet nothing, bit i for
/// segment i.
std::uint64_t Meet(const Start& start, Bits hinders, const Offsets& ends, std::size_t count,
                   std::int32_t* met) {
  const Whole d;
  std::uint64_t clear = 0;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    Walk walk(start, hn::Load(d, ends.x + i), hn::Load(d, ends.y + i), hn::Load(d, ends.z + i));
    const auto counted =
        hn::Lt(hn::Iota(d, static_cast<std::int32_t>(i)), set(static_cast<std::int32_t>(count)));
    walk.left = hn::IfThenElseZero(counted, walk.left);
    auto free = counted;
    while (!hn::AllFalse(d, walk.active())) {
      const auto moving = walk.active();
      walk.advance();
      const auto hit = hn::And(moving, bitAt(hinders, walk.index));
      free = hn::AndNot(hit, free);
      walk.left = hn::IfThenZeroElse(hit, walk.left);
    }
    hn::Store(walk.index, d, met + i);
    clear |= bitsOf(free, i);
  }
  return clear;
}

/// Mean distances of what each segment crosses, all of it inside the world. Returns which ones take
/// something, bit i for segment i.
std::uint64_t Measure(const Start& start, Voxel low, const NearSteps& near, Bits free, const Offsets& ends,
                      std::size_t count, float* proximity_vx) {
  const Whole d;
  const hn::ScalableTag<float> df;
  const I mask = set((1 << start.side_bits) - 1);
  const auto* const blocks = reinterpret_cast<const std::int32_t*>(near.block);
  const auto* const steps = reinterpret_cast<const std::int32_t*>(near.steps);
  std::uint64_t takes = 0;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto counted =
        hn::Lt(hn::Iota(d, static_cast<std::int32_t>(i)), set(static_cast<std::int32_t>(count)));
    const auto loaded = [&](const std::int32_t* from) {
      return hn::IfThenElseZero(counted, hn::Load(d, from + i));
    };
    Walk walk(start, loaded(ends.x), loaded(ends.y), loaded(ends.z));
    const auto distance = [&] {
      const I x = hn::Add(hn::And(walk.index, mask), set(low.x));
      const I z = hn::Add(hn::And(hn::ShiftRightSame(walk.index, start.side_bits), mask), set(low.z));
      const I y = hn::Add(hn::ShiftRightSame(walk.index, 2 * start.side_bits), set(low.y));
      const I row = hn::Add(hn::Mul(hn::ShiftRight<3>(y), set(near.blocks.z)), hn::ShiftRight<3>(z));
      const I block = hn::Add(hn::Mul(row, set(near.blocks.x)), hn::ShiftRight<3>(x));
      const I seven = set(7);
      const I inside =
          hn::Or(hn::Or(hn::ShiftLeft<6>(hn::And(y, seven)), hn::ShiftLeft<3>(hn::And(z, seven))),
                 hn::And(x, seven));
      const I at = hn::Add(hn::GatherIndex(d, blocks, block), inside);
      const I pair = hn::GatherIndex(d, steps, hn::ShiftRight<1>(at));
      const auto high = hn::Ne(hn::And(at, set(1)), hn::Zero(d));
      return hn::And(hn::IfThenElse(high, hn::ShiftRight<16>(pair), pair), set(0xffff));
    };
    const I crossed = hn::Add(walk.left, set(1));
    I sum = distance();
    auto taking = bitAt(free, walk.index);
    while (!hn::AllFalse(d, walk.active())) {
      const auto moving = walk.active();
      walk.advance();
      sum = hn::Add(sum, hn::IfThenElseZero(moving, distance()));
      taking = hn::Or(taking, hn::And(moving, bitAt(free, walk.index)));
    }
    const auto mean =
        hn::Div(hn::ConvertTo(df, sum), hn::ConvertTo(df, hn::Mul(crossed, set(NearSteps::kInVoxel))));
    hn::Store(mean, df, proximity_vx + i);
    takes |= bitsOf(taking, i);
  }
  return takes;
}

}  // namespace espalier::sim::feelers::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier::sim {
namespace feelers {
HWY_EXPORT(Meet);
HWY_EXPORT(Measure);
}  // namespace feelers
namespace {

/// Of 64 voxels from x on, those from `first` to before `last`.
std::uint64_t bitsBetween(int x, int first, int last) {
  const auto below = [&](int end) {
    return end <= x ? 0u : end - x >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << (end - x)) - 1;
  };
  return below(last) & ~below(first);
}

std::size_t bitOf(const Room& room, Voxel v) {
  const auto [x, y, z] = std::array{v.x - room.low.x, v.y - room.low.y, v.z - room.low.z};
  return static_cast<std::size_t>(((y << room.side_bits) + z) << room.side_bits) +
         static_cast<std::size_t>(x);
}

bool holds(const Room& room, Voxel v) {
  return contains(Voxel(2 * room.reach + 1), v - room.low);
}

feelers::Start startOf(const Room& room, Fixed from) {
  const Fixed corner = from + kFixedOne / 2;
  const Voxel at(corner.x >> 12, corner.y >> 12, corner.z >> 12);
  const auto within = [](std::int64_t along) { return static_cast<std::int32_t>(along & (kFixedOne - 1)); };
  return {room.side_bits,
          static_cast<std::int32_t>(bitOf(room, at)),
          {within(corner.x), within(corner.y), within(corner.z)}};
}

feelers::Bits words(const std::vector<std::uint64_t>& bits) {
  return reinterpret_cast<feelers::Bits>(bits.data());
}

}  // namespace

void roomAround(const World& world, Voxel at, int reach, std::span<const Voxel> attachment, Passage passage,
                int plant, Room& room) {
  const Voxel size = world.frame().size;
  const BitVolume &occupied = world.occupied(), &solid = world.solid();
  const int across = 2 * reach + 1;
  room.low = at - reach;
  room.reach = reach;
  room.side_bits = 3;
  while (1 << room.side_bits < across) ++room.side_bits;
  room.at_rim = !contains(size, room.low) || !contains(size, at + reach);
  const std::size_t n = (std::size_t{1} << (3 * room.side_bits)) / 64;
  room.hinders.assign(n, 0);
  room.free.assign(n, 0);
  const std::uint64_t hinders_too = passage == Passage::through ? 0 : ~std::uint64_t{0};
  for (int dx = 0; dx < across; dx += 64) {
    const int x = room.low.x + dx;
    const std::uint64_t cube = bitsBetween(x, room.low.x, room.low.x + across);
    const std::uint64_t in_x = cube & bitsBetween(x, 0, size.x);
    for (int dy = 0; dy < across; ++dy) {
      const int y = room.low.y + dy;
      const bool in_y = in_x != 0 && y >= 0 && y < size.y;
      std::size_t bit = bitOf(room, {x, y, room.low.z});
      for (int z = room.low.z; z < room.low.z + across; ++z, bit += std::size_t{1} << room.side_bits) {
        std::uint64_t hinders = cube, free = 0;
        if (in_y && z >= 0 && z < size.z) {
          std::uint64_t stands = occupied.from({x, y, z}) & in_x;
          const std::uint64_t elements = stands & ~solid.from({x, y, z});
          const std::uint64_t yields = passage == Passage::past_own ? stands : elements;
          if (yields != 0) stands &= ~world.ofPlant({x, y, z}, yields, plant);
          hinders = (cube & ~in_x) | (stands & hinders_too);
          free = in_x & ~stands;
        }
        room.hinders[bit / 64] |= hinders << (bit % 64);
        room.free[bit / 64] |= free << (bit % 64);
      }
    }
  }
  for (const Voxel v : attachment) {
    if (!holds(room, v) || !contains(size, v)) continue;
    const std::size_t bit = bitOf(room, v);
    room.hinders[bit / 64] &= ~(std::uint64_t{1} << (bit % 64));
  }
}

Vec3 endOf(Vec3 from_vx, const Offsets& ends, std::size_t i) {
  const Fixed end = fixedFromVoxel(from_vx) + Fixed(ends.x[i], ends.y[i], ends.z[i]);
  return Vec3(end) / static_cast<double>(kFixedOne);
}

void feel(const World& world, const Room& room, Vec3 from_vx, const Offsets& ends, std::size_t count,
          Felt& felt) {
  const feelers::Start start = startOf(room, fixedFromVoxel(from_vx));
  felt.clear = felt.outside = 0;
  alignas(64) std::int32_t met[Offsets::kMost];
  if (((room.hinders[static_cast<std::size_t>(start.index) / 64] >> (start.index % 64)) & 1u) != 0) {
    std::fill_n(met, count, start.index);
  } else {
    felt.clear = HWY_DYNAMIC_DISPATCH(feelers::Meet)(start, words(room.hinders), ends, count, met);
  }
  if (room.at_rim) {
    const int mask = (1 << room.side_bits) - 1;
    for (std::size_t i = 0; i < count; ++i) {
      if ((felt.clear >> i & 1u) != 0) continue;
      const Voxel v =
          room.low + Voxel(met[i] & mask, met[i] >> (2 * room.side_bits), (met[i] >> room.side_bits) & mask);
      if (!contains(world.frame().size, v)) felt.outside |= std::uint64_t{1} << i;
    }
  }
  if (felt.clear == 0) return;
  Offsets left;  // those that met nothing, closed up
  std::size_t number[Offsets::kMost], found = 0;
  for (std::uint64_t bits = felt.clear; bits != 0; bits &= bits - 1, ++found) {
    const auto i = number[found] = static_cast<std::size_t>(std::countr_zero(bits));
    left.x[found] = ends.x[i], left.y[found] = ends.y[i], left.z[found] = ends.z[i];
  }
  alignas(64) float proximity_vx[Offsets::kMost];
  const std::uint64_t takes = HWY_DYNAMIC_DISPATCH(feelers::Measure)(
      start, room.low, world.nearSteps(), words(room.free), left, found, proximity_vx);
  for (std::size_t k = 0; k < found; ++k) {
    felt.proximity_vx[number[k]] = proximity_vx[k];
    if ((takes >> k & 1u) == 0) felt.clear &= ~(std::uint64_t{1} << number[k]);
  }
}

}  // namespace espalier::sim
#endif
