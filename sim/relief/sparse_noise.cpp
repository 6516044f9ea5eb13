#include "sim/relief/sparse_noise.h"

#include <algorithm>
#include <cmath>

#include "sim/base/random.h"

namespace espalier::sim {
namespace {

constexpr int kMost = 60;  // impulses of a square: more are drawn with a chance of 1e-40

/// By inversion: e^-kDensity, then each next term.
int poisson(double uniform) {
  double term = std::exp(-NoiseKernel::kDensity), sum = term;
  int count = 0;
  while (uniform >= sum && count < kMost) {
    ++count;
    term *= NoiseKernel::kDensity / count;
    sum += term;
  }
  return count;
}

std::int64_t floorOf(double x) {
  return static_cast<std::int64_t>(std::floor(x));
}

}  // namespace

SparseNoise::SparseNoise(std::uint64_t stream, unsigned octave, double scale_m, glm::dvec2 low_m,
                         glm::dvec2 high_m)
    : scale_m_(scale_m) {
  first_x_ = floorOf(low_m.x / scale_m - NoiseKernel::kReach);
  first_y_ = floorOf(low_m.y / scale_m - NoiseKernel::kReach);
  wide_ = floorOf(high_m.x / scale_m + NoiseKernel::kReach) - first_x_ + 1;
  high_ = floorOf(high_m.y / scale_m + NoiseKernel::kReach) - first_y_ + 1;
  begin_.push_back(0);
  for (std::int64_t y = first_y_; y < first_y_ + high_; ++y) {
    for (std::int64_t x = first_x_; x < first_x_ + wide_; ++x) {
      // The row is mixed into the stream: keys tell one 32-bit number apart, and squares have two.
      Slots row({stream ^ (0x9e3779b97f4a7c15u * static_cast<std::uint64_t>(y + 1)),
                 static_cast<std::uint32_t>(x), 0, 0},
                Purpose::relief, octave);
      const int count = poisson(row.uniform(0));
      for (int i = 0; i < count; ++i) {
        const auto slot = static_cast<unsigned>(4 + 4 * i);
        impulses_.push_back(
            {{static_cast<double>(x) + row.uniform(slot), static_cast<double>(y) + row.uniform(slot + 1)},
             (row.bits(slot + 2) >> 31) != 0 ? 1.0 : -1.0});
      }
      begin_.push_back(static_cast<std::uint32_t>(impulses_.size()));
    }
  }
  // The variance of one impulse on each unit is the kernel's square integrated: 5/99 pi R^2.
  const double pi = 3.14159265358979323846;
  const double deviation =
      std::sqrt(NoiseKernel::kDensity * 5.0 / 99.0 * pi * NoiseKernel::kReach * NoiseKernel::kReach);
  for (Impulse& impulse : impulses_) impulse.weight /= deviation;
}

double SparseNoise::at(glm::dvec2 at_m) const {
  const glm::dvec2 at = at_m / scale_m_;
  const auto clampX = [&](std::int64_t x) { return std::clamp(x, first_x_, first_x_ + wide_ - 1); };
  const auto clampY = [&](std::int64_t y) { return std::clamp(y, first_y_, first_y_ + high_ - 1); };
  const std::int64_t x0 = clampX(floorOf(at.x - NoiseKernel::kReach)),
                     x1 = clampX(floorOf(at.x + NoiseKernel::kReach));
  const std::int64_t y0 = clampY(floorOf(at.y - NoiseKernel::kReach)),
                     y1 = clampY(floorOf(at.y + NoiseKernel::kReach));
  constexpr double kSquare = 1.0 / (NoiseKernel::kReach * NoiseKernel::kReach);
  double sum = 0.0;
  for (std::int64_t y = y0; y <= y1; ++y) {
    for (std::uint32_t i = begin_[cell(x0, y)]; i < begin_[cell(x1, y) + 1]; ++i) {
      const glm::dvec2 aside = impulses_[i].at - at;
      const double u = (aside.x * aside.x + aside.y * aside.y) * kSquare;
      if (u < 1.0) sum += impulses_[i].weight * NoiseKernel::at(u);
    }
  }
  return sum;
}

double SparseNoise::bytes(double scale_m, glm::dvec2 size_m) {
  const glm::dvec2 squares = size_m / scale_m + 3.0;
  return squares.x * squares.y * (sizeof(Impulse) * 1.5 * NoiseKernel::kDensity + sizeof(std::uint32_t));
}

}  // namespace espalier::sim
