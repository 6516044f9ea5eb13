#include "sim/lanes.h"

#include <algorithm>
#include <bit>

// With the double shifts of Ice Lake and Zen 4.
#define HWY_WANT_AVX3_DL

// Vectors whose length is known when compiling: they are kept in arrays.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/lanes.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace espalier::sim::lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Words = hn::ScalableTag<std::uint64_t>;
using Vector = hn::Vec<Words>;

/// Bits `shift` .. 63 of low, then bits 0 .. shift - 1 of high.
HWY_INLINE Vector funnel(Vector low, Vector high, std::uint64_t shift) {
  const Words d;
#if HWY_TARGET == HWY_AVX3_DL
  return Vector{_mm512_shrdv_epi64(low.raw, high.raw, hn::Set(d, shift).raw)};
#else
  const Vector count = hn::Set(d, shift);
  return hn::Or(hn::Shr(low, count), hn::Shl(high, hn::Sub(hn::Set(d, std::uint64_t{64}), count)));
#endif
}

HWY_INLINE std::size_t lowest(Blocks blocks) {
  return hwy::Num0BitsBelowLS1Bit_Nonzero64(blocks);
}

HWY_INLINE bool holdsAnything(const Word* block) {
  const Words d;
  Vector all = hn::Load(d, block);
  for (std::size_t i = hn::Lanes(d); i < kRows; i += hn::Lanes(d)) all = hn::Or(all, hn::Load(d, block + i));
  return !hn::AllTrue(d, hn::Eq(all, hn::Zero(d)));
}

HWY_INLINE Blocks thatHoldAnything(const Word* line, Blocks blocks) {
  Blocks filled = 0;
  for (Blocks left = blocks; left != 0; left &= left - 1) {
    if (holdsAnything(line + kRows * lowest(left))) filled |= left & (~left + 1);
  }
  return filled;
}

/// Lines w .. w + kWords - 1, all blocks.
template <std::size_t kWords>
HWY_INLINE void uniteDense(std::span<const Read> reads, std::size_t line, Word* out, std::size_t w,
                           std::size_t blocks) {
  const Words d;
  for (std::size_t z = 0; z < blocks * kRows; z += hn::Lanes(d)) {
    const std::size_t at = w * line + z;
    Vector all[kWords];
    for (std::size_t i = 0; i < kWords; ++i) all[i] = hn::Zero(d);
    for (const Read& read : reads) {
      const Word* const from = read.from + at;
      Vector words[kWords + 1];
      for (std::size_t i = 0; i <= kWords; ++i) words[i] = hn::LoadU(d, from + i * line);
      if (read.unmoved) {
        for (std::size_t i = 0; i < kWords; ++i) all[i] = hn::Or(all[i], words[i]);
      }
      for (std::uint32_t s = 0; s < read.count; ++s) {
        for (std::size_t i = 0; i < kWords; ++i)
          all[i] = hn::Or(all[i], funnel(words[i], words[i + 1], read.shifts[s]));
      }
    }
    for (std::size_t i = 0; i < kWords; ++i) hn::Store(all[i], d, out + at + i * line);
  }
}

/// Line w, block by block where reads[r] has anything in the blocks filled[r].
HWY_INLINE void uniteSparse(std::span<const Read> reads, const Blocks* filled, Blocks touched,
                            std::size_t line, Word* out, std::size_t w) {
  const Words d;
  const std::size_t n = hn::Lanes(d);
  for (Blocks left = touched; left != 0; left &= left - 1) {
    Word* const block = out + w * line + kRows * lowest(left);
    for (std::size_t i = 0; i < kRows; i += n) hn::Store(hn::Zero(d), d, block + i);
  }
  for (std::size_t r = 0; r < reads.size(); ++r) {
    const Read& read = reads[r];
    const auto forEachVector = [&](const auto& add) {
      for (Blocks left = filled[r]; left != 0; left &= left - 1) {
        const std::size_t first = w * line + kRows * lowest(left);
        for (std::size_t at = first; at < first + kRows; at += n) {
          const Vector low = hn::LoadU(d, read.from + at), high = hn::LoadU(d, read.from + line + at);
          hn::Store(add(hn::Load(d, out + at), low, high), d, out + at);
        }
      }
    };
    if (read.count == 1 && !read.unmoved) {  // by far the most common
      const std::uint64_t shift = *read.shifts;
      forEachVector(
          [&](Vector all, Vector low, Vector high) { return hn::Or(all, funnel(low, high, shift)); });
    } else {
      forEachVector([&](Vector all, Vector low, Vector high) {
        if (read.unmoved) all = hn::Or(all, low);
        for (std::uint32_t s = 0; s < read.count; ++s) all = hn::Or(all, funnel(low, high, read.shifts[s]));
        return all;
      });
    }
  }
}

constexpr std::size_t kMostReads = 256;
constexpr std::size_t kWordsAtOnce = 4;

void Unite(std::span<const Read> reads, Lines lines, Word* out, std::size_t words, std::size_t blocks,
           Blocks* filled) {
  const Blocks wanted = (Blocks{1} << blocks) - 1;
  Blocks sources[kWordsAtOnce][kMostReads];
  for (std::size_t w = 0; w < words; w += kWordsAtOnce) {
    const std::size_t n = words - w < kWordsAtOnce ? words - w : kWordsAtOnce;
    std::size_t sum = 0;
    for (std::size_t r = 0; r < reads.size(); ++r) {
      const Read& read = reads[r];
      const auto line = [&](std::size_t i) {
        const Blocks* const at = read.filled + (w + i) * lines.blocks;
        const Blocks here = (at[0] >> read.first) | (at[1] << 1 << (63 - read.first));
        return read.astride ? here | (here >> 1) : here;
      };
      Blocks low = line(0);
      for (std::size_t i = 0; i < n; ++i) {
        const Blocks high = read.count == 0 ? 0 : line(i + 1);
        sources[i][r] = (low | high) & wanted;
        sum += hwy::PopCount(sources[i][r]);
        low = read.count == 0 ? line(i + 1) : high;
      }
    }
    if (5 * sum > 2 * reads.size() * n * blocks) {
      switch (n) {
        case 1:
          uniteDense<1>(reads, lines.words, out, w, blocks);
          break;
        case 2:
          uniteDense<2>(reads, lines.words, out, w, blocks);
          break;
        case 3:
          uniteDense<3>(reads, lines.words, out, w, blocks);
          break;
        default:
          uniteDense<4>(reads, lines.words, out, w, blocks);
      }
      for (std::size_t i = 0; i < n; ++i)
        filled[w + i] = thatHoldAnything(out + (w + i) * lines.words, wanted);
    } else {
      for (std::size_t i = 0; i < n; ++i) {
        Blocks touched = filled[w + i];
        for (std::size_t r = 0; r < reads.size(); ++r) touched |= sources[i][r];
        uniteSparse(reads, sources[i], touched, lines.words, out, w + i);
        filled[w + i] = thatHoldAnything(out + (w + i) * lines.words, touched);
      }
    }
  }
}

Blocks AnythingIn(const Word* line, std::size_t blocks) {
  return thatHoldAnything(line, (Blocks{1} << blocks) - 1);
}

/// sum = a + b + c modulo 2, and what is carried.
HWY_INLINE Vector addThree(Vector& sum, Vector b, Vector c) {
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
  const Vector carry{_mm512_ternarylogic_epi64(sum.raw, b.raw, c.raw, 0xE8)};
  sum = Vector{_mm512_ternarylogic_epi64(sum.raw, b.raw, c.raw, 0x96)};
  return carry;
#else
  const Vector differ = hn::Xor(sum, b);
  const Vector carry = hn::Or(hn::And(sum, b), hn::And(differ, c));
  sum = hn::Xor(differ, c);
  return carry;
#endif
}

constexpr std::size_t kPlanes = 16;

/// 64 sums from the bits of one word in each of the planes.
HWY_INLINE void unpack(const Word (*planes)[kRows], std::size_t word, std::uint16_t* sums) {
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t i = 0; i < 64; ++i) {
    unsigned sum = 0;
    for (std::size_t p = 0; p < kPlanes; ++p) sum |= static_cast<unsigned>((planes[p][word] >> i) & 1u) << p;
    sums[i] = static_cast<std::uint16_t>(sum);
  }
#else
  const hn::ScalableTag<std::uint8_t> d8;
  const std::size_t n = hn::Lanes(d8);
  std::uint8_t bits[kPlanes][16] = {};  // LoadMaskBits reads eight bytes from where it starts
  for (std::size_t p = 0; p < kPlanes; ++p) hwy::CopyBytes<8>(&planes[p][word], bits[p]);
  auto* const bytes = reinterpret_cast<std::uint8_t*>(sums);
  for (std::size_t i = 0; i < 64; i += n) {
    auto low = hn::Zero(d8), high = hn::Zero(d8);
    for (std::size_t p = 0; p < 8; ++p) {
      const auto weight = hn::Set(d8, static_cast<std::uint8_t>(1u << p));
      low = hn::Or(low, hn::IfThenElseZero(hn::LoadMaskBits(d8, bits[p] + i / 8), weight));
      high = hn::Or(high, hn::IfThenElseZero(hn::LoadMaskBits(d8, bits[p + 8] + i / 8), weight));
    }
    hn::StoreInterleaved2(low, high, d8, bytes + 2 * i);
  }
#endif
}

/// One vector of words: all planes, from the lowest up. Four inputs at a time leave one carry for the plane
/// after the next, which is kept until its turn comes.
HWY_INLINE void addColumn(std::span<const std::uint32_t> inputs,
                          std::span<const std::uint32_t> first_of_plane, const Word* const* rows,
                          std::size_t at, std::vector<Word>& carried, Word (*planes)[kRows],
                          std::size_t column) {
  const Words d;
  const std::size_t n = hn::Lanes(d);
  const std::size_t room = carried.size() / 3;  // for the carries to a plane; three are in use at a time
  std::size_t count[3] = {0, 0, 0};
  Vector ones = hn::Zero(d);
  for (std::size_t plane = 0; plane < kPlanes; ++plane) {
    Vector twos = hn::Zero(d);
    Word* const mine = carried.data() + plane % 3 * room;
    Word* const later = carried.data() + (plane + 2) % 3 * room;
    std::size_t& later_count = count[(plane + 2) % 3];
    later_count = 0;
    const auto addFour = [&](Vector a, Vector b, Vector c, Vector e) {
      const Vector first = addThree(ones, a, b);
      const Vector second = addThree(ones, c, e);
      const Vector fours = addThree(twos, first, second);
      hn::StoreU(fours, d, later + n * later_count++);
    };
    std::size_t i = plane + 1 < first_of_plane.size() ? first_of_plane[plane] : 0;
    const std::size_t end = plane + 1 < first_of_plane.size() ? first_of_plane[plane + 1] : 0;
    const auto input = [&](std::size_t k) { return hn::LoadU(d, rows[inputs[k]] + at); };
    for (; i + 4 <= end; i += 4) addFour(input(i), input(i + 1), input(i + 2), input(i + 3));
    const Vector none = hn::Zero(d);
    if (i < end) {
      addFour(input(i), i + 1 < end ? input(i + 1) : none, i + 2 < end ? input(i + 2) : none, none);
    }
    const std::size_t carries = count[plane % 3];
    const auto carry = [&](std::size_t k) { return k < carries ? hn::LoadU(d, mine + n * k) : none; };
    for (std::size_t k = 0; k < carries; k += 4) addFour(carry(k), carry(k + 1), carry(k + 2), carry(k + 3));
    hn::StoreU(ones, d, planes[plane] + column);
    ones = twos;
  }
}

void Sums(std::span<const std::uint32_t> inputs, std::span<const std::uint32_t> first_of_plane,
          const Word* const* rows, std::size_t at, std::vector<Word>& carried, std::uint16_t* sums) {
  const Words d;
  const std::size_t n = hn::Lanes(d);
  static_assert(HWY_MAX_BYTES <= kRows * sizeof(Word));
  HWY_ALIGN Word planes[kPlanes][kRows];
  for (std::size_t column = 0; column < kRows; column += n)
    addColumn(inputs, first_of_plane, rows, at + column, carried, planes, column);
  for (std::size_t word = 0; word < kRows; ++word) unpack(planes, word, sums + 64 * word);
}

}  // namespace espalier::sim::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier::sim::lanes {

HWY_EXPORT(Unite);
HWY_EXPORT(AnythingIn);
HWY_EXPORT(Sums);

void unite(std::span<const Read> reads, Lines lines, Word* out, std::size_t words, std::size_t blocks,
           Blocks* filled) {
  HWY_DYNAMIC_DISPATCH(Unite)(reads, lines, out, words, blocks, filled);
}

Blocks anythingIn(const Word* line, std::size_t blocks) {
  return HWY_DYNAMIC_DISPATCH(AnythingIn)(line, blocks);
}

Adders::Adders(std::span<const std::uint16_t> weights) {
  unsigned all = 0;
  for (const std::uint16_t weight : weights) all |= weight;
  for (unsigned plane = 0; all >> plane != 0; ++plane) {
    first_of_plane_.push_back(static_cast<std::uint32_t>(inputs_.size()));
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (((weights[i] >> plane) & 1u) != 0) inputs_.push_back(static_cast<std::uint32_t>(i));
    }
  }
  first_of_plane_.push_back(static_cast<std::uint32_t>(inputs_.size()));
}

void Adders::sums(const Word* const* inputs, std::size_t at, std::uint16_t* sums) const {
  thread_local std::vector<Word> carried;
  // At most a quarter of a plane's inputs and carries is carried on, a third in all; eight words each.
  carried.resize(std::max(carried.size(), 3 * kRows * (inputs_.size() / 3 + 2 * 16)));
  HWY_DYNAMIC_DISPATCH(Sums)(inputs_, first_of_plane_, inputs, at, carried, sums);
}

void transpose(Word square[64]) {
  Word mask = 0x00000000ffffffffu;
  for (unsigned step = 32; step != 0; step >>= 1, mask ^= mask << step) {
    for (unsigned block = 0; block < 64; block += 2 * step) {
      for (unsigned i = block; i < block + step; ++i) {
        const Word swap = ((square[i] >> step) ^ square[i + step]) & mask;
        square[i] ^= swap << step;
        square[i + step] ^= swap;
      }
    }
  }
}

namespace {
std::int64_t supported() {
  std::int64_t all = 0;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) all |= target;
  return all;
}
}  // namespace

std::string level() {
  const auto target = static_cast<std::uint64_t>(supported());
  return hwy::TargetName(static_cast<std::int64_t>(target & (~target + 1)));  // the lowest bit is the best
}

std::vector<std::string> levels() {
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    names.emplace_back(hwy::TargetName(target));
  return names;
}

void useLevel(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (name == hwy::TargetName(target)) hwy::SetSupportedTargetsForTest(target);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace espalier::sim::lanes
#endif
