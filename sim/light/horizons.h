#pragma once
// Internal to the wing: how far rays may meet anything, known by the brick.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/sweep/directions.h"

namespace espalier::sim {

/// For each direction a map of the world as one sees it looking along it: the depth of the farthest brick
/// that holds anything, for each square of what lies behind one another. A ray lies in one square all along,
/// and beyond the square's depth it meets nothing.
///
/// Depth counts along the direction's longest axis. Along the other two axes voxels are shifted back by as
/// much as the direction leads away until there.
class Horizons {
 public:
  /// Read so many at a time at most: lists of directions are as long as a multiple of this.
  static constexpr std::size_t kLanes = 16;

  /// The axis along which depth counts.
  static int depthAxis(Voxel direction) {
    const Voxel way = glm::abs(direction);
    return way.y >= way.x && way.y >= way.z ? 1 : way.x >= way.z ? 0 : 2;
  }

  /// Of an empty world of this size.
  Horizons(Voxel size, std::span<const LatticeDirection> directions);

  /// These bricks have come to hold something.
  void raise(std::span<const Voxel> bricks);

  /// Of each direction a whole number that follows from a voxel, modulo 2^32: x * voxel.x + y * voxel.y +
  /// z * voxel.z + rest.
  struct Linear {
    std::vector<std::int32_t> x, y, z, rest;
  };
  const Linear& depth() const { return depth_; }
  /// Where a voxel lies on a direction's map: shifted down by shift() they give its column and its line.
  const std::array<Linear, 2>& place() const { return place_; }
  int shift() const { return shift_; }
  const std::int32_t* lineLengths() const { return line_.data(); }
  const std::int32_t* firsts() const { return first_.data(); }
  /// The maps, two squares a word, the first in the lower half: by how many bricks the depth is that anything
  /// holds, and 0 where nothing does. A direction's square is firsts() + line * lineLengths() + column.
  const std::uint32_t* squares() const { return squares_.data(); }

  /// How many steps along its longest axis lie between a voxel and the depth of the direction's farthest
  /// brick; negative if that lies behind.
  int reach(std::size_t direction, Voxel voxel) const;

 private:
  struct Across {
    int axis;
    std::int32_t slope;  // by how much a voxel is shifted for each step of depth, in kUnit
    std::int32_t rest;
  };
  struct Map {
    int axis;    // the longest
    int bricks;  // along it, if the direction leads back along it; else 0
    std::array<Across, 2> across;
    std::int32_t first, line;
  };
  void raise(const Map& map, Voxel brick);

  std::vector<Map> maps_;
  int shift_ = 0;
  Linear depth_;
  std::array<Linear, 2> place_;
  std::vector<std::int32_t> line_, first_;
  std::vector<std::uint32_t> squares_;
};

}  // namespace espalier::sim
