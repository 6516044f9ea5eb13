#include "sim/sense/mass.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace espalier::sim {
namespace {

/// The numbers of the bits whose place in the word has bit k set.
constexpr std::array<std::uint64_t, 6> kPlaces{0xaaaaaaaaaaaaaaaa, 0xcccccccccccccccc, 0xf0f0f0f0f0f0f0f0,
                                               0xff00ff00ff00ff00, 0xffff0000ffff0000, 0xffffffff00000000};

/// The sum of the places of a word's bits.
std::int64_t sumOfPlaces(std::uint64_t word) {
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < kPlaces.size(); ++k) sum += std::int64_t{std::popcount(word & kPlaces[k])} << k;
  return sum;
}

/// The largest whole number whose square is at most `square`.
int rootBelow(double square) {
  const int root = static_cast<int>(std::sqrt(square));
  return root * root > square ? root - 1 : root;  // a root rounded up to a whole number
}

}  // namespace

std::optional<Vec3> centreOfMass(const BitVolume& occupied, Voxel about, double radius_vx) {
  const Voxel size = occupied.size();
  const int reach = static_cast<int>(radius_vx);
  const double square = radius_vx * radius_vx;
  glm::i64vec3 sum(0);  // whole numbers: the order of summing does not matter
  std::int64_t count = 0;
  const int low_y = std::max(-reach, -about.y), high_y = std::min(reach, size.y - 1 - about.y);
  for (int dy = low_y; dy <= high_y; ++dy) {
    const int wide = rootBelow(square - dy * dy);
    const int low_z = std::max(-wide, -about.z), high_z = std::min(wide, size.z - 1 - about.z);
    for (int dz = low_z; dz <= high_z; ++dz) {
      const int half = rootBelow(square - dy * dy - dz * dz);
      const int first = std::max(0, about.x - half), last = std::min(size.x - 1, about.x + half);
      if (first > last) continue;
      const std::uint64_t* const row = occupied.row(about.y + dy, about.z + dz);
      for (int w = first >> 6; w <= last >> 6; ++w) {
        std::uint64_t word = row[w];
        if (64 * w < first) word &= ~std::uint64_t{0} << (first & 63);
        if (64 * w + 63 > last) word &= ~std::uint64_t{0} >> (63 - (last & 63));
        if (word == 0) continue;
        const std::int64_t here = std::popcount(word);
        sum += glm::i64vec3(sumOfPlaces(word) + here * (64 * w - about.x), here * dy, here * dz);
        count += here;
      }
    }
  }
  if (count == 0) return std::nullopt;
  return Vec3(about) + Vec3(sum) / static_cast<double>(count);
}

}  // namespace espalier::sim
