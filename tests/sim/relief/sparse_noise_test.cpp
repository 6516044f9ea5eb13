#include "sim/relief/sparse_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

namespace espalier::sim {
namespace {

constexpr double kPi = std::numbers::pi;

/// The kernel's Fourier transform at so many waves a scale.
double transformOfKernel(double waves) {
  constexpr int kSteps = 2000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double r = NoiseKernel::kReach * (i + 0.5) / kSteps;
    const double u = r * r / (NoiseKernel::kReach * NoiseKernel::kReach);
    sum += NoiseKernel::at(u) * std::cyl_bessel_j(0.0, 2.0 * kPi * waves * r) * r;
  }
  return 2.0 * kPi * sum * NoiseKernel::kReach / kSteps;
}

/// Of noise of variance 1: the kernel's, over its integral.
double expectedPower(double waves) {
  static const double all = [] {
    double sum = 0.0;
    constexpr double kStep = 0.02;
    for (double f = 0.5 * kStep; f < 8.0; f += kStep)
      sum += std::pow(transformOfKernel(f), 2) * 2.0 * kPi * f * kStep;
    return sum;
  }();
  return std::pow(transformOfKernel(waves), 2) / all;
}

/// Samples of a square of so many scales, times a window that fades to its rim.
struct Windowed {
  static constexpr int kSide = 96;
  static constexpr double kScales = 12.0, kStep = kScales / kSide;
  std::vector<double> values;

  explicit Windowed(std::uint64_t stream, double scale_m) : values(kSide * kSide) {
    const SparseNoise noise(stream, 0, scale_m, {0.0, 0.0}, glm::dvec2(kScales * scale_m));
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x)
        values[static_cast<std::size_t>(y * kSide + x)] =
            noise.at(glm::dvec2(x, y) * (kStep * scale_m)) * window(x) * window(y);
  }
  static double window(int i) { return 0.5 - 0.5 * std::cos(2.0 * kPi * (i + 0.5) / kSide); }
  static double energyOfWindow() {
    double line = 0.0;
    for (int i = 0; i < kSide; ++i) line += window(i) * window(i);
    return line * line * kStep * kStep;
  }
  double power(double fx, double fy) const {
    std::vector<std::complex<double>> along_x, along_y;
    for (int i = 0; i < kSide; ++i) {
      along_x.push_back(std::polar(1.0, -2.0 * kPi * fx * i * kStep));
      along_y.push_back(std::polar(1.0, -2.0 * kPi * fy * i * kStep));
    }
    std::complex<double> sum = 0.0;
    for (std::size_t y = 0; y < kSide; ++y) {
      std::complex<double> row = 0.0;
      for (std::size_t x = 0; x < kSide; ++x) row += values[y * kSide + x] * along_x[x];
      sum += row * along_y[y];
    }
    return std::norm(sum) * std::pow(kStep, 4) / energyOfWindow();
  }
};

TEST(SparseNoise, ItsSpectrumIsThatOfItsKernel) {
  constexpr int kFields = 20, kWays = 32;
  const std::vector<double> waves{0.5, 0.7, 0.9, 1.1, 1.3, 1.5};
  std::vector<double> power(waves.size(), 0.0), expected(waves.size(), 0.0);
  for (int field = 0; field < kFields; ++field) {
    const Windowed noise(1000 + static_cast<std::uint64_t>(field), 37.0);
    for (std::size_t i = 0; i < waves.size(); ++i) {
      for (int way = 0; way < kWays; ++way) {
        // Spread over a ring a little wider than the window blurs.
        const double f = waves[i] + 0.16 * ((way % 8) / 7.0 - 0.5), turn = kPi * (way + 0.37 * field) / kWays;
        power[i] += noise.power(f * std::cos(turn), f * std::sin(turn)) / (kFields * kWays);
        expected[i] += expectedPower(f) / (kFields * kWays);
      }
    }
  }
  for (std::size_t i = 0; i < waves.size(); ++i)
    EXPECT_NEAR(power[i] / expected[i], 1.0, 0.1) << waves[i] << " waves a scale: " << power[i];
  // One hump, about where a wave is as long as the scale.
  EXPECT_GT(expected[2], 2.0 * expected[0]);
  EXPECT_GT(expected[3], 2.0 * expected[5]);
}

TEST(SparseNoise, HasAMeanOfZeroAndADeviationOfOne) {
  for (const std::uint64_t stream : {1u, 2u, 77u}) {
    const SparseNoise noise(stream, 3, 2.5, {-100.0, -100.0}, {100.0, 100.0});
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (double y = -99.5; y < 100.0; y += 0.9)
      for (double x = -99.5; x < 100.0; x += 0.9) {
        const double value = noise.at({x, y});
        sum += value;
        squares += value * value;
        ++count;
      }
    EXPECT_NEAR(sum / count, 0.0, 0.02);
    EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.03);
  }
}

TEST(SparseNoise, IsTheSameWhateverRectangleItIsAskedFor) {
  const SparseNoise all(9, 1, 4.0, {-50.0, -50.0}, {50.0, 50.0}), part(9, 1, 4.0, {10.0, -20.0}, {30.0, 5.0});
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) {
    const glm::dvec2 at(10.0 + 20.0 * static_cast<double>(random()) / 0x1p32,
                        -20.0 + 25.0 * static_cast<double>(random()) / 0x1p32);
    EXPECT_EQ(all.at(at), part.at(at));
  }
  EXPECT_NE(all.at({1.0, 2.0}), SparseNoise(10, 1, 4.0, {-50.0, -50.0}, {50.0, 50.0}).at({1.0, 2.0}));
  EXPECT_NE(all.at({1.0, 2.0}), SparseNoise(9, 2, 4.0, {-50.0, -50.0}, {50.0, 50.0}).at({1.0, 2.0}));
}

}  // namespace
}  // namespace espalier::sim
