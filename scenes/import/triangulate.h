#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "sim/base/vec.h"

namespace espalier::scenes {

/// Splits a nearly flat polygon of n >= 3 corners into n - 2 triangles of the same winding by clipping ears;
/// the numbers are indices into `corners`. A simple polygon, convex or not, is covered exactly. One that
/// crosses itself is covered somehow; some of the triangles may have no area.
///
/// Done here because Assimp 5.2.5 fills the notch of a polygon in which a corner lies on another ear's edge:
/// an L with equal arms becomes a pentagon.
std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<sim::Vec3>& corners);

}  // namespace espalier::scenes
