#include "sim/base/nearest.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace espalier::sim {
namespace {

constexpr int kWord = BitVolume::kWordBits;

/// Looks through cubes around a place.
class Search {
 public:
  Search(const BitVolume& volume, Voxel from) : volume_(volume), from_(from) {}

  /// Whether the nearest of all is known, once those are looked at that lie up to `reach` away along each
  /// axis.
  bool within(int reach) {
    const Voxel low = glm::max(from_ - reach, Voxel(0)), high = glm::min(from_ + reach, volume_.size() - 1);
    for (int y = low.y; y <= high.y; ++y) {
      for (int z = low.z; z <= high.z; ++z) row(y, z, low.x, high.x);
    }
    return best_ <= squared(reach) || (low == Voxel(0) && high == volume_.size() - 1);
  }
  std::optional<Voxel> found() const { return found_; }

 private:
  static std::int64_t squared(int steps) { return std::int64_t{steps} * steps; }

  void row(int y, int z, int low, int high) {
    const std::int64_t across = squared(y - from_.y) + squared(z - from_.z);
    if (across >= best_) return;
    for (int first = low; first <= high; first += kWord) {
      std::uint64_t bits = volume_.from({first, y, z});
      for (; bits != 0; bits &= bits - 1) {
        const int x = first + std::countr_zero(bits);
        if (x > high) break;
        const std::int64_t distance = across + squared(x - from_.x);
        if (distance >= best_) continue;
        best_ = distance;
        found_ = Voxel(x, y, z);
      }
    }
  }

  const BitVolume& volume_;
  Voxel from_;
  std::int64_t best_ = std::numeric_limits<std::int64_t>::max();
  std::optional<Voxel> found_;
};

}  // namespace

std::optional<Voxel> nearestSet(const BitVolume& volume, Voxel from) {
  if (volume.at(from)) return from;
  // Each cube holds the one before, which takes an eighth of the time.
  for (int reach = 1;; reach *= 2) {
    Search search(volume, from);
    if (search.within(reach)) return search.found();
  }
}

}  // namespace espalier::sim
