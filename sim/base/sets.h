#pragma once
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace espalier::sim {

/// Sets of numbers that grow together, each called by the least of its numbers.
class Sets {
 public:
  explicit Sets(std::size_t count = 0) : over_(count) { std::iota(over_.begin(), over_.end(), 0u); }

  std::uint32_t of(std::size_t item) {
    auto at = static_cast<std::uint32_t>(item);
    while (over_[at] != at) at = over_[at] = over_[over_[at]];
    return at;
  }
  void join(std::size_t a, std::size_t b) {
    std::uint32_t low = of(a), high = of(b);
    if (low > high) std::swap(low, high);
    over_[high] = low;
  }

 private:
  std::vector<std::uint32_t> over_;
};

}  // namespace espalier::sim
