#include "sim/base/bits.h"

#include <bit>
#include <cassert>

#include "sim/base/parallel.h"

namespace espalier::sim {

std::size_t BitVolume::count() const {
  std::size_t total = 0;
  for (const std::uint64_t word : words_) total += static_cast<std::size_t>(std::popcount(word));
  return total;
}

void BitVolume::add(const BitVolume& more) {
  assert(more.size_ == size_);
  parallelFor(words_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) words_[i] |= more.words_[i];
  });
}

void BitVolume::keep(const BitVolume& only) {
  assert(only.size_ == size_);
  parallelFor(words_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) words_[i] &= only.words_[i];
  });
}

void BitVolume::remove(const BitVolume& these) {
  assert(these.size_ == size_);
  parallelFor(words_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) words_[i] &= ~these.words_[i];
  });
}

}  // namespace espalier::sim
