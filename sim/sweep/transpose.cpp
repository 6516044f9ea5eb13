#include "sim/sweep/lanes.h"

// Vectors whose length is known when compiling.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/sweep/transpose.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace espalier::sim::lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Halves change places, then quarters, and so on: between vectors while whole vectors do, then within.
void Transpose(Word* square) {
  const hn::ScalableTag<Word> d;
  using Vector = hn::Vec<decltype(d)>;
  constexpr std::size_t kLanes = HWY_LANES(Word);
  Word mask = 0x00000000ffffffffu;
  std::size_t step = 32;
  for (; step >= kLanes; step /= 2, mask ^= mask << step) {
    const Vector kept = hn::Set(d, mask);
    for (std::size_t i = 0; i < 64; i += kLanes) {
      if ((i & step) != 0) continue;
      const Vector a = hn::Load(d, square + i), b = hn::Load(d, square + i + step);
      const Vector swap = hn::And(hn::Xor(hn::ShiftRightSame(a, static_cast<int>(step)), b), kept);
      hn::Store(hn::Xor(a, hn::ShiftLeftSame(swap, static_cast<int>(step))), d, square + i);
      hn::Store(hn::Xor(b, swap), d, square + i + step);
    }
  }
  for (; step != 0; step /= 2, mask ^= mask << step) {
    std::int64_t partners[kLanes];
    Word second[kLanes];
    for (std::size_t i = 0; i < kLanes; ++i) {
      partners[i] = static_cast<std::int64_t>(i ^ step);
      second[i] = i & step;
    }
    const auto partner = hn::SetTableIndices(d, partners);
    const auto is_second = hn::Ne(hn::LoadU(d, second), hn::Zero(d));
    const Vector low = hn::Set(d, mask), high = hn::Set(d, ~mask);
    for (std::size_t i = 0; i < 64; i += kLanes) {
      const Vector own = hn::Load(d, square + i), other = hn::TableLookupLanes(own, partner);
      const Vector first =
          hn::Or(hn::And(own, low), hn::And(hn::ShiftLeftSame(other, static_cast<int>(step)), high));
      const Vector last =
          hn::Or(hn::And(own, high), hn::And(hn::ShiftRightSame(other, static_cast<int>(step)), low));
      hn::Store(hn::IfThenElse(is_second, last, first), d, square + i);
    }
  }
}

}  // namespace espalier::sim::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier::sim::lanes {

HWY_EXPORT(Transpose);

void transpose(Word* square) {
  HWY_DYNAMIC_DISPATCH(Transpose)(square);
}

}  // namespace espalier::sim::lanes
#endif
