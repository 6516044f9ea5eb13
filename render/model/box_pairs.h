#pragma once
// Internal to the wing: which of many boxes meet.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "sim/base/parallel.h"
#include "sim/base/vec.h"

namespace espalier::render {

struct Box {
  sim::Vec3f low, high;
};

/// Pairs of boxes of two pieces that count, the lower number first; twice the same: a piece and itself.
struct PiecePairs {
  std::uint32_t first = 0, second = 0;
  std::size_t pairs = 0;

  friend bool operator==(const PiecePairs&, const PiecePairs&) = default;
};

/// Boxes in a grid of cubes about twice as wide as they are on the mean, and at least a sixteenth of the
/// widest one: else a single long box among many small ones would lie in any number of cubes.
class Boxes {
 public:
  explicit Boxes(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
    double extent = 0.0, widest = 0.0;
    for (const Box& box : boxes_) {
      low_ = glm::min(low_, box.low);
      const sim::Vec3f size = box.high - box.low;
      const auto wide = static_cast<double>(std::max({size.x, size.y, size.z}));
      extent += wide;
      widest = std::max(widest, wide);
    }
    cell_m_ = static_cast<float>(
        std::max({2.0 * extent / static_cast<double>(boxes_.size()), widest / 16.0, 1e-12}));
    // What parts of the boxes have in each bucket of cells is gathered by buckets.
    constexpr std::size_t kPart = 8192;
    std::vector<Buckets> parts((boxes_.size() + kPart - 1) / kPart);
    sim::parallelForEach(parts.size(), [&](std::size_t part) {
      const std::size_t end = std::min(boxes_.size(), (part + 1) * kPart);
      for (std::size_t i = part * kPart; i < end; ++i) enter(static_cast<std::uint32_t>(i), parts[part]);
    });
    sim::parallelForEach(kBuckets, [&](std::size_t b) {
      std::vector<Entry>& bucket = buckets_[b];
      std::size_t size = 0;
      for (const Buckets& part : parts) size += part[b].size();
      bucket.reserve(size);
      for (const Buckets& part : parts) bucket.insert(bucket.end(), part[b].begin(), part[b].end());
      std::sort(bucket.begin(), bucket.end());
    });
  }

  using Pieces = std::pair<std::uint32_t, std::uint32_t>;
  /// Of all pairs of boxes that meet how many are counted for each pair of pieces.
  /// `counts(a, b)`: of two boxes, in parallel; `piece(a)`: what a box belongs to.
  template <class Counts, class Piece>
  std::vector<PiecePairs> count(Counts counts, Piece piece) const {
    std::array<std::map<Pieces, std::size_t>, kBuckets> of_bucket;
    sim::parallelForEach(kBuckets, [&](std::size_t b) {
      const std::vector<Entry>& entries = buckets_[b];
      for (std::size_t i = 0; i < entries.size(); ++i) {
        for (std::size_t j = i + 1; j < entries.size() && entries[j].cell == entries[i].cell; ++j) {
          const std::uint32_t one = entries[i].item, other = entries[j].item;
          if (met(one, other, entries[i].cell) && counts(one, other))
            ++of_bucket[b][std::minmax({piece(one), piece(other)})];
        }
      }
    });
    std::map<Pieces, std::size_t> found;
    for (const auto& here : of_bucket)
      for (const auto& [pieces, pairs] : here) found[pieces] += pairs;
    std::vector<PiecePairs> result;
    for (const auto& [pieces, pairs] : found) result.push_back({pieces.first, pieces.second, pairs});
    return result;
  }

 private:
  /// Something in one cell of a grid of cubes.
  struct Entry {
    std::uint64_t cell;
    std::uint32_t item;

    friend auto operator<=>(const Entry&, const Entry&) = default;
  };

  static constexpr std::size_t kBuckets = 64;
  using Buckets = std::array<std::vector<Entry>, kBuckets>;

  /// Into the bucket of each cell that the box lies in.
  void enter(std::uint32_t box, Buckets& buckets) const {
    constexpr std::uint64_t kSpread = 0x9e3779b97f4a7c15u;  // an even mix of a cell's numbers (Knuth)
    const auto from = cellOf(boxes_[box].low), to = cellOf(boxes_[box].high);
    for (std::uint64_t z = from[2]; z <= to[2]; ++z) {
      for (std::uint64_t y = from[1]; y <= to[1]; ++y) {
        for (std::uint64_t x = from[0]; x <= to[0]; ++x) {
          const std::uint64_t cell = keyOf({x, y, z});
          buckets[cell * kSpread >> 58u].push_back({cell, box});
        }
      }
    }
  }

  std::array<std::uint64_t, 3> cellOf(sim::Vec3f p) const {
    std::array<std::uint64_t, 3> cell{};
    for (int axis = 0; axis < 3; ++axis) {
      const float at = std::floor((p[axis] - low_[axis]) / cell_m_);
      cell[static_cast<std::size_t>(axis)] = static_cast<std::uint64_t>(std::clamp(at, 0.0f, 2'000'000.0f));
    }
    return cell;
  }
  static std::uint64_t keyOf(const std::array<std::uint64_t, 3>& c) {
    return c[0] | c[1] << 21u | c[2] << 42u;
  }

  /// Whether two boxes meet, and first in this cell of all that they share.
  bool met(std::uint32_t a, std::uint32_t b, std::uint64_t cell) const {
    const Box &p = boxes_[a], &q = boxes_[b];
    const sim::Vec3f low = glm::max(p.low, q.low), high = glm::min(p.high, q.high);
    return low.x <= high.x && low.y <= high.y && low.z <= high.z && keyOf(cellOf(low)) == cell;
  }

  std::vector<Box> boxes_;
  sim::Vec3f low_{std::numeric_limits<float>::max()};
  float cell_m_ = 1.0f;
  Buckets buckets_;
};

}  // namespace espalier::render
