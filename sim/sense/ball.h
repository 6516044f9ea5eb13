#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/base/bits.h"

/// How everything that looks around in a ball walks through its voxels: in rows of 64 along x.
namespace espalier::sim {

/// The largest whole number whose square is at most `square`, which is not negative.
inline int rootBelow(double square) {
  const int root = static_cast<int>(std::sqrt(square));
  return root * root > square ? root - 1 : root;  // a root rounded up to a whole number
}

/// The voxels whose centres lie within a radius of a voxel's own, by rows along x.
struct Ball {
  struct Row {
    int dy, dz, half;  ///< it reaches from -half to half
  };
  std::vector<Row> rows;     ///< from low to high in (y, z)
  std::vector<Row> outward;  ///< the same, those nearest to the middle first
  std::int64_t voxels = 0;
};
/// It is remembered by each thread for the radii that it asked for last.
const Ball& ballOf(double radius_vx);

/// How many bits are set; std::popcount is a call where a program must run on any processor.
inline int bitCount(std::uint64_t word) {
  word -= word >> 1 & 0x5555555555555555;
  word = (word & 0x3333333333333333) + (word >> 2 & 0x3333333333333333);
  word = (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0f;
  return static_cast<int>(word * 0x0101010101010101 >> 56);
}

/// The bits of a word that are so far from a place at most; the place may lie before the word or behind it.
inline std::uint64_t bitsAbout(int place, int far) {
  const int low = place - far, high = place + far;
  if (low > 63 || high < 0) return 0;
  std::uint64_t bits = ~std::uint64_t{0};
  if (low > 0) bits &= ~std::uint64_t{0} << low;
  if (high < 63) bits &= ~std::uint64_t{0} >> (63 - high);
  return bits;
}

/// bitsAbout a place by how far, from 0 to `reach`. Good until the thread asks again.
std::span<const std::uint64_t> masksAbout(int place, int reach);

/// Calls visit(first, bits, dy, dz) for each word of voxels that are set within a radius of one: bit i is
/// that i voxels from `first` along x, and dy and dz are how far off the row lies. Word by word along x, and
/// from low to high in y and z.
template <class Visit>
void forEachWordOfBall(const BitVolume& set, Voxel about, double radius_vx, Visit visit) {
  const Voxel size = set.size();
  const Ball& ball = ballOf(radius_vx);
  const int reach = static_cast<int>(radius_vx);
  const int low = std::max(0, about.x - reach), high = std::min(size.x - 1, about.x + reach);
  for (int x = low; x <= high; x += BitVolume::kWordBits) {
    const std::span<const std::uint64_t> masks = masksAbout(about.x - x, reach);
    for (const auto& [dy, dz, half] : ball.rows) {
      const int y = about.y + dy, z = about.z + dz;
      if (y < 0 || y >= size.y || z < 0 || z >= size.z) continue;
      const Voxel first(x, y, z);
      const std::uint64_t word = set.from(first) & masks[static_cast<std::size_t>(half)];
      if (word != 0) visit(first, word, dy, dz);
    }
  }
}

/// The numbers of the bits whose place in the word has bit k set.
inline constexpr std::array<std::uint64_t, 6> kPlaces{0xaaaaaaaaaaaaaaaa, 0xcccccccccccccccc,
                                                      0xf0f0f0f0f0f0f0f0, 0xff00ff00ff00ff00,
                                                      0xffff0000ffff0000, 0xffffffff00000000};

/// The sum of the places of a word's bits.
inline std::int64_t sumOfPlaces(std::uint64_t word) {
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < kPlaces.size(); ++k) sum += std::int64_t{bitCount(word & kPlaces[k])} << k;
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

/// The mass of the words of a ball that were picked: whole numbers, so that their order does not matter.
class MassOfBall {
 public:
  explicit MassOfBall(Voxel about) : about_(about) {}

  /// As forEachWordOfBall has them, in its order.
  void add(Voxel first, std::uint64_t word, int dy, int dz) {
    if (first.x != word_x_) endWord();
    word_x_ = first.x;
    columns_.add(word);
    const std::int64_t here = bitCount(word);
    in_word_ += here;
    sum_ += glm::i64vec3(0, here * dy, here * dz);
  }
  std::int64_t count() const { return count_ + in_word_; }
  /// Voxel space; nothing where there are none.
  std::optional<Vec3> centre() {
    endWord();
    if (count_ == 0) return std::nullopt;
    return Vec3(about_) + Vec3(sum_) / static_cast<double>(count_);
  }

 private:
  void endWord() {
    sum_.x += columns_.sumOfPlaces() + in_word_ * (word_x_ - about_.x);
    count_ += in_word_;
    in_word_ = 0;
    columns_ = {};
  }

  Voxel about_;
  BitCounts columns_;
  glm::i64vec3 sum_{0};
  std::int64_t count_ = 0, in_word_ = 0;
  int word_x_ = 0;
};

}  // namespace espalier::sim
