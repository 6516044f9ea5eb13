#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/sense/intersection.h"
#include "sim/tile/tiling.h"
#include "sim/world/world.h"

/// Segments that a site tries, many at once: which of them have room, and how far from the scene they run.
/// What they cross is what tileSegment gives: the same whole numbers walk the same planes, lane by lane.
namespace espalier::sim {

/// Ends of segments that leave one place, as offsets from it along each axis in units of Fixed. No component
/// may reach 64 voxel widths.
struct Offsets {
  static constexpr std::size_t kMost = 64;
  static constexpr float kToAVoxel = static_cast<float>(kFixedOne);
  alignas(64) std::int32_t x[kMost], y[kMost], z[kMost];
};

/// What stands around a place, as bits of a cube of voxels whose side is a power of two: x lowest, then z,
/// then y. Keeps its memory from one place to the next.
struct Room {
  Voxel low{0};                        ///< the cube's first voxel
  int reach = 0;                       ///< voxels from the place that it holds on every side
  int side_bits = 0;                   ///< its side is 1 << side_bits
  bool at_rim = false;                 ///< a part of it lies outside the world
  std::vector<std::uint64_t> hinders;  ///< what a segment may not cross, all that lies outside among it
  std::vector<std::uint64_t> free;     ///< what it would take, or may pass as it is its own
};

/// Finds the room for a plant's segments that reach at most `reach` voxels far along any axis (0 .. 63). See
/// sim::fit.
void roomAround(const World& world, Voxel at, int reach, std::span<const Voxel> attachment, Passage passage,
                int plant, Room& room);

/// What became of each segment: bit i is segment i's. One that is neither clear nor outside is blocked.
struct Felt {
  std::uint64_t clear = 0;    ///< has room
  std::uint64_t outside = 0;  ///< leaves the world before it meets anything in it
  /// Mean distance to the scene of the voxels that it crosses, voxel widths; of clear ones only. A voxel
  /// beyond the boundary layers counts as one layer farther than the last. Distances are whole numbers of
  /// 1/256.
  float proximity_vx[Offsets::kMost];
};

/// Feels along the first `count` segments, up to Offsets::kMost. A segment is clear where sim::fit says so
/// and it takes something; one that takes nothing folds back into its own limb and is blocked.
void feel(const World& world, const Room& room, Vec3 from_vx, const Offsets& ends, std::size_t count,
          Felt& felt);

/// Where a segment ends: on the lattice of 1/4096 voxel width.
Vec3 endOf(Vec3 from_vx, const Offsets& ends, std::size_t i);

}  // namespace espalier::sim
