#include "sim/light/look.h"

#include <algorithm>
#include <bit>
#include <cstring>

// Vectors whose length is known when compiling: they are kept in arrays.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/light/look.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "sim/light/look_far-inl.h"

HWY_BEFORE_NAMESPACE();
namespace espalier::sim::looking::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kWords = ClearBricks::kWords;
constexpr int kSide = ClearBricks::kSide;

/// A group's mask in as many vectors as it takes.
constexpr std::size_t kLanes = HWY_MIN(kWords, HWY_LANES(std::uint64_t)), kParts = kWords / kLanes;
using Words = hn::CappedTag<std::uint64_t, kLanes>;
using Vector = hn::Vec<Words>;

HWY_INLINE Vector part(const Mask& mask, std::size_t i) {
  return hn::Load(Words(), mask.words.data() + kLanes * i);
}

HWY_INLINE Mask maskOf(const Vector (&parts)[kParts]) {
  Mask mask;
  for (std::size_t i = 0; i < kParts; ++i) hn::Store(parts[i], Words(), mask.words.data() + kLanes * i);
  return mask;
}

/// The directions that are blocked near a place.
HWY_INLINE Mask blockedNear(const BitVolume& occupied, const Group& group, Voxel p) {
  const Voxel size = occupied.size();
  const int x = p.x - kNear;
  const int shift = x & 63;
  const std::ptrdiff_t line = occupied.rowWords();
  Vector blocked[kParts];
  for (Vector& words : blocked) words = hn::Zero(Words());
  const auto* crossing = group.crossing.data();
  for (int dy = group.lowest; dy <= kNear; ++dy, crossing += 2 * kNear + 1) {
    if (p.y + dy < 0 || p.y + dy >= size.y) continue;
    const int first = std::max(-kNear, -p.z), last = std::min(kNear, size.z - 1 - p.z);
    const std::uint64_t* row = occupied.row(p.y + dy, p.z + first) + (x >> 6);
    for (int dz = first; dz <= last; ++dz, row += line) {
      const std::uint64_t bits = (row[0] >> shift) | (row[1] << 1 << (63 - shift));
      const auto& fours = crossing[dz + kNear];
      for (std::size_t n = 0; n < kFours; ++n) {
        const Mask& mask = fours[n][(bits >> (4 * n)) & 15u];
        for (std::size_t i = 0; i < kParts; ++i) blocked[i] = hn::Or(blocked[i], part(mask, i));
      }
    }
  }
  return maskOf(blocked);
}

/// The directions that meet nothing any more beyond what is near.
HWY_INLINE Mask clearBeyondNear(const Group& group, const ClearBricks& clear, Voxel p) {
  const auto& leaving = group.walks.leaving;
  const auto& in_x = leaving[0][static_cast<std::size_t>(p.x % kSide)];
  const auto& in_y = leaving[1][static_cast<std::size_t>(p.y % kSide)];
  const auto& in_z = leaving[2][static_cast<std::size_t>(p.z % kSide)];
  Vector found[kParts];
  for (Vector& words : found) words = hn::Zero(Words());
  for (std::size_t y = group.lowest < 0 ? 0 : 1; y < 3; ++y) {
    for (std::size_t z = 0; z < 3; ++z) {
      for (std::size_t x = 0; x < 3; ++x) {
        const std::uint64_t* const row = clear.ofBrick(p / kSide + Voxel(x, y, z) - 1);
        for (std::size_t i = 0; i < kParts; ++i) {
          const Vector here = hn::And(hn::And(part(in_x[x], i), part(in_z[z], i)),
                                      hn::And(part(in_y[y], i), hn::LoadU(Words(), row + kLanes * i)));
          found[i] = hn::Or(found[i], here);
        }
      }
    }
  }
  return maskOf(found);
}

/// From where the legs end, run by run, with a look ahead after each. Most runs lie among empty bricks, and
/// then no voxel of them is read.
HWY_INLINE bool walkOn(const BitVolume& occupied, const Group& group, const ClearBricks& clear, Voxel p,
                       std::size_t i) {
  const LatticeDirection& direction = group.directions[i];
  const Walks& walks = group.walks;
  const std::size_t period = direction.crossed.size(), done = walks.rays[i].near + kSteps;
  const std::uint64_t* const words = occupied.words().data();
  const std::int64_t* const steps = walks.period_steps.data() + walks.first_step[i];
  const std::uint32_t* const runs = walks.runs.data() + walks.first_run[i];
  std::size_t k = done % period;
  const std::uint32_t* run = runs;
  while (run[1] <= k) ++run;
  Voxel base = p + static_cast<int>(done / period) * direction.v;
  std::ptrdiff_t start = (occupied.row(base.y, base.z) - words) * BitVolume::kWordBits + base.x;
  for (int left = periodsInside(occupied.size(), base, direction.v); left > 0; --left) {
    for (; k < period; k = *++run) {
      if (clear.mayMeet(direction.v, base + direction.crossed[k]) &&
          anyOfRun(words, start, steps + k, run[1] - k))
        return false;
      if (clear.isInside(i, base + direction.crossed[run[1] - 1])) return true;
    }
    k = 0;
    run = runs;
    base += direction.v;
    start += steps[period - 1];
  }
  for (; k < period; ++k) {
    const Voxel q = base + direction.crossed[k];
    if (!contains(occupied.size(), q)) return true;
    if (occupied.at(q)) return false;
  }
  return true;
}

/// What the legs are walked in.
struct Around {
  const std::uint64_t* words;
  std::ptrdiff_t start;                  // the place, in bits from the first word
  bool rim;                              // a step may lie above, below, before or behind the world
  std::size_t up, down, before, behind;  // voxels from the place to the rim
};

/// Whether one of the leg's first steps, those before `within`, is occupied.
HWY_INLINE bool hits(const Around& around, const Ray& ray, std::size_t within, std::size_t leg) {
  for (std::size_t s = kLegs[leg - 1]; s < kLegs[leg]; s += kAtOnce) {
    const std::int64_t* const steps = ray.steps.data() + s;
    if (within >= s + kAtOnce ? anyOf<false>(around.words, around.start, steps, kAtOnce)
                              : anyOf<true>(around.words, around.start, steps, within > s ? within - s : 0))
      return true;
  }
  return false;
}

template <bool kRim>
HWY_INLINE std::uint64_t walkLegs(const BitVolume& occupied, const Group& group, const ClearBricks& clear,
                                  const Around& around, Voxel p, std::size_t first, std::uint64_t ask) {
  std::uint64_t found = 0;
  for (std::size_t leg = 1; leg < kLegs.size() && ask != 0; ++leg) {
    std::uint64_t next = 0;
    for (; ask != 0; ask &= ask - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(ask));
      const Ray& ray = group.walks.rays[first + i];
      std::size_t within = kSteps;
      if (kRim) {
        const Voxel v = group.directions[first + i].v;
        within = std::min(ray.within_y[v.y < 0 ? around.down : around.up],
                          ray.within_z[v.z < 0 ? around.before : around.behind]);
      }
      const std::uint64_t free = hits(around, ray, within, leg) ? 0 : 1;
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

/// Calls beyond(p, blocked, open) for the places, with the directions that are blocked near them.
template <class Beyond>
HWY_INLINE void lookFromEach(const BitVolume& occupied, const Group& group, std::span<const Voxel> places,
                             std::uint64_t* open, std::size_t stride, Beyond beyond) {
  const std::size_t columns = (group.directions.size() + 63) / 64;
  for (std::size_t n = 0; n < places.size(); ++n, open += stride) {
    if (n > 0 && places[n] == places[n - 1]) {  // a node's buds
      std::copy_n(open - stride, columns, open);
    } else {
      beyond(places[n], blockedNear(occupied, group, places[n]), open);
    }
  }
}

void Look(const BitVolume& occupied, const Group& group, const ClearBricks& clear,
          std::span<const Voxel> places, std::uint64_t* open, std::size_t stride) {
  const Voxel size = occupied.size();
  const auto capped = [](int voxels) { return static_cast<std::size_t>(std::min(voxels, kFar - 1)); };
  lookFromEach(occupied, group, places, open, stride, [&](Voxel p, const Mask& blocked, std::uint64_t* row) {
    const Mask at_once = clearBeyondNear(group, clear, p);
    Around around{occupied.words().data(), 0, false, capped(size.y - 1 - p.y), capped(p.y), capped(p.z),
                  capped(size.z - 1 - p.z)};
    around.start = (occupied.row(p.y, p.z) - around.words) * BitVolume::kWordBits + p.x;
    around.rim = std::min({around.up, around.down, around.before, around.behind}) < kFar - 1;
    for (std::size_t k = 0; 64 * k < group.directions.size(); ++k) {
      const std::uint64_t unblocked = unblockedIn(group, blocked, k);
      const std::uint64_t ask = unblocked & ~at_once.words[k];
      row[k] = (unblocked & at_once.words[k]) |
               (around.rim ? walkLegs<true>(occupied, group, clear, around, p, 64 * k, ask)
                           : walkLegs<false>(occupied, group, clear, around, p, 64 * k, ask));
    }
  });
}

void LookFar(const BitVolume& occupied, const Group& group, const FilledAhead& ahead,
             std::span<const Voxel> places, std::uint64_t* open, std::size_t stride) {
  lookFromEach(occupied, group, places, open, stride, [&](Voxel p, const Mask& blocked, std::uint64_t* row) {
    lookFar(occupied, group, ahead, p, blocked, row);
  });
}

void SumRows(const float* rows, std::size_t apart, std::span<const std::uint32_t> chosen, float* sums) {
  const hn::ScalableTag<float> d;
  constexpr std::size_t kVectors = 8;  // of sums, in registers
  static_assert(kVectors * HWY_LANES(float) <= kRowUnit);
  for (std::size_t at = 0; at < apart; at += kVectors * hn::Lanes(d)) {
    hn::Vec<decltype(d)> all[kVectors];
    for (auto& sum : all) sum = hn::Zero(d);
    for (const std::uint32_t row : chosen) {
      const float* const from = rows + row * apart + at;
      for (std::size_t i = 0; i < kVectors; ++i)
        all[i] = hn::Add(all[i], hn::LoadU(d, from + i * hn::Lanes(d)));
    }
    for (std::size_t i = 0; i < kVectors; ++i) hn::StoreU(all[i], d, sums + at + i * hn::Lanes(d));
  }
}

using Line = hn::ScalableTag<std::uint64_t>;  // words that lie at any byte

HWY_INLINE hn::Vec<Line> wordsAt(const std::uint8_t* bytes) {
#if HWY_TARGET == HWY_SCALAR
  std::uint64_t word;
  hwy::CopyBytes<sizeof(word)>(bytes, &word);
  return hn::Set(Line(), word);
#else
  return hn::BitCast(Line(), hn::LoadU(hn::Repartition<std::uint8_t, Line>(), bytes));
#endif
}

HWY_INLINE void putWords(hn::Vec<Line> words, std::uint8_t* bytes) {
#if HWY_TARGET == HWY_SCALAR
  const std::uint64_t word = hn::GetLane(words);
  hwy::CopyBytes<sizeof(word)>(&word, bytes);
#else
  const hn::Repartition<std::uint8_t, Line> d;
  hn::StoreU(hn::BitCast(d, words), d, bytes);
#endif
}

template <bool kDown>
HWY_INLINE void uniteLine(std::uint8_t* target, const std::uint8_t* source, std::size_t bytes,
                          std::span<const Step> steps) {
  const Line d;
  constexpr std::size_t kBytes = HWY_LANES(std::uint64_t) * sizeof(std::uint64_t);
  static_assert(kBytes <= kMostBytesAtOnce);
  for (std::size_t at = 0; at < bytes; at += kBytes) {
    auto all = hn::Zero(d);
    for (const Step& step : steps) {
      const auto read = wordsAt(source + step.bytes + static_cast<std::ptrdiff_t>(at));
      const auto shifted = kDown ? hn::ShiftRightSame(read, step.down) : hn::ShiftLeftSame(read, -step.down);
      all = hn::Or(all, hn::And(shifted, hn::Set(d, step.mask)));
    }
    putWords(all, target + at);
  }
}

void UniteSteps(std::uint8_t* target, std::size_t target_apart, const std::uint8_t* source,
                std::size_t source_apart, int lines, std::size_t bytes, std::span<const Step> steps) {
  const bool down = std::all_of(steps.begin(), steps.end(), [](const Step& step) { return step.down >= 0; });
  for (int line = 0; line < lines; ++line, target += target_apart, source += source_apart) {
    std::size_t inside = 0;
    while (inside < steps.size() && line + steps[inside].lines >= 0 && line + steps[inside].lines < lines)
      ++inside;
    down ? uniteLine<true>(target, source, bytes, steps.first(inside))
         : uniteLine<false>(target, source, bytes, steps.first(inside));
  }
}

}  // namespace espalier::sim::looking::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier::sim::looking {

HWY_EXPORT(Look);
HWY_EXPORT(LookFar);
HWY_EXPORT(UniteSteps);
HWY_EXPORT(SumRows);

void look(const BitVolume& occupied, const Group& group, const ClearBricks& clear,
          std::span<const Voxel> places, std::uint64_t* open, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(Look)(occupied, group, clear, places, open, stride);
}

void look(const BitVolume& occupied, const Group& group, const FilledAhead& ahead,
          std::span<const Voxel> places, std::uint64_t* open, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(LookFar)(occupied, group, ahead, places, open, stride);
}

void uniteSteps(std::uint8_t* target, std::size_t target_apart, const std::uint8_t* source,
                std::size_t source_apart, int lines, std::size_t bytes, std::span<const Step> steps) {
  HWY_DYNAMIC_DISPATCH(UniteSteps)(target, target_apart, source, source_apart, lines, bytes, steps);
}

void sumRows(const float* rows, std::size_t apart, std::span<const std::uint32_t> chosen, float* sums) {
  HWY_DYNAMIC_DISPATCH(SumRows)(rows, apart, chosen, sums);
}

}  // namespace espalier::sim::looking
#endif
