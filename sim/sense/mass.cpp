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

/// How often each of a word's bits has come: plane k holds the counts' bits k.
class BitCounts {
 public:
  void add(std::uint64_t word) {
    std::size_t k = 0;
    const auto carry = [&] {
      const std::uint64_t both = planes_[k] & word;
      planes_[k++] ^= word;
      word = both;
    };
    for (int always = 0; always < 4; ++always) carry();  // seldom is anything left after these
    while (word != 0) carry();
  }
  /// Of all bits that came.
  std::int64_t sumOfPlaces() const {
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < planes_.size(); ++k) sum += sim::sumOfPlaces(planes_[k]) << k;
    return sum;
  }

 private:
  std::array<std::uint64_t, 32> planes_{};
};

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
  const Voxel low = glm::max(Voxel(-reach), -about), high = glm::min(Voxel(reach), size - 1 - about);
  glm::i64vec3 sum(0);  // whole numbers: the order of summing does not matter
  std::int64_t count = 0;
  for (int w = (about.x + low.x) >> 6; w <= (about.x + high.x) >> 6; ++w) {
    const int first_x = 64 * w - about.x;  // of the word's voxels
    BitCounts columns;
    std::int64_t in_columns = 0;
    for (int dy = low.y; dy <= high.y; ++dy) {
      const int wide = rootBelow(square - dy * dy);
      const std::int64_t before = in_columns;
      for (int dz = std::max(-wide, low.z); dz <= std::min(wide, high.z); ++dz) {
        std::uint64_t word = occupied.row(about.y + dy, about.z + dz)[w];
        if (word == 0) continue;
        const int half = rootBelow(square - dy * dy - dz * dz);
        const int first = -half - first_x, last = half - first_x;
        if (first > 63 || last < 0) continue;
        if (first > 0) word &= ~std::uint64_t{0} << first;
        if (last < 63) word &= ~std::uint64_t{0} >> (63 - last);
        columns.add(word);
        const std::int64_t here = std::popcount(word);
        in_columns += here;
        sum.z += here * dz;
      }
      sum.y += (in_columns - before) * dy;
    }
    sum.x += columns.sumOfPlaces() + in_columns * first_x;
    count += in_columns;
  }
  if (count == 0) return std::nullopt;
  return Vec3(about) + Vec3(sum) / static_cast<double>(count);
}

}  // namespace espalier::sim
