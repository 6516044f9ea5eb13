#include "render/form/fbm.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "sim/base/error.h"

namespace espalier {
namespace {

using render::FractionalMotion;

/// The exponent by which the way between two places spreads with the lag between them: half the slope of the
/// mean squares of increments over lags of 1, 2, 4 .. 64, in logarithms, by least squares.
double measuredExponent(const std::vector<double>& motion) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, n = 0.0;
  for (std::size_t lag = 1; lag <= 64; lag *= 2, ++n) {
    double squares = 0.0;
    for (std::size_t i = lag; i < motion.size(); ++i)
      squares += (motion[i] - motion[i - lag]) * (motion[i] - motion[i - lag]);
    const double x = std::log2(static_cast<double>(lag)),
                 y = std::log2(squares / static_cast<double>(motion.size() - lag));
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return 0.5 * (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

TEST(FractionalMotion, SpreadsByTheExponentThatWasAskedFor) {
  for (const double hurst : {0.2, 0.35, 0.5, 0.65, 0.8}) {
    const FractionalMotion motion(hurst, std::size_t{1} << 14);
    for (std::uint64_t seed = 1; seed <= 32; ++seed)
      EXPECT_NEAR(measuredExponent(motion({.stream = seed}, 0)), hurst, 0.05) << "seed " << seed;
  }
}

TEST(FractionalMotion, CovariesAsTheClosedFormSays) {
  constexpr std::size_t kSteps = 6;  // no power of two
  constexpr std::uint64_t kSeeds = 20'000;
  for (const double hurst : {0.15, 0.5, 0.9}) {
    const FractionalMotion motion(hurst, kSteps);
    std::array<std::array<double, kSteps + 1>, kSteps + 1> sums{};
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      const std::vector<double> one = motion({.stream = seed}, 3);
      ASSERT_EQ(one.size(), kSteps + 1);
      ASSERT_EQ(one[0], 0.0);
      for (std::size_t s = 0; s <= kSteps; ++s)
        for (std::size_t t = 0; t <= kSteps; ++t) sums[s][t] += one[s] * one[t] / static_cast<double>(kSeeds);
    }
    for (std::size_t s = 1; s <= kSteps; ++s) {
      for (std::size_t t = 1; t <= kSteps; ++t) {
        const auto of = [&](std::size_t a, std::size_t b) {
          return render::motionCovariance(hurst, static_cast<double>(a), static_cast<double>(b));
        };
        // Five standard errors of a mean of products.
        const double error =
            std::sqrt((of(s, s) * of(t, t) + of(s, t) * of(s, t)) / static_cast<double>(kSeeds));
        EXPECT_NEAR(sums[s][t], of(s, t), 5.0 * error) << hurst << ": " << s << ", " << t;
      }
    }
  }
}

TEST(FractionalMotion, FollowsFromItsKeyAndItem) {
  const FractionalMotion motion(0.7, 3000);  // longer than the numbers of one trial
  const std::vector<double> one = motion({.stream = 5, .node = 2}, 1);
  EXPECT_EQ(one, motion({.stream = 5, .node = 2}, 1));
  EXPECT_NE(one, motion({.stream = 5, .node = 2}, 2));
  EXPECT_NE(one, motion({.stream = 5, .node = 3}, 1));
  EXPECT_NE(one, motion({.stream = 6, .node = 2}, 1));
}

TEST(FractionalMotion, RefusesExponentsThatMeanNothing) {
  for (const double hurst : {0.0, 1.0, -0.3, 1.7, std::nan("")})
    EXPECT_THROW(FractionalMotion(hurst, 8), sim::InputError) << hurst;
  EXPECT_EQ(FractionalMotion(0.5, 0)({}, 0), std::vector<double>{0.0});
}

}  // namespace
}  // namespace espalier
