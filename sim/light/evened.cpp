#include "sim/light/evened.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "sim/base/parallel.h"
#include "sim/light/in_plane.h"

namespace espalier::sim {
namespace {

constexpr int kReach = 2;         // voxels
constexpr float kAlike = 0.995f;  // cosine between normals
constexpr float kBend = 5.0f;     // standard errors: what bends more is no chance

/// Half of the ways to neighbours, along the two axes that a surface runs along most, nearest first, each
/// with the number of the way to the one before it.
struct Way {
  int a, b;
  std::size_t before;  ///< kNone: it starts at the surface itself
  float weight;
};
constexpr std::size_t kNone = ~std::size_t{0};

std::vector<Way> waysAbout() {
  std::vector<Way> ways;
  for (int a = 0; a <= kReach; ++a) {
    for (int b = a == 0 ? 1 : -kReach; b <= kReach; ++b) {
      if (a * a + b * b > kReach * kReach) continue;
      constexpr float kEnd = (kReach + 1) * (kReach + 1);
      ways.push_back({a, b, kNone, 1.0f - static_cast<float>(a * a + b * b) / kEnd});
    }
  }
  const auto length = [](const Way& way) { return way.a * way.a + way.b * way.b; };
  std::stable_sort(ways.begin(), ways.end(),
                   [&](const Way& p, const Way& q) { return length(p) < length(q); });
  for (Way& way : ways) {
    const int steps = std::max(std::abs(way.a), std::abs(way.b));
    if (steps < 2) continue;
    const auto shorter = [&](int along) {
      return static_cast<int>(std::lround(static_cast<double>(along) * (steps - 1) / steps));
    };
    const auto is = [&](const Way& w) { return w.a == shorter(way.a) && w.b == shorter(way.b); };
    way.before = static_cast<std::size_t>(std::find_if(ways.begin(), ways.end(), is) - ways.begin());
  }
  return ways;
}

/// Finds neighbours in a surface's plane.
class Neighbours {
 public:
  Neighbours(std::span<const TiledVoxel> surfaces, const VoxelSet& where)
      : surfaces_(surfaces), where_(where), numbers_(where) {}

  void standOn(const TiledVoxel& tiled) {
    here_ = &tiled;
    up_ = longestAxis(tiled.surface.normal);
  }

  /// The number of the one that lies so far along.
  std::optional<std::size_t> at(int a, int b) {
    const Surface& surface = here_->surface;
    const int u = (up_ + 1) % 3, w = (up_ + 2) % 3;
    Voxel way(0);
    way[u] = a;
    way[w] = b;
    for (const Voxel there : inPlane(surface, up_, way)) {
      const Voxel v = here_->voxel + there;
      if (!contains(where_.bits().size(), v) || !where_.has(v)) continue;
      const std::size_t number = numbers_(v);
      if (goesOn(surface, surfaces_[number].surface, there, kAlike)) return number;
    }
    return std::nullopt;
  }

 private:
  std::span<const TiledVoxel> surfaces_;
  const VoxelSet& where_;
  NearbyNumbers numbers_;
  const TiledVoxel* here_ = nullptr;
  int up_ = 1;
};

constexpr std::size_t kGrain = 8192;  // surfaces that are looked at one after the other

/// Calls visit(surface, one, other, weight) for the pairs of the surfaces begin .. end - 1.
template <typename Visit>
void forEachPair(std::span<const TiledVoxel> surfaces, const VoxelSet& where, const std::vector<Way>& ways,
                 std::size_t begin, std::size_t end, Visit visit) {
  Neighbours neighbours(surfaces, where);
  std::vector<bool> paired(ways.size());
  for (std::size_t i = begin; i < end; ++i) {
    neighbours.standOn(surfaces[i]);
    for (std::size_t k = 0; k < ways.size(); ++k) {
      const Way& way = ways[k];
      paired[k] = false;
      if (way.before != kNone && !paired[way.before]) continue;
      const auto one = neighbours.at(way.a, way.b);
      if (!one) continue;
      const auto other = neighbours.at(-way.a, -way.b);
      if (!other) continue;
      paired[k] = true;
      visit(i, *one, *other, way.weight);
    }
  }
}

/// What the pairs of one surface say of its value.
struct Bent {
  float sum = 0.0f, weights = 1.0f;

  void add(std::span<const float> values, std::size_t i, std::size_t one, std::size_t other, float weight,
           float bound) {
    const float bend = (values[one] - values[i]) + (values[other] - values[i]);
    if (std::abs(bend) > bound) return;
    sum += weight * bend;
    weights += 2.0f * weight;
  }
};

float boundOf(double standard_error) {
  return kBend * static_cast<float>(standard_error);
}

}  // namespace

std::vector<float> evened(std::span<const float> values, std::span<const TiledVoxel> surfaces,
                          const VoxelSet& where, double standard_error) {
  const float bound = boundOf(standard_error);
  const std::vector<Way> ways = waysAbout();
  std::vector<float> result(surfaces.size());
  parallelFor(surfaces.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Bent> bent(end - begin);
    forEachPair(surfaces, where, ways, begin, end,
                [&](std::size_t i, std::size_t one, std::size_t other, float weight) {
                  bent[i - begin].add(values, i, one, other, weight, bound);
                });
    for (std::size_t i = begin; i < end; ++i)
      result[i] = values[i] + bent[i - begin].sum / bent[i - begin].weights;
  });
  return result;
}

SurfacePairs::SurfacePairs(std::span<const TiledVoxel> surfaces, const VoxelSet& where) {
  const std::vector<Way> ways = waysAbout();
  std::vector<std::vector<Pair>> found((surfaces.size() + kGrain - 1) / kGrain);
  std::vector<std::uint8_t> counts(surfaces.size());
  parallelForEach(found.size(), [&](std::size_t piece) {
    const std::size_t end = std::min((piece + 1) * kGrain, surfaces.size());
    forEachPair(surfaces, where, ways, piece * kGrain, end,
                [&](std::size_t i, std::size_t one, std::size_t other, float weight) {
                  found[piece].push_back(
                      {static_cast<std::uint32_t>(one), static_cast<std::uint32_t>(other), weight});
                  ++counts[i];
                });
  });
  first_.reserve(surfaces.size() + 1);
  first_.push_back(0);
  for (const std::uint8_t count : counts) first_.push_back(first_.back() + count);
  pairs_.reserve(first_.back());
  for (const std::vector<Pair>& piece : found) pairs_.insert(pairs_.end(), piece.begin(), piece.end());
}

std::vector<float> SurfacePairs::evened(std::span<const float> values, double standard_error) const {
  const float bound = boundOf(standard_error);
  std::vector<float> result(values.size());
  parallelFor(result.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Bent bent;
      for (std::size_t k = first_[i]; k < first_[i + 1]; ++k)
        bent.add(values, i, pairs_[k].one, pairs_[k].other, pairs_[k].weight, bound);
      result[i] = values[i] + bent.sum / bent.weights;
    }
  });
  return result;
}

}  // namespace espalier::sim
