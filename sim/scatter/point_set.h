#pragma once
#include <cstdint>
#include <vector>

#include "sim/base/vec.h"

namespace espalier::sim {

/// Points strewn in space.
struct PointSet {
  std::vector<Vec3> at;      ///< in the units of what they are strewn over: world metres
  std::vector<Vec3> normal;  ///< of each the unit normal of the surface it lies on; zero in a volume
  std::vector<std::int32_t> wave = {};  ///< in which of several they were strewn; empty where in one
};

}  // namespace espalier::sim
