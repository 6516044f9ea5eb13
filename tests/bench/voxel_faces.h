#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "sim/base/bits.h"

namespace espalier::bench {

/// The faces between occupied and free voxels as rectangles, in voxel widths.
struct VoxelFaces {
  std::vector<sim::Vec3f> corners;
  std::vector<std::array<std::uint32_t, 4>> quads;
};

/// Each face on its own; or neighbours in a plane joined into rectangles, as wide as they go and then as
/// long.
VoxelFaces voxelFaces(const sim::BitVolume& occupied, bool joined);

}  // namespace espalier::bench
