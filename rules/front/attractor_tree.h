#pragma once
// Internal to the wing.
#include <limits>

#include "rules/front/attractors.h"

namespace espalier::rules {

/// Bits of the curve that attractors are sorted along, for each axis: as many levels has their tree, but
/// where many lie in one place.
inline constexpr int kCurveBits = 21;

inline constexpr double kFar = std::numeric_limits<double>::infinity();

/// The order of places where nothing else tells them apart: the least x first, then y, then z.
bool before(sim::Vec3 a, sim::Vec3 b);

}  // namespace espalier::rules
