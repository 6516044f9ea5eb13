#include "tests/bench/town.h"

#include <algorithm>
#include <random>

namespace espalier::bench {
namespace {

/// Occupies the voxels x0 .. x1 of a row, both included.
void fillRow(std::uint64_t* row, int x0, int x1) {
  for (int w = x0 >> 6; w <= x1 >> 6; ++w) {
    std::uint64_t word = ~std::uint64_t{0};
    if (w == x0 >> 6) word &= ~std::uint64_t{0} << (x0 & 63);
    if (w == x1 >> 6) word &= ~std::uint64_t{0} >> (63 - (x1 & 63));
    row[w] |= word;
  }
}

void fillBox(sim::BitVolume& bits, sim::Voxel low, sim::Voxel high) {
  for (int y = low.y; y <= high.y; ++y) {
    for (int z = low.z; z <= high.z; ++z) fillRow(bits.row(y, z), low.x, high.x);
  }
}

}  // namespace

sim::BitVolume town(sim::Voxel size) {
  constexpr int kPlot = 60, kStreet = 18;
  sim::BitVolume bits(size);
  std::mt19937 random(1989);
  const int ground = std::max(1, size.y / 40);
  fillBox(bits, {0, 0, 0}, {size.x - 1, ground - 1, size.z - 1});
  for (int z = 0; z < size.z; z += kPlot) {
    for (int x = 0; x < size.x; x += kPlot) {
      const int height = ground + static_cast<int>(random() % static_cast<unsigned>(size.y - ground));
      const sim::Voxel far(std::min(size.x, x + kPlot - kStreet) - 1, height,
                           std::min(size.z, z + kPlot - kStreet) - 1);
      fillBox(bits, {x, ground, z}, far);
    }
  }
  return bits;
}

}  // namespace espalier::bench
