#include "sim/sweep/slice_ring.h"

#include <algorithm>
#include <atomic>

namespace espalier::sim {

using lanes::Blocks;

void BlockFlags::flip(int number, std::size_t w, std::size_t first, Blocks flipped) {
  const auto [word, bit] = from(number, static_cast<std::ptrdiff_t>(first));
  Blocks* const at = flags_.data() + (word - flags_.data()) + w * layout_.flagLine();
  // A word may hold blocks of two threads, each of which changes its own.
  const auto change = [](Blocks& blocks, Blocks bits) {
    if (bits != 0) std::atomic_ref(blocks).fetch_xor(bits, std::memory_order_relaxed);
  };
  change(at[0], flipped << bit);
  change(at[1], flipped >> 1 >> (63 - bit));
}

SliceRing::SliceRing(const SliceLayout& layout, int slots)
    : layout_(layout),
      slots_(slots),
      words_(hwy::AllocateAligned<lanes::Word>(layout.slice() * static_cast<std::size_t>(slots))),
      filled_(layout, slots) {
  if (!words_) throw std::bad_alloc();
  std::fill_n(words_.get(), layout.slice() * static_cast<std::size_t>(slots), lanes::Word{0});
}

void SliceRing::look(int number, std::size_t w) {
  const lanes::Word* const line = slice(number) + w * layout_.line();
  for (std::size_t first = 0; first < layout_.blocks; first += lanes::kMostBlocks) {
    const std::size_t count = std::min(lanes::kMostBlocks, layout_.blocks - first);
    filled_.flip(
        number, w, first,
        filled_.get(number, w, first, count) ^ lanes::anythingIn(line + first * lanes::kRows, count));
  }
}

}  // namespace espalier::sim
