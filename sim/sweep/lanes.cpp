#include "sim/sweep/lanes.h"

#include <algorithm>
#include <bit>

// With the double shifts of Ice Lake and Zen 4.
#define HWY_WANT_AVX3_DL

// Vectors whose length is known when compiling: they are kept in arrays.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/sweep/lanes.cpp"
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

HWY_INLINE bool holdsAnything(const Word* block) {
  const Words d;
  Vector all = hn::Load(d, block);
  for (std::size_t i = hn::Lanes(d); i < kRows; i += hn::Lanes(d)) all = hn::Or(all, hn::Load(d, block + i));
  return !hn::AllTrue(d, hn::Eq(all, hn::Zero(d)));
}

constexpr std::size_t kMostReads = 256;
constexpr std::size_t kWordsAtOnce = 4;

/// The reads that hold anything for a block of rows.
struct Listed {
  std::uint8_t reads[kMostReads];
  std::size_t count = 0;
};

/// One block of kWords lines, from word `at` on. Returns which of the lines hold anything.
template <std::size_t kWords>
HWY_INLINE unsigned uniteBlock(const Read* reads, const Listed& listed, std::size_t line, Word* out,
                               std::size_t at) {
  const Words d;
  unsigned filled = 0;
  for (std::size_t end = at + kRows; at < end; at += hn::Lanes(d)) {
    Vector all[kWords];
    for (std::size_t i = 0; i < kWords; ++i) all[i] = hn::Zero(d);
    for (std::size_t k = 0; k < listed.count; ++k) {
      const Read& read = reads[listed.reads[k]];
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
    for (std::size_t i = 0; i < kWords; ++i) {
      hn::Store(all[i], d, out + at + i * line);
      if (!hn::AllTrue(d, hn::Eq(all[i], hn::Zero(d)))) filled |= 1u << i;
    }
  }
  return filled;
}

/// The blocks of lines w .. w + kWords - 1 for which a read has a flag.
template <std::size_t kWords>
HWY_INLINE Blocks flagged(const Read& read, Flags flags, std::size_t flag_line, std::size_t w) {
  Blocks low = 0, high = 0;
  for (std::size_t i = 0; i < kWords + (read.count == 0 ? 0 : 1); ++i) {
    const Blocks* const at = flags.word + (w + i) * flag_line;
    low |= at[0];
    high |= at[1];
  }
  const Blocks here = (low >> flags.first) | (high << 1 << (63 - flags.first));
  return read.astride ? here | (here >> 1) : here;
}

HWY_INLINE std::size_t lowest(Blocks blocks) {
  return hwy::Num0BitsBelowLS1Bit_Nonzero64(blocks);
}

/// Says of lines w, w + 1 .. whether their block holds anything.
template <std::size_t kWords>
HWY_INLINE void say(Blocks* filled, std::size_t w, std::size_t block, unsigned holding) {
  for (std::size_t i = 0; i < kWords; ++i)
    filled[w + i] = (filled[w + i] & ~(Blocks{1} << block)) | (Blocks{(holding >> i) & 1u} << block);
}

/// Does anew those blocks of a period's union of which anything read has changed.
template <std::size_t kWords>
HWY_INLINE void unitePeriod(std::span<const Read> reads, Lines lines, Slice period, std::size_t w,
                            Blocks wanted) {
  Blocks changed = 0;
  for (const Read& read : reads) changed |= flagged<kWords>(read, read.changed, lines.blocks, w);
  changed &= wanted;
  if (changed == 0) return;
  Listed listed[kMostBlocks];
  for (std::size_t r = 0; r < reads.size(); ++r) {
    Blocks filled = changed & flagged<kWords>(reads[r], reads[r].filled, lines.blocks, w);
    for (; filled != 0; filled &= filled - 1) {
      Listed& of_block = listed[lowest(filled)];
      of_block.reads[of_block.count++] = static_cast<std::uint8_t>(r);
    }
  }
  for (; changed != 0; changed &= changed - 1) {
    const std::size_t block = lowest(changed);
    say<kWords>(period.filled, w, block,
                uniteBlock<kWords>(reads.data(), listed[block], lines.words, period.words,
                                   w * lines.words + kRows * block));
  }
}

/// What a period blocks, and what is blocked at its end.
template <std::size_t kWords>
HWY_INLINE void addEnd(const Read* end, Lines lines, Slice period, Slice out, std::size_t w, Blocks wanted) {
  const Words d;
  const Blocks beyond = end == nullptr ? 0 : wanted & flagged<kWords>(*end, end->filled, lines.blocks, w);
  Blocks touched = beyond;
  for (std::size_t i = 0; i < kWords; ++i) touched |= period.filled[w + i] | out.filled[w + i];
  for (; touched != 0; touched &= touched - 1) {
    const std::size_t block = lowest(touched);
    const bool with_end = ((beyond >> block) & 1u) != 0;
    unsigned holding = 0;
    for (std::size_t at = w * lines.words + kRows * block, stop = at + kRows; at < stop; at += hn::Lanes(d)) {
      Vector words[kWords + 1];
      if (with_end) {
        for (std::size_t i = 0; i <= kWords; ++i) words[i] = hn::LoadU(d, end->from + at + i * lines.words);
      }
      for (std::size_t i = 0; i < kWords; ++i) {
        Vector all = hn::Load(d, period.words + at + i * lines.words);
        if (with_end)
          all = hn::Or(all, end->unmoved ? words[i] : funnel(words[i], words[i + 1], *end->shifts));
        hn::Store(all, d, out.words + at + i * lines.words);
        if (!hn::AllTrue(d, hn::Eq(all, hn::Zero(d)))) holding |= 1u << i;
      }
    }
    say<kWords>(out.filled, w, block, holding);
  }
}

template <std::size_t kWords>
HWY_INLINE void uniteLines(std::span<const Read> reads, const Read* end, Lines lines, Slice period, Slice out,
                           std::size_t w, std::size_t blocks) {
  const Blocks wanted = (Blocks{1} << blocks) - 1;
  unitePeriod<kWords>(reads, lines, period, w, wanted);
  addEnd<kWords>(end, lines, period, out, w, wanted);
}

void Unite(std::span<const Read> reads, const Read* end, Lines lines, Slice period, Slice out,
           std::size_t words, std::size_t blocks) {
  for (std::size_t w = 0; w < words; w += kWordsAtOnce) {
    switch (words - w) {
      case 1:
        uniteLines<1>(reads, end, lines, period, out, w, blocks);
        break;
      case 2:
        uniteLines<2>(reads, end, lines, period, out, w, blocks);
        break;
      case 3:
        uniteLines<3>(reads, end, lines, period, out, w, blocks);
        break;
      default:
        uniteLines<4>(reads, end, lines, period, out, w, blocks);
    }
  }
}

Blocks AnythingIn(const Word* line, std::size_t blocks) {
  Blocks filled = 0;
  for (std::size_t block = 0; block < blocks; ++block)
    filled |= Blocks{holdsAnything(line + kRows * block)} << block;
  return filled;
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

void unite(std::span<const Read> reads, const Read* end, Lines lines, Slice period, Slice out,
           std::size_t words, std::size_t blocks) {
  HWY_DYNAMIC_DISPATCH(Unite)(reads, end, lines, period, out, words, blocks);
}

Blocks anythingIn(const Word* line, std::size_t blocks) {
  return HWY_DYNAMIC_DISPATCH(AnythingIn)(line, blocks);
}

Blocks differing(const Word* line, const Word* other, std::size_t blocks) {
  Blocks different = 0;
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t at = kRows * block;
    different |= Blocks{!std::equal(line + at, line + at + kRows, other + at)} << block;
  }
  return different;
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
  std::int64_t upto = 0;  // it and all below: not every module is made for every one
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (upto != 0 || name == hwy::TargetName(target)) upto |= target;
  }
  hwy::SetSupportedTargetsForTest(upto);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace espalier::sim::lanes
#endif
