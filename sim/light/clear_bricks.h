#pragma once
// Internal to the wing: where rays meet nothing any more, known by the brick.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/bits.h"
#include "sim/sweep/directions.h"

namespace espalier::sim {

/// For every brick of a frozen world, the directions along which no ray that was anywhere in the brick meets
/// anything from there on, in the brick itself neither. A brick may be called not clear although it is: all
/// bricks count that the brick would overlap on its way along the direction.
class ClearBricks {
 public:
  static constexpr int kSide = 8;  ///< voxels along a brick's edge

  static constexpr std::size_t kWords = 4;  ///< of the directions' bits

  /// At most 64 * kWords directions.
  ClearBricks(const BitVolume& occupied, std::span<const LatticeDirection> directions);

  /// The volume, of the same shape, has changed: as if made anew, with the same directions, in time with the
  /// bricks that filled.
  void follow(const BitVolume& occupied, std::span<const LatticeDirection> directions);

  /// kWords words; bit i is direction i. Outside of the world all are clear.
  const std::uint64_t* ofBrick(Voxel brick) const {
    return contains(bricks_, brick) ? rows_.data() + kWords * index(brick) : kAll;
  }
  bool is(std::size_t direction, Voxel voxel) const {
    if (!contains(size_, voxel)) return true;
    return ((rows_[kWords * index(voxel >> Voxel(3)) + direction / 64] >> (direction % 64)) & 1u) != 0;
  }

 private:
  static constexpr std::uint64_t kAll[kWords] = {~std::uint64_t{0}, ~std::uint64_t{0}, ~std::uint64_t{0},
                                                 ~std::uint64_t{0}};
  std::size_t index(Voxel brick) const { return indexJudged(brick >> Voxel(coarser_)); }
  std::size_t indexJudged(Voxel judged) const {
    return static_cast<std::size_t>(judged.x) * step_[0] + static_cast<std::size_t>(judged.y) * step_[1] +
           static_cast<std::size_t>(judged.z) * step_[2];
  }

  /// Those that hold anything, and takes note of them.
  std::vector<Voxel> judgedBricks(const BitVolume& occupied);
  void find(std::span<const LatticeDirection> directions, const std::vector<Voxel>& bricks);
  void addFilled(std::span<const Voxel> judged, std::span<const LatticeDirection> directions);

  Voxel size_, bricks_;
  int coarser_;  // halvings: in large worlds 2^coarser_ bricks along each axis are judged as one
  std::array<std::size_t, 3> step_{};  // from a brick to the next along each axis
  std::vector<std::uint64_t> rows_;
  BitVolume filled_;  // bricks that are judged as one and hold anything
  /// What brick 0 overlaps on its way along a direction, and where its low corner is then; nearer ones first.
  struct Ahead {
    Voxel corner, brick;
  };
  std::vector<std::vector<Ahead>> ahead_;  // of each direction, once asked for
};

}  // namespace espalier::sim
