#pragma once
#include <vector>

#include "sim/base/vec.h"

namespace espalier::bench {

/// So many places in the crown of W-dome: y even in [2, 8] m, radii by a cubic Bezier of 6, 6, 3 and 1 m,
/// even in each disc.
std::vector<sim::Vec3> dome(int count);

}  // namespace espalier::bench
