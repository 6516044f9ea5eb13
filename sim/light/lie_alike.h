#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

#include "sim/world/world.h"

// Internal to the room: what is found for a surface is kept for the next that lies as it does.
namespace espalier::sim {

/// The same normals hash alike, bit by bit.
inline std::size_t hashOf(Vec3f normal, std::uint64_t seed = 0) {
  for (int axis = 0; axis < 3; ++axis)
    seed = seed * 0x9e3779b97f4a7c15u + std::bit_cast<std::uint32_t>(normal[axis]);
  return static_cast<std::size_t>((seed * 0x9e3779b97f4a7c15u) >> 32);
}

/// Whether surfaces lie alike in their voxels.
inline bool lieAlike(const Surface& a, const Surface& b) {
  return a.normal == b.normal && a.offset_vx == b.offset_vx;
}
inline std::size_t hashOf(const Surface& surface) {
  return hashOf(surface.normal, std::bit_cast<std::uint32_t>(surface.offset_vx));
}

}  // namespace espalier::sim
