#pragma once
// Internal to the wing: what rays may meet, known by the brick.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/bits.h"
#include "sim/base/bricks.h"
#include "sim/light/horizons.h"
#include "sim/sweep/directions.h"

namespace espalier::sim {

/// Which bricks of a frozen world hold anything, made ready for rays: whether anything lies in a brick and in
/// its neighbours farther along, and how far along anything lies at all.
class FilledAhead {
 public:
  static constexpr int kSide = Bricks::kSide;

  /// `filled`: the volume's bricks, of which nothing else is asked.
  FilledAhead(Voxel size, const Bricks& filled, std::span<const LatticeDirection> directions);

  /// The volume, of the same shape, has changed: as if made anew, with the same directions, in time with the
  /// bricks that filled.
  void follow(const Bricks& filled, std::span<const LatticeDirection> directions);

  const Horizons& horizons() const { return horizons_; }
  Voxel bricks() const { return filled_.size(); }

  /// A number below 8: the axes along which a direction leads back.
  static std::size_t octantOf(Voxel direction) {
    return (direction.x < 0 ? 1u : 0u) | (direction.y < 0 ? 2u : 0u) | (direction.z < 0 ? 4u : 0u);
  }
  /// For each brick, x fastest, then z, then y, eight bits, four bricks a word from its lowest bits on. Bit c
  /// says whether anything lies in the brick or in those one farther along some of the axes in c (1: x, 2: y,
  /// 4: z), the way that a direction of this octant leads. For the octants of the directions.
  const std::uint32_t* around(std::size_t octant) const { return around_[octant].data(); }

 private:
  void forget(std::span<const LatticeDirection> directions);
  void add(Voxel brick);

  Voxel size_;
  BitVolume filled_;
  std::array<std::vector<std::uint32_t>, 8> around_;  // empty where no direction leads
  Horizons horizons_;
};

}  // namespace espalier::sim
