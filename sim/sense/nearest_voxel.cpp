#include "sim/sense/nearest_voxel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>

namespace espalier::sim {
namespace {

constexpr int kBits = BitVolume::kWordBits;

/// Of a row the set bit that is nearest to x, if it is no farther than `reach`; of two the lower one.
std::optional<int> inRow(const BitVolume& bits, int y, int z, int x, int reach) {
  const int low = std::max(0, x - reach), high = std::min(bits.size().x - 1, x + reach);
  if (low > high) return std::nullopt;
  const std::uint64_t* const row = bits.row(y, z);
  std::optional<int> nearest;
  const auto consider = [&](int place) {
    if (!nearest || std::abs(place - x) < std::abs(*nearest - x)) nearest = place;
  };
  for (int w = low / kBits; w <= high / kBits; ++w) {
    std::uint64_t word = row[w];
    if (w == low / kBits) word &= ~std::uint64_t{0} << (low % kBits);
    if (w == high / kBits) word &= ~std::uint64_t{0} >> (kBits - 1 - high % kBits);
    if (word == 0) continue;
    const int at = x - w * kBits;  // within the word, or before or behind it
    const std::uint64_t up_to = at < 0 ? 0 : at >= kBits - 1 ? word : word & ((std::uint64_t{2} << at) - 1);
    const std::uint64_t beyond = word & ~up_to;
    if (up_to != 0) consider(w * kBits + kBits - 1 - std::countl_zero(up_to));
    if (beyond != 0) consider(w * kBits + std::countr_zero(beyond));
  }
  return nearest;
}

/// The greatest whole number whose square is no more, as far as any row goes.
int rootOf(std::int64_t square) {
  auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(square)));
  while (root * root > square) --root;
  while ((root + 1) * (root + 1) <= square) ++root;
  return static_cast<int>(root);
}

}  // namespace

std::optional<Voxel> nearestSet(const BitVolume& bits, Voxel from, int most) {
  std::int64_t best = std::int64_t{most} * most;  // squared: more than this is too far
  std::optional<Voxel> found;
  const auto lookAt = [&](int y, int z) {
    if (y < 0 || z < 0 || y >= bits.size().y || z >= bits.size().z) return;
    const std::int64_t dy = y - from.y, dz = z - from.z, aside = dy * dy + dz * dz;
    if (aside > best) return;
    const auto x = inRow(bits, y, z, from.x, rootOf(best - aside));
    if (!x) return;
    const std::int64_t dx = *x - from.x, square = aside + dx * dx;
    const Voxel there(*x, y, z);
    if (found && square == best && !beforeInRows(there, *found)) return;
    best = square;
    found = there;
  };
  // No ring beyond this one has a row.
  const Voxel far = glm::max(glm::abs(from), glm::abs(bits.size() - 1 - from));
  const std::int64_t last = std::max(far.y, far.z);
  for (int ring = 0; ring <= last && std::int64_t{ring} * ring <= best; ++ring) {
    for (int a = -ring; a <= ring; ++a) {
      lookAt(from.y - ring, from.z + a);
      if (ring > 0) lookAt(from.y + ring, from.z + a);
      if (std::abs(a) == ring) continue;
      lookAt(from.y + a, from.z - ring);
      lookAt(from.y + a, from.z + ring);
    }
  }
  return found;
}

std::optional<double> distanceToNearest(const BitVolume& bits, Voxel from, int most) {
  const auto nearest = nearestSet(bits, from, most);
  return nearest ? std::optional(glm::length(Vec3(*nearest - from))) : std::nullopt;
}

}  // namespace espalier::sim
