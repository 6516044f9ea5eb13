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
constexpr std::int32_t kNowhere = -1;
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

/// Where each segment first meets something: a bit of the cube, or kNowhere.
void Meet(const Start& start, Bits hinders, const Offsets& ends, std::size_t count, std::int32_t* met) {
  const Whole d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    Walk walk(start, hn::Load(d, ends.x + i), hn::Load(d, ends.y + i), hn::Load(d, ends.z + i));
    const auto counted =
        hn::Lt(hn::Iota(d, static_cast<std::int32_t>(i)), set(static_cast<std::int32_t>(count)));
    walk.left = hn::IfThenElseZero(counted, walk.left);
    I where = set(kNowhere);
    while (!hn::AllFalse(d, walk.active())) {
      const auto moving = walk.active();
      walk.advance();
      const auto hit = hn::And(moving, bitAt(hinders, walk.index));
      where = hn::IfThenElse(hit, walk.index, where);
      walk.left = hn::IfThenZeroElse(hit, walk.left);
    }
    hn::Store(where, d, met + i);
  }
}

/// Sums of the distances of what each segment crosses, all of it inside the world, and whether it takes
/// something.
void Measure(const Start& start, Voxel low, const NearSteps& near, Bits free, const Offsets& ends,
             std::size_t count, std::int32_t* sums, std::int32_t* crossed, std::int32_t* takes) {
  const Whole d;
  const I mask = set((1 << start.side_bits) - 1);
  const auto* const blocks = reinterpret_cast<const std::int32_t*>(near.block);
  const auto* const steps = reinterpret_cast<const std::int32_t*>(near.steps);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    Walk walk(start, hn::Load(d, ends.x + i), hn::Load(d, ends.y + i), hn::Load(d, ends.z + i));
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
    I sum = distance();
    auto taking = bitAt(free, walk.index);
    hn::Store(hn::Add(walk.left, set(1)), d, crossed + i);
    while (!hn::AllFalse(d, walk.active())) {
      const auto moving = walk.active();
      walk.advance();
      sum = hn::Add(sum, hn::IfThenElseZero(moving, distance()));
      taking = hn::Or(taking, hn::And(moving, bitAt(free, walk.index)));
    }
    hn::Store(sum, d, sums + i);
    hn::Store(hn::IfThenElseZero(taking, set(1)), d, takes + i);
  }
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

/// 64 voxels of a row from x on; what lies outside is 0.
std::uint64_t bitsFrom(const BitVolume& volume, int x, int y, int z) {
  const std::uint64_t* const row = volume.row(y, z);
  const auto word = [&](int w) {
    return w < volume.rowWords() ? row[w] : 0u;
  };  // from -1 on: the rows' padding
  const int w = x >> 6, shift = x & 63;
  return shift == 0 ? word(w) : word(w) >> shift | word(w + 1) << (64 - shift);
}

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

/// Of a row's voxels from x on that hold elements alone, those whose first element is of a plant.
std::uint64_t elementsOf(const World& world, int plant, Voxel first, std::uint64_t elements) {
  std::uint64_t own = 0;
  for (std::uint64_t left = elements; left != 0; left &= left - 1) {
    const int dx = std::countr_zero(left);
    const PartId part = world.partAt(first + Voxel(dx, 0, 0));
    if (world.part(part).plant == plant) own |= std::uint64_t{1} << dx;
  }
  return own;
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

Room roomAround(const World& world, Voxel at, int reach, std::span<const Voxel> attachment, Passage passage,
                int plant) {
  const Voxel size = world.frame().size;
  Room room{at - reach, reach, 3, false, {}, {}};
  while (1 << room.side_bits < 2 * reach + 1) ++room.side_bits;
  room.at_rim = !contains(size, room.low) || !contains(size, at + reach);
  const std::size_t row_bits = std::size_t{1} << room.side_bits;
  const auto n = (row_bits * row_bits * row_bits + 63) / 64;
  room.hinders.resize(n);
  room.free.resize(n);
  for (int dy = 0; dy <= 2 * reach; ++dy) {
    for (int dz = 0; dz <= 2 * reach; ++dz) {
      const int y = room.low.y + dy, z = room.low.z + dz;
      const bool inside = y >= 0 && z >= 0 && y < size.y && z < size.z;
      for (int dx = 0; dx <= 2 * reach; dx += 64) {
        const Voxel first(room.low.x + dx, y, z);
        const std::uint64_t cube = bitsBetween(first.x, room.low.x, room.low.x + 2 * reach + 1);
        const std::uint64_t in = inside ? cube & bitsBetween(first.x, 0, size.x) : 0u;
        std::uint64_t stands = 0;
        if (in != 0) {
          stands = bitsFrom(world.occupied(), first.x, y, z) & in;
          const std::uint64_t elements = stands & ~bitsFrom(world.solid(), first.x, y, z);
          if (elements != 0) stands &= ~elementsOf(world, plant, first, elements);
        }
        const std::size_t bit = bitOf(room, first);
        room.hinders[bit / 64] |= ((cube & ~in) | (passage == Passage::around ? stands : 0u)) << (bit % 64);
        room.free[bit / 64] |= (in & ~stands) << (bit % 64);
      }
    }
  }
  for (const Voxel v : attachment) {
    if (!holds(room, v) || !contains(size, v)) continue;
    const std::size_t bit = bitOf(room, v);
    room.hinders[bit / 64] &= ~(std::uint64_t{1} << (bit % 64));
  }
  return room;
}

Vec3 endOf(Vec3 from_vx, const Offsets& ends, std::size_t i) {
  const Fixed end = fixedFromVoxel(from_vx) + Fixed(ends.x[i], ends.y[i], ends.z[i]);
  return Vec3(end) / static_cast<double>(kFixedOne);
}

void feel(const World& world, const Room& room, Vec3 from_vx, const Offsets& ends, std::size_t count,
          Felt& felt) {
  const feelers::Start start = startOf(room, fixedFromVoxel(from_vx));
  alignas(64) std::int32_t met[Offsets::kMost];
  if (((room.hinders[static_cast<std::size_t>(start.index) / 64] >> (start.index % 64)) & 1u) != 0) {
    std::fill_n(met, count, start.index);
  } else {
    HWY_DYNAMIC_DISPATCH(feelers::Meet)(start, words(room.hinders), ends, count, met);
  }
  Offsets left;  // those that met nothing, closed up
  std::size_t number[Offsets::kMost], clear = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (met[i] == feelers::kNowhere) {
      left.x[clear] = ends.x[i], left.y[clear] = ends.y[i], left.z[clear] = ends.z[i];
      number[clear++] = i;
      continue;
    }
    felt.fate[i] = Felt::blocked;
    if (!room.at_rim) continue;
    const int mask = (1 << room.side_bits) - 1;
    const Voxel v =
        room.low + Voxel(met[i] & mask, met[i] >> (2 * room.side_bits), (met[i] >> room.side_bits) & mask);
    if (!contains(world.frame().size, v)) felt.fate[i] = Felt::outside;
  }
  if (clear == 0) return;
  for (std::size_t i = clear; i < Offsets::kMost; ++i) left.x[i] = left.y[i] = left.z[i] = 0;
  alignas(64) std::int32_t sums[Offsets::kMost], crossed[Offsets::kMost], takes[Offsets::kMost];
  HWY_DYNAMIC_DISPATCH(feelers::Measure)
  (start, room.low, world.nearSteps(), words(room.free), left, clear, sums, crossed, takes);
  for (std::size_t k = 0; k < clear; ++k) {
    felt.fate[number[k]] = takes[k] != 0 ? Felt::clear : Felt::blocked;
    felt.proximity_vx[number[k]] =
        static_cast<float>(sums[k]) / static_cast<float>(NearSteps::kInVoxel * crossed[k]);
  }
}

}  // namespace espalier::sim
#endif
