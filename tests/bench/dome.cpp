#include "tests/bench/dome.h"

#include <cmath>

#include "sim/base/random.h"

namespace espalier::bench {

using sim::Vec3;

std::vector<Vec3> dome(int count) {
  std::vector<Vec3> places;
  for (int i = 0; i < count; ++i) {
    sim::Draws draws({2007, static_cast<std::uint32_t>(i)}, sim::Purpose::custom);
    const double t = draws.uniform(), s = 1.0 - t;
    const double radius = 6.0 * s * s * s + 18.0 * t * s * s + 9.0 * t * t * s + t * t * t;
    const auto side = sim::unitCircle(draws.uniform());
    const double r = radius * std::sqrt(draws.uniform());
    places.emplace_back(r * side.x, 2.0 + 6.0 * t, r * side.y);
  }
  return places;
}

}  // namespace espalier::bench
