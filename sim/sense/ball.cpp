#include "sim/sense/ball.h"

#include <algorithm>
#include <array>

namespace espalier::sim {
namespace {

Ball makeBall(double radius_vx) {
  const int reach = static_cast<int>(radius_vx);
  const double square = radius_vx * radius_vx;
  Ball ball;
  for (int dy = -reach; dy <= reach; ++dy) {
    const int wide = rootBelow(square - dy * dy);
    for (int dz = -wide; dz <= wide; ++dz) {
      const int half = rootBelow(square - dy * dy - dz * dz);
      ball.rows.push_back({dy, dz, half});
      ball.voxels += 2 * half + 1;
    }
  }
  ball.outward = ball.rows;
  std::stable_sort(ball.outward.begin(), ball.outward.end(), [](const Ball::Row& a, const Ball::Row& b) {
    return a.dy * a.dy + a.dz * a.dz < b.dy * b.dy + b.dz * b.dz;
  });
  return ball;
}

}  // namespace

const Ball& ballOf(double radius_vx) {
  struct Known {
    double radius_vx = -1.0;
    Ball ball;
  };
  thread_local std::array<Known, 16> known;  // a rule set's senses, in balls that grow
  thread_local std::size_t oldest = 0;
  for (const Known& one : known) {
    if (one.radius_vx == radius_vx) return one.ball;
  }
  Known& one = known[oldest++ % known.size()];
  one = {radius_vx, makeBall(radius_vx)};
  return one.ball;
}

std::span<const std::uint64_t> masksAbout(int place, int reach) {
  thread_local std::vector<std::uint64_t> masks;
  masks.resize(static_cast<std::size_t>(reach) + 1);
  for (int far = 0; far <= reach; ++far) masks[static_cast<std::size_t>(far)] = bitsAbout(place, far);
  return masks;
}

}  // namespace espalier::sim
