// Points in upright solids. A height is drawn by the sum of the weights of slices up to it, then a place in
// that slice: three numbers a point, none of them in vain.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/random.h"
#include "sim/scatter/envelope.h"
#include "sim/scatter/slices.h"

namespace espalier::sim {
namespace {

enum Slot : unsigned { kHeight, kTurn, kOut };

void requireSoundDensity(const std::vector<DensityAt>& density) {
  double most = 0.0;
  for (std::size_t i = 0; i < density.size(); ++i) {
    const DensityAt& at = density[i];
    if (!(at.share >= 0.0 && at.share <= 1.0) || !(at.density >= 0.0) || !std::isfinite(at.density)) {
      throw InputError(fmt::format(
          "a density of {} at {} of the height; expected a number of 0 or more at a share from 0 to 1",
          at.density, at.share));
    }
    if (i > 0 && !(at.share > density[i - 1].share)) {
      throw InputError(fmt::format("a density with the share {} after {}; expected shares that rise",
                                   at.share, density[i - 1].share));
    }
    most = std::max(most, at.density);
  }
  if (!density.empty() && most == 0.0)
    throw InputError("a density of 0 along the whole height; expected one above 0 somewhere");
}

double densityAt(const std::vector<DensityAt>& density, double share) {
  if (density.empty()) return 1.0;
  const auto after =
      std::find_if(density.begin(), density.end(), [&](const DensityAt& at) { return at.share >= share; });
  if (after == density.begin()) return density.front().density;
  if (after == density.end()) return density.back().density;
  const DensityAt &a = after[-1], &b = after[0];
  return a.density + (b.density - a.density) * ((share - a.share) / (b.share - a.share));
}

/// Heights drawn by weight. Within a piece the weight runs straight from end to end; pieces are so short that
/// no count of points shows the difference.
class Heights {
 public:
  Heights(const Solid& solid, const Strewing& strewing) : solid_(solid), strewing_(strewing) {
    low_ = sliceAt(solid, 0.0).height;
    span_ = sliceAt(solid, 1.0).height - low_;
    for (int i = 0; i <= kPieces; ++i) ends_.push_back(static_cast<double>(i) / kPieces);
    for (const DensityAt& at : strewing.density) ends_.push_back(sliceOf(solid, low_ + at.share * span_));
    std::sort(ends_.begin(), ends_.end());
    ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
    for (const double s : ends_) weights_.push_back(weight(s));
    sums_.push_back(0.0);
    for (std::size_t i = 1; i < ends_.size(); ++i) {
      const double middle = weight(0.5 * (ends_[i - 1] + ends_[i]));
      sums_.push_back(sums_.back() +
                      (ends_[i] - ends_[i - 1]) * (weights_[i - 1] + 4.0 * middle + weights_[i]) / 6.0);
    }
    if (!(sums_.back() > 0.0)) throw InputError("a density that leaves no place in the envelope");
  }

  /// The s of a slice, from an even number in [0, 1).
  double draw(double even) const {
    const double sum = even * sums_.back();
    // The first piece that ends beyond it has a weight.
    const auto at = std::upper_bound(sums_.begin() + 1, sums_.end() - 1, sum);
    const auto i = static_cast<std::size_t>(at - sums_.begin());
    const double whole = sums_[i] - sums_[i - 1];
    const double part = whole > 0.0 ? std::min(1.0, (sum - sums_[i - 1]) / whole) : 0.0;
    const double a = weights_[i - 1], b = weights_[i];
    const double root = a + std::sqrt(a * a + part * (b * b - a * a));
    const double along = root > 0.0 ? part * (a + b) / root : part;
    return ends_[i - 1] + std::min(1.0, along) * (ends_[i] - ends_[i - 1]);
  }

 private:
  static constexpr int kPieces = 2048;

  double weight(double s) const {
    const Slice slice = sliceAt(solid_, s);
    const double density = densityAt(strewing_.density, (slice.height - low_) / span_);
    const double area = strewing_.spread == Spread::volume ? slice.half.x * slice.half.y : 1.0;
    return density * area * std::max(0.0, slice.rise);
  }

  const Solid& solid_;
  const Strewing& strewing_;
  double low_ = 0.0, span_ = 1.0;
  std::vector<double> ends_, weights_;  // of pieces, by s
  std::vector<double> sums_;            // of all pieces up to there
};

}  // namespace

void requireSound(const Strewing& strewing) {
  requireSoundDensity(strewing.density);
  if (strewing.count == 0 || strewing.count > std::numeric_limits<std::uint32_t>::max())
    throw InputError(fmt::format("{} points in an envelope; expected 1 to 2^32 - 1", strewing.count));
}

PointSet scatterInside(const Envelope& envelope, const Strewing& strewing, std::uint64_t stream) {
  requireSound(envelope);
  requireSound(strewing);
  const Heights heights(envelope.solid, strewing);
  const bool square = isSquare(envelope.solid);
  PointSet points;
  points.at.resize(strewing.count);
  points.normal.resize(strewing.count, Vec3(0.0));
  parallelFor(strewing.count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      Slots slots({stream, static_cast<std::uint32_t>(k)}, Purpose::attractor);
      const Slice slice = sliceAt(envelope.solid, heights.draw(slots.uniform(kHeight)));
      const glm::dvec2 across = square ? 2.0 * glm::dvec2(slots.uniform(kTurn), slots.uniform(kOut)) - 1.0
                                       : std::sqrt(slots.uniform(kOut)) * unitCircle(slots.uniform(kTurn));
      points.at[k] = envelope.foot + Vec3(across.x * slice.half.x, slice.height, across.y * slice.half.y);
    }
  });
  return points;
}

}  // namespace espalier::sim
