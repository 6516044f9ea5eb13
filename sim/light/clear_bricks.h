#pragma once
// Internal to the wing: where rays meet nothing any more, known by the brick.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/bits.h"
#include "sim/base/bricks.h"
#include "sim/sweep/directions.h"

namespace espalier::sim {

/// For every brick of a frozen world, the directions along which no ray that was anywhere in the brick meets
/// anything from there on, in the brick itself neither. A brick may be called not clear although it is: all
/// bricks count that the brick would overlap on its way along the direction.
class ClearBricks {
 public:
  static constexpr int kSide = Bricks::kSide;

  static constexpr std::size_t kWords = 4;  ///< of the directions' bits

  /// Whether a world of this size has too many bricks for this, more than 65,536: see FilledAhead.
  static bool isCoarse(Voxel size);

  /// At most 64 * kWords directions; a world that is not coarse. `filled`: the volume's bricks, of which
  /// nothing else is asked.
  ClearBricks(Voxel size, const Bricks& filled, std::span<const LatticeDirection> directions);

  /// The volume, of the same shape, has changed: as if made anew, with the same directions, in time with the
  /// bricks that filled.
  void follow(const Bricks& filled, std::span<const LatticeDirection> directions);

  /// kWords words; bit i is direction i. Outside of the world all are clear.
  const std::uint64_t* ofBrick(Voxel brick) const {
    return contains(bricks_, brick) ? rows_.data() + kWords * index(brick) : kAll;
  }
  bool is(std::size_t direction, Voxel voxel) const {
    return !contains(size_, voxel) || isInside(direction, voxel);
  }
  /// The same of a voxel of the world.
  bool isInside(std::size_t direction, Voxel voxel) const {
    const std::size_t at = index(voxel >> Voxel(3));
    return ((blocked_[direction][at / 8] >> (at % 8)) & 1u) == 0;
  }
  /// Whether anything lies in the brick of a voxel of the world, or in those one farther along any of the
  /// axes, the way that a direction leads. A ray lies in no others until it is more than kSide voxels away.
  bool mayMeet(Voxel direction, Voxel voxel) const {
    const Voxel brick = voxel >> Voxel(3);
    return ((ahead_filled_[octantOf(direction)].row(brick.y, brick.z)[brick.x >> 6] >> (brick.x & 63)) &
            1u) != 0;
  }

 private:
  static constexpr std::uint64_t kAll[kWords] = {~std::uint64_t{0}, ~std::uint64_t{0}, ~std::uint64_t{0},
                                                 ~std::uint64_t{0}};
  std::size_t index(Voxel brick) const {
    return static_cast<std::size_t>(brick.x) * step_[0] + static_cast<std::size_t>(brick.y) * step_[1] +
           static_cast<std::size_t>(brick.z) * step_[2];
  }

  static std::size_t octantOf(Voxel direction) {
    return (direction.x < 0 ? 1u : 0u) | (direction.y < 0 ? 2u : 0u) | (direction.z < 0 ? 4u : 0u);
  }
  void forgetAll();
  /// Of a row of bricks those that filled, a word after another.
  void addAhead(int y, int z, std::span<const std::uint64_t> came);
  /// Those that hold anything now and did not before.
  std::vector<Voxel> takeNote(const BitVolume& filled);
  void find(std::span<const LatticeDirection> directions);
  void findAhead(std::span<const LatticeDirection> directions);
  void addFilled(std::span<const Voxel> bricks, std::span<const LatticeDirection> directions);

  Voxel size_, bricks_;
  std::array<std::size_t, 3> step_{};  // from a brick to the next along each axis
  std::vector<std::uint64_t> rows_;
  /// The same by direction, a bit for each brick: set where it is not clear. Small, so that what asks along
  /// one direction, or of many bricks, seldom leaves the nearest cache.
  std::vector<std::vector<std::uint8_t>> blocked_;
  BitVolume filled_;                       // bricks that hold anything
  std::array<BitVolume, 8> ahead_filled_;  // of each octant that directions lead into: mayMeet
  /// What brick 0 overlaps on its way along a direction, and where its low corner is then; nearer ones first.
  struct Ahead {
    std::vector<Voxel> corners, bricks;
    std::vector<std::int32_t> steps;  ///< to the bricks, by index
  };
  std::vector<Ahead> ahead_;  // of each direction, once asked for
};

}  // namespace espalier::sim
