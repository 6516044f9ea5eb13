// The numbers of Slots (random.h) for many trials at once, one in each lane of a SIMD vector. Included once
// for every instruction set, after hwy/highway.h, by files that hwy/foreach_target.h compiles.
#if defined(ESPALIER_SIM_BASE_RANDOM_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SIM_BASE_RANDOM_LANES_INL_H
#undef ESPALIER_SIM_BASE_RANDOM_LANES_INL_H
#else
#define ESPALIER_SIM_BASE_RANDOM_LANES_INL_H
#endif

#include <cstdint>

#include "sim/base/random.h"

HWY_BEFORE_NAMESPACE();
namespace espalier::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class Words>
struct FourNumbers {
  hn::Vec<Words> of[4];
};

/// High and low halves of a product of 32 bits by 32.
template <class Words, class V = hn::Vec<Words>>
HWY_INLINE void multiply(Words d, V a, std::uint32_t factor, V& high, V& low) {
#if HWY_TARGET == HWY_SCALAR
  const std::uint64_t product = std::uint64_t{hn::GetLane(a)} * factor;
  high = hn::Set(d, static_cast<std::uint32_t>(product >> 32));
  low = hn::Set(d, static_cast<std::uint32_t>(product));
#else
  const hn::RepartitionToWide<Words> wide;
  const V b = hn::Set(d, factor);
  const auto even = hn::MulEven(a, b);
  const auto odd = hn::MulEven(hn::BitCast(d, hn::ShiftRight<32>(hn::BitCast(wide, a))), b);
  high = hn::OddEven(hn::BitCast(d, odd), hn::BitCast(d, hn::ShiftRight<32>(even)));
  low = hn::OddEven(hn::BitCast(d, hn::ShiftLeft<32>(odd)), hn::BitCast(d, even));
#endif
}

/// Slots 4 block .. 4 block + 3 of the trials whose counter's last words are given (PhiloxInput::counter[3],
/// without a block), by Philox4x32-10.
template <class Words, class V = hn::Vec<Words>>
HWY_INLINE FourNumbers<Words> fourNumbers(Words d, const PhiloxInput& input, V trials, unsigned block) {
  V a = hn::Set(d, input.counter[0]), b = hn::Set(d, input.counter[1]), c = hn::Set(d, input.counter[2]);
  V e = hn::Or(trials, hn::Set(d, block));
  std::uint32_t key0 = input.key[0], key1 = input.key[1];
  for (int round = 0; round < 10; ++round) {
    V high0, low0, high1, low1;
    multiply(d, a, 0xD2511F53u, high0, low0);
    multiply(d, c, 0xCD9E8D57u, high1, low1);
    a = hn::Xor(hn::Xor(high1, b), hn::Set(d, key0));
    b = low1;
    c = hn::Xor(hn::Xor(high0, e), hn::Set(d, key1));
    e = low0;
    key0 += 0x9E3779B9u;
    key1 += 0xBB67AE85u;
  }
  return {{a, b, c, e}};
}

/// As Slots::uniformFloat gives it.
template <class Floats, class V>
HWY_INLINE hn::Vec<Floats> uniformOf(Floats d, V bits) {
  const hn::RebindToSigned<Floats> whole;
  return hn::Mul(hn::ConvertTo(d, hn::BitCast(whole, hn::ShiftRight<8>(bits))), hn::Set(d, 0x1p-24f));
}

}  // namespace espalier::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
