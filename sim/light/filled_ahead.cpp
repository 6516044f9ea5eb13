#include "sim/light/filled_ahead.h"

#include <algorithm>
#include <bit>
#include <functional>

namespace espalier::sim {

FilledAhead::FilledAhead(Voxel size, const Bricks& filled, std::span<const LatticeDirection> directions)
    : size_(size), filled_(filled.bits().size()), horizons_(size, directions) {
  forget(directions);
  follow(filled, directions);
}

void FilledAhead::forget(std::span<const LatticeDirection> directions) {
  const Voxel bricks = filled_.size();
  filled_ = BitVolume(bricks);
  horizons_ = Horizons(size_, directions);
  const std::size_t count = static_cast<std::size_t>(bricks.x) * static_cast<std::size_t>(bricks.y) *
                            static_cast<std::size_t>(bricks.z);
  for (auto& around : around_) around.clear();
  for (const LatticeDirection& direction : directions) around_[octantOf(direction.v)].resize(count / 4 + 1);
}

void FilledAhead::add(Voxel brick) {
  /// The sets of axes that hold all axes of a set.
  constexpr auto kHolding = [] {
    std::array<std::uint32_t, 8> holding{};
    for (std::uint32_t set = 0; set < 8; ++set) {
      for (std::uint32_t other = 0; other < 8; ++other) {
        if ((set & other) == set) holding[set] |= 1u << other;
      }
    }
    return holding;
  }();
  const Voxel bricks = filled_.size();
  for (std::size_t octant = 0; octant < 8; ++octant) {
    if (around_[octant].empty()) continue;
    for (int set = 0; set < 8; ++set) {
      const auto back = [&](int axis) {
        return ((set >> axis) & 1) == 0 ? 0 : ((octant >> axis) & 1u) != 0 ? 1 : -1;
      };
      const Voxel at = brick + Voxel(back(0), back(1), back(2));
      if (!contains(bricks, at)) continue;
      const std::size_t number = (static_cast<std::size_t>(at.y) * static_cast<std::size_t>(bricks.z) +
                                  static_cast<std::size_t>(at.z)) *
                                     static_cast<std::size_t>(bricks.x) +
                                 static_cast<std::size_t>(at.x);
      around_[octant][number / 4] |= kHolding[static_cast<std::size_t>(set)] << (8 * (number % 4));
    }
  }
}

void FilledAhead::follow(const Bricks& filled, std::span<const LatticeDirection> directions) {
  const BitVolume& now = filled.bits();
  const auto emptied = [](std::uint64_t before, std::uint64_t after) { return (before & ~after) != 0; };
  if (!std::equal(filled_.words().begin(), filled_.words().end(), now.words().begin(), std::not_fn(emptied)))
    forget(directions);
  std::vector<Voxel> added;
  for (int y = 0; y < now.size().y; ++y) {
    for (int z = 0; z < now.size().z; ++z) {
      const std::uint64_t* const row = now.row(y, z);
      std::uint64_t* const before = filled_.row(y, z);
      for (int w = 0; w < now.rowWords() - 1; ++w) {
        for (std::uint64_t came = row[w] & ~before[w]; came != 0; came &= came - 1)
          added.emplace_back(w * BitVolume::kWordBits + std::countr_zero(came), y, z);
        before[w] = row[w];
      }
    }
  }
  for (const Voxel brick : added) add(brick);
  horizons_.raise(added);
}

}  // namespace espalier::sim
