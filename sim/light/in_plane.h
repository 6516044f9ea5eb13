#pragma once
#include <array>
#include <cmath>

#include "sim/world/world.h"

// Internal to the room: where a surface goes on.
namespace espalier::sim {

/// The axis along which a direction runs most; y before x before z.
inline int longestAxis(Vec3f direction) {
  const Vec3f size = glm::abs(direction);
  return size.y >= size.x && size.y >= size.z ? 1 : size.x >= size.z ? 0 : 2;
}

/// A surface lies in a column of voxels along its normal's longest axis, `up`. Where in the column that lies
/// `aside` of it (along the other two axes) it goes on, if it does: the way there, the likelier first.
inline std::array<Voxel, 2> inPlane(const Surface& surface, int up, Voxel aside) {
  aside[up] = 0;
  const float rise = -glm::dot(Vec3f(aside), surface.normal) / surface.normal[up];
  const float nearest = std::round(rise);
  std::array<Voxel, 2> ways{aside, aside};
  ways[0][up] = static_cast<int>(nearest);
  ways[1][up] = static_cast<int>(nearest) + (rise >= nearest ? 1 : -1);
  return ways;
}

/// Whether another surface, so far away, goes on with one: faces within an angle of it and lies level with
/// it.
inline bool goesOn(const Surface& surface, const Surface& other, Voxel way, float cosine) {
  constexpr float kLevel = 0.3f;  // voxel widths
  const float off = glm::dot(Vec3f(way) + other.offset_vx * other.normal, surface.normal) - surface.offset_vx;
  return glm::dot(other.normal, surface.normal) > cosine && std::abs(off) < kLevel;
}

}  // namespace espalier::sim
