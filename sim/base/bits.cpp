#include "sim/base/bits.h"

#include <bit>

namespace espalier::sim {

std::size_t BitVolume::count() const {
  std::size_t total = 0;
  for (const std::uint64_t word : words_) total += static_cast<std::size_t>(std::popcount(word));
  return total;
}

}  // namespace espalier::sim
