#pragma once
#include <cmath>
#include <vector>

#include "sim/base/random.h"

namespace espalier::tests {

/// Even in a box about a middle, half as long along each side.
inline std::vector<sim::Vec3> inBox(std::uint64_t stream, int count, sim::Vec3 middle, sim::Vec3 half) {
  std::vector<sim::Vec3> points;
  for (int i = 0; i < count; ++i) {
    sim::Draws draws({stream, static_cast<std::uint32_t>(i)}, sim::Purpose::custom);
    const double x = draws.uniform(-1, 1), y = draws.uniform(-1, 1), z = draws.uniform(-1, 1);
    points.push_back(middle + half * sim::Vec3(x, y, z));
  }
  return points;
}

}  // namespace espalier::tests
