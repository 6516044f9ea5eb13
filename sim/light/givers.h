#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/base/vec.h"
#include "sim/sweep/directions.h"

namespace espalier::sim {

/// Directions with what each gives to receivers, in whole numbers of a unit, so that sums need no order.
class Givers {
 public:
  /// What a direction gives to a receiver with normal n before which it lies: [0] + n.x [1] + n.y [2] + n.z
  /// [3], at least 0.
  using Amount = std::array<float, 4>;

  /// What a direction gives a receiver in whose plane it lies. The sun's stands for a step of its way, in
  /// half of which the sun is before the receiver. What looks straight up or down has the horizon for its
  /// plane: all of the sun's way lies above it.
  enum class Along { nothing, half };

  Givers(const DirectionSet& directions, const std::vector<Amount>& amounts, Along along);

  /// In words of 64 directions.
  std::size_t words() const { return ways_[0].size() / 64; }
  /// Writes what each direction gives to a receiver with this normal, 64 numbers a word; 0 from behind it.
  void give(Vec3f normal, std::uint32_t* amounts) const;
  /// A sum of such amounts as what it stands for.
  float inFull(std::uint32_t sum) const { return static_cast<float>(sum * unit_); }

 private:
  std::array<std::vector<float>, 3> ways_;   // unit vectors, by axis
  std::array<std::vector<float>, 4> parts_;  // of amounts, in units
  Along along_;
  double unit_;
};

/// The sum of the amounts whose bit is set, 64 to a word. They must add up to less than 2^32.
std::uint32_t sumOfSet(const std::uint64_t* bits, const std::uint32_t* amounts, std::size_t words);

}  // namespace espalier::sim
