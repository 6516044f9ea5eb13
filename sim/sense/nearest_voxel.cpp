#include "sim/sense/nearest_voxel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

namespace espalier::sim {
namespace {

constexpr int kBits = BitVolume::kWordBits;

/// How far along a row the nearest set bit lies from x, if that is at most `reach`.
std::optional<int> alongRow(const BitVolume& bits, int y, int z, int x, int reach) {
  const int low = std::max(0, x - reach), high = std::min(bits.size().x - 1, x + reach);
  if (low > high) return std::nullopt;
  const std::uint64_t* const row = bits.row(y, z);
  std::optional<int> nearest;
  for (int w = low / kBits; w <= high / kBits; ++w) {
    std::uint64_t word = row[w];
    if (w == low / kBits) word &= ~std::uint64_t{0} << (low % kBits);
    if (w == high / kBits) word &= ~std::uint64_t{0} >> (kBits - 1 - high % kBits);
    if (word == 0) continue;
    const int at = x - w * kBits;  // within the word, or before or behind it
    const std::uint64_t up_to = at < 0 ? 0 : at >= kBits - 1 ? word : word & ((std::uint64_t{2} << at) - 1);
    const std::uint64_t beyond = word & ~up_to;
    if (up_to != 0) {
      const int gap = at - (kBits - 1 - std::countl_zero(up_to));
      nearest = std::min(nearest.value_or(gap), gap);
    }
    if (beyond != 0) {
      const int gap = std::countr_zero(beyond) - at;
      nearest = std::min(nearest.value_or(gap), gap);
    }
  }
  return nearest;
}

int rootOf(int square) {
  int root = static_cast<int>(std::sqrt(static_cast<double>(square)));
  while (root * root > square) --root;
  while ((root + 1) * (root + 1) <= square) ++root;
  return root;
}

}  // namespace

std::optional<double> distanceToNearest(const BitVolume& bits, Voxel from, int most) {
  int best = most * most + 1;  // squared: less than this is wanted
  const auto lookAt = [&](int y, int z) {
    if (y < 0 || z < 0 || y >= bits.size().y || z >= bits.size().z) return;
    const int aside = (y - from.y) * (y - from.y) + (z - from.z) * (z - from.z);
    if (aside >= best) return;
    const auto gap = alongRow(bits, y, z, from.x, rootOf(best - 1 - aside));
    if (gap) best = std::min(best, aside + *gap * *gap);
  };
  for (int ring = 0; ring * ring < best; ++ring) {
    for (int a = -ring; a <= ring; ++a) {
      lookAt(from.y - ring, from.z + a);
      if (ring > 0) lookAt(from.y + ring, from.z + a);
      if (std::abs(a) == ring) continue;
      lookAt(from.y + a, from.z - ring);
      lookAt(from.y + a, from.z + ring);
    }
  }
  if (best > most * most) return std::nullopt;
  return std::sqrt(static_cast<double>(best));
}

}  // namespace espalier::sim
