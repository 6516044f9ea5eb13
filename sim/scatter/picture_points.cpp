#include "sim/scatter/picture_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/random.h"
#include "sim/base/stop.h"

namespace espalier::sim {
namespace {

enum PictureSlot : unsigned { kPixel, kFiner, kAcrossIt, kDownIt };

constexpr std::size_t kMostDrawn = std::numeric_limits<std::uint32_t>::max();

void requireDrawable(std::size_t count) {
  if (count == 0 || count > kMostDrawn)
    throw InputError(fmt::format("{} points over a picture; expected 1 to 2^32 - 1", count));
}

struct Thrown {
  Vec3 at;
  float density;
};

/// A picture's pixels by their densities: sums of rows, and of pixels within each.
class Pixels {
 public:
  Pixels(const DensityPicture& picture, const PictureFrame& frame)
      : picture_(picture), frame_(frame), sums_(picture.density.size()) {
    const auto rows = static_cast<std::size_t>(picture.height);
    parallelForEach(rows, [&](std::size_t y) {
      double sum = 0.0;
      for (std::size_t i = y * columns(); i < (y + 1) * columns(); ++i)
        sums_[i] = sum += static_cast<double>(picture.density[i]);
    });
    double sum = 0.0;
    for (std::size_t y = 0; y < rows; ++y) rows_.push_back(sum += sums_[(y + 1) * columns() - 1]);
  }

  /// Over all pixels.
  double total() const { return rows_.back(); }

  Thrown draw(std::uint64_t stream, std::uint32_t number) const {
    Slots slots({stream, number}, Purpose::attractor);
    // Two numbers, as one of 32 bits would not tell all pixels of a large picture apart.
    const double sum = (slots.uniform(kPixel) + slots.uniform(kFiner) * 0x1p-32) * total();
    const auto row = pick(rows_.begin(), rows_.end(), sum);
    const auto y = static_cast<std::size_t>(row - rows_.begin());
    const auto first = sums_.begin() + static_cast<std::ptrdiff_t>(y * columns());
    const double before = y > 0 ? rows_[y - 1] : 0.0;
    const auto pixel = pick(first, first + static_cast<std::ptrdiff_t>(columns()), sum - before);
    const auto x = static_cast<std::size_t>(pixel - first);
    const double across = (static_cast<double>(x) + slots.uniform(kAcrossIt)) / picture_.width;
    const double down = (static_cast<double>(y) + slots.uniform(kDownIt)) / picture_.height;
    return {frame_.top_left + across * frame_.across + down * frame_.down,
            picture_.density[y * columns() + x]};
  }

 private:
  using At = std::vector<double>::const_iterator;

  std::size_t columns() const { return static_cast<std::size_t>(picture_.width); }

  /// The first whose sum goes beyond, or the last that adds anything: never one without density.
  static At pick(At begin, At end, double sum) {
    const At at = std::upper_bound(begin, end, sum);
    return at != end ? at : std::lower_bound(begin, end, *(end - 1));
  }

  const DensityPicture& picture_;
  const PictureFrame& frame_;
  std::vector<double> sums_;  // in each row, up to and with each pixel
  std::vector<double> rows_;  // up to and with each row
};

/// Discs of many sizes, by grids of cells as wide as the widest of theirs: one for each doubling.
class Discs {
 public:
  /// Keeps a disc where it is farther from each other than the lesser of the two radii.
  bool keep(Vec3 at, double radius) {
    for (const auto& [size, grid] : grids_) {
      const double wide = std::ldexp(1.0, size);
      // Of wide discs all within the radius of this one matter, which is less; of small ones their own.
      if (meets(grid, wide, at, radius)) return false;
    }
    const int size = static_cast<int>(std::ceil(std::log2(radius)));
    grids_[size][cellOf(at, std::ldexp(1.0, size))].push_back({at, radius});
    return true;
  }

 private:
  struct Disc {
    Vec3 at;
    double radius;
  };
  using Cell = glm::i64vec3;
  struct Hash {
    std::size_t operator()(const Cell& c) const {
      std::uint64_t h = 0;
      for (int axis = 0; axis < 3; ++axis)
        h = (h ^ static_cast<std::uint64_t>(c[axis])) * 0x9e3779b97f4a7c15u;
      return h ^ (h >> 32);
    }
  };
  using Grid = std::unordered_map<Cell, std::vector<Disc>, Hash>;

  static Cell cellOf(Vec3 p, double wide) { return Cell(glm::floor(p / wide)); }

  static bool meets(const Grid& grid, double wide, Vec3 at, double radius) {
    const double reach = std::min(radius, wide);
    const Cell low = cellOf(at - reach, wide), high = cellOf(at + reach, wide);
    for (std::int64_t y = low.y; y <= high.y; ++y) {
      for (std::int64_t z = low.z; z <= high.z; ++z) {
        for (std::int64_t x = low.x; x <= high.x; ++x) {
          const auto there = grid.find(Cell(x, y, z));
          if (there == grid.end()) continue;
          for (const Disc& other : there->second) {
            if (glm::distance(at, other.at) < std::min(radius, other.radius)) return true;
          }
        }
      }
    }
    return false;
  }

  std::map<int, Grid> grids_;  // by the exponent of their cells' width
};

Vec3 normalOf(const PictureFrame& frame) {
  return glm::normalize(glm::cross(frame.down, frame.across));
}

}  // namespace

void requireSound(const DensityPicture& picture, const PictureFrame& frame) {
  const double area = glm::length(glm::cross(frame.down, frame.across));
  const double longest = std::max(glm::length(frame.across), glm::length(frame.down));
  if (!(area > 1e-9 * longest * longest) || !std::isfinite(area))
    throw InputError("a picture over no area; expected three corners that are no straight line");
  const std::size_t pixels = picture.density.size();
  if (picture.width < 1 || picture.height < 1 ||
      pixels != static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height))
    throw InputError(
        fmt::format("{} densities in a picture of {} x {} pixels", pixels, picture.width, picture.height));
  if (!std::all_of(picture.density.begin(), picture.density.end(),
                   [](float d) { return d >= 0.0f && d <= 1.0f; }))
    throw InputError("a picture with a density beyond 0 to 1");
  if (std::none_of(picture.density.begin(), picture.density.end(), [](float d) { return d > 0.0f; }))
    throw InputError("a picture that is black everywhere; expected some that is brighter");
}

PointSet scatterOver(const DensityPicture& picture, const PictureFrame& frame, std::size_t count,
                     std::uint64_t stream) {
  requireDrawable(count);
  requireSound(picture, frame);
  const Pixels pixels(picture, frame);
  PointSet points{std::vector<Vec3>(count), std::vector<Vec3>(count, normalOf(frame))};
  parallelFor(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      points.at[k] = pixels.draw(stream, static_cast<std::uint32_t>(k)).at;
  });
  return points;
}

PointSet scatterOverApart(const DensityPicture& picture, const PictureFrame& frame, std::size_t count,
                          double spacing, std::uint64_t stream, int waves) {
  requireDrawable(count);
  requireSound(picture, frame);
  if (!(spacing > 0.0) || !std::isfinite(spacing))
    throw InputError(fmt::format("points {} apart; expected a number above 0", spacing));
  const Pixels pixels(picture, frame);
  const double pixel =
      glm::length(glm::cross(frame.down, frame.across)) / static_cast<double>(picture.density.size());
  constexpr double kFull = 0.7, kTimes = 30.0;  // as scatterApart has them
  constexpr std::uint32_t kOften = 1u << 16;
  PointSet points;
  std::vector<float> densities;
  for (int wave = 0; wave < waves; ++wave) {
    const double apart_by = std::ldexp(spacing, waves - 1 - wave);
    const double tries = std::ceil(kTimes * (1.0 + kFull * pixels.total() * pixel / (apart_by * apart_by)));
    const auto most = static_cast<std::uint32_t>(std::min(tries, static_cast<double>(kMostDrawn)));
    Discs discs;
    const auto keep = [&](const Thrown& thrown) {
      return discs.keep(thrown.at, apart_by / std::sqrt(static_cast<double>(thrown.density)));
    };
    for (std::size_t i = 0; i < points.at.size(); ++i) keep({points.at[i], densities[i]});
    for (std::uint32_t k = 0; k < most && points.at.size() < count; ++k) {
      if (k % kOften == 0) throwIfStopped();
      const Thrown thrown = pixels.draw(stream, k);
      if (!keep(thrown)) continue;
      points.at.push_back(thrown.at);
      densities.push_back(thrown.density);
      if (waves > 1) points.wave.push_back(wave);
    }
  }
  points.normal.assign(points.at.size(), normalOf(frame));
  return points;
}

}  // namespace espalier::sim
