#pragma once
// Internal to the room: the last few slices of a sweep, laid out for vectors (sim/sweep/lanes.h).
#include <hwy/aligned_allocator.h>

#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "sim/sweep/lanes.h"

namespace espalier::sim {

/// How a slice lies in memory: lines of the words of one w, each behind enough zeros for a ray that looks
/// beyond the first row or, from the line before, beyond the last; a line of zeros on either side of them.
struct SliceLayout {
  std::size_t words;   ///< along x
  std::size_t blocks;  ///< of lanes::kRows rows
  std::size_t pad;     ///< words of zeros before each line: a multiple of lanes::kRows

  std::size_t line() const { return pad + blocks * lanes::kRows; }
  std::size_t slice() const { return (words + 2) * line() + pad; }
  /// Bits that say which blocks hold anything, with more than 64 zeros before and behind.
  std::size_t flagLine() const { return blocks / 64 + 4; }
  std::size_t flagSlice() const { return (words + 2) * flagLine(); }
};

/// A bit for each block of the last `slots` slices, numbered in the order of the sweep.
class BlockFlags {
 public:
  BlockFlags(const SliceLayout& layout, int slots)
      : layout_(layout), slots_(slots), flags_(layout.flagSlice() * static_cast<std::size_t>(slots)) {}

  /// Where line 0's flags from block `first` on begin: a word, and the bit in it. `first` may lie outside by
  /// fewer than 64 blocks. Lines are layout.flagLine() words apart; those of -1 and `words` stay zero.
  std::pair<const lanes::Blocks*, unsigned> from(int number, std::ptrdiff_t first) const {
    const auto bit = static_cast<std::size_t>(first + 64);
    return {flags_.data() + static_cast<std::size_t>(number % slots_) * layout_.flagSlice() +
                layout_.flagLine() + bit / 64,
            static_cast<unsigned>(bit % 64)};
  }
  /// The blocks first .. first + count - 1 of line w; count < 64.
  lanes::Blocks get(int number, std::size_t w, std::size_t first, std::size_t count) const {
    const auto [word, bit] = from(number, static_cast<std::ptrdiff_t>(first));
    const lanes::Blocks* const at = word + w * layout_.flagLine();
    return ((read(at[0]) >> bit) | (read(at[1]) << 1 << (63 - bit))) & ((lanes::Blocks{1} << count) - 1);
  }
  /// Changes the flags of the blocks first, first + 1 .. Threads may do so at once for different blocks.
  void flip(int number, std::size_t w, std::size_t first, lanes::Blocks flipped);

 private:
  /// Another thread may be changing other blocks of the word. (C++20 has no atomic_ref to what is const.)
  static lanes::Blocks read(const lanes::Blocks& blocks) {
    return std::atomic_ref(const_cast<lanes::Blocks&>(blocks)).load(std::memory_order_relaxed);
  }

  SliceLayout layout_;
  int slots_;
  std::vector<lanes::Blocks> flags_;
};

/// The last `slots` slices, and which of their blocks hold anything.
class SliceRing {
 public:
  SliceRing(const SliceLayout& layout, int slots);

  /// Word (0, 0) of a slice.
  lanes::Word* slice(int number) const {
    return words_.get() + static_cast<std::size_t>(number % slots_) * layout_.slice() + layout_.line() +
           layout_.pad;
  }
  int slots() const { return slots_; }
  const BlockFlags& filled() const { return filled_; }
  BlockFlags& filled() { return filled_; }
  /// Looks anew which blocks of line w hold anything.
  void look(int number, std::size_t w);

 private:
  SliceLayout layout_;
  int slots_;
  hwy::AlignedFreeUniquePtr<lanes::Word[]> words_;
  BlockFlags filled_;
};

}  // namespace espalier::sim
