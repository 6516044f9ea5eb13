#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "rules/growth/ways.h"
#include "tests/support/levels.h"
#include "tests/support/lively.h"

/// Angles of trials against the closed forms of their distributions.
namespace espalier::rules {
namespace {

constexpr int kTrials = 10'000;  // that one random key tells apart
constexpr int kKeys = 5;
const sim::Vec3 kWay = glm::normalize(sim::Vec3(0.3, 0.8, -0.5));

/// Whose trials are bent by nothing, and so long that the lattice of their ends does not show.
RuleSet wandering(double angle_deg, AngleDistribution distribution, std::vector<glm::dvec2> table = {}) {
  RuleSet rules;
  rules.random_tree.length = {1000.0};
  rules.random_tree.wander_deg = angle_deg;
  rules.random_tree.wander_distribution = distribution;
  rules.random_tree.wander_table = std::move(table);
  rules.random_tree.trials_min = rules.random_tree.trials_max = kTrials;
  return rules;
}

Ways tipsWays(const RuleSet& rules, std::uint32_t seed = 1) {
  Surroundings around;
  around.heading = kWay;
  return waysOf(rules, around, {}, {seed, 2, 0, 3}, 0, sim::Voxel(4000));
}

std::vector<sim::Vec3> directionsOf(const Ways& ways, int count = kTrials) {
  std::vector<sim::Vec3> directions;
  sim::Offsets ends;
  for (int first = 0; first < count; first += static_cast<int>(sim::Offsets::kMost)) {
    const std::size_t some =
        std::min<std::size_t>(sim::Offsets::kMost, static_cast<std::size_t>(count - first));
    trialEnds(ways, static_cast<unsigned>(first), some, ends);
    for (std::size_t i = 0; i < some; ++i)
      directions.push_back(glm::normalize(sim::Vec3(ends.x[i], ends.y[i], ends.z[i])));
  }
  return directions;
}

double angleOf(sim::Vec3 direction, sim::Vec3 way) {
  return std::atan2(glm::length(glm::cross(direction, way)), glm::dot(direction, way)) * 180.0 /
         std::numbers::pi;
}

std::vector<double> anglesOf(const Ways& ways, int count = kTrials) {
  std::vector<double> angles;
  for (const sim::Vec3& direction : directionsOf(ways, count))
    angles.push_back(angleOf(direction, sim::Vec3(ways.axis)));
  return angles;
}

/// In order, of many trials.
std::vector<double> manyAngles(const RuleSet& rules) {
  std::vector<double> all;
  for (std::uint32_t seed = 1; seed <= kKeys; ++seed) {
    const auto some = anglesOf(tipsWays(rules, seed));
    all.insert(all.end(), some.begin(), some.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// The mean, and the share below every angle (which holds all quantiles at once), within what chance allows:
/// a share may be off by 2 / root of n, where the largest of all deviations is more once in 1500 times.
void expectDistribution(const std::vector<double>& angles, const std::function<double(double)>& share_below,
                        double mean_deg, double deviation_deg) {
  const auto n = static_cast<double>(angles.size());
  double sum = 0.0, off = 0.0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    sum += angles[i];
    const double expected = share_below(angles[i]);
    off = std::max({off, expected - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - expected});
  }
  EXPECT_LT(off, 2.0 / std::sqrt(n));
  EXPECT_NEAR(sum / n, mean_deg, 3.0 * deviation_deg / std::sqrt(n));
}

double cosine(double degrees) {
  return std::cos(degrees * std::numbers::pi / 180.0);
}

TEST(Wander, OfAConeIsEvenOnTheSphere) {
  tests::onEveryLevel([] {
    const auto angles = manyAngles(wandering(30.0, AngleDistribution::cone));
    EXPECT_LE(angles.back(), 30.001);
    const double a = std::numbers::pi / 6.0, mean = (std::sin(a) - a * std::cos(a)) / (1.0 - std::cos(a));
    expectDistribution(
        angles, [](double t) { return (1.0 - cosine(t)) / (1.0 - cosine(30.0)); },
        mean * 180.0 / std::numbers::pi, 7.087);
  });
}

TEST(Wander, OfAGaussianIsRayleighs) {
  tests::onEveryLevel([] {
    const double deviation = 20.0;
    const auto angles = manyAngles(wandering(deviation, AngleDistribution::gaussian));
    expectDistribution(
        angles, [&](double t) { return 1.0 - std::exp(-0.5 * t * t / (deviation * deviation)); },
        deviation * std::sqrt(0.5 * std::numbers::pi), deviation * std::sqrt(2.0 - 0.5 * std::numbers::pi));
    // Its tail, which stepped tables would lose: of 50,000 about 17 lie beyond four deviations.
    const auto beyond = angles.end() - std::lower_bound(angles.begin(), angles.end(), 4.0 * deviation);
    EXPECT_GE(beyond, 5);
    EXPECT_LE(beyond, 34);
  });
}

TEST(Wander, OfAGaussianAcrossEitherAxisIsNormal) {
  const double deviation = 8.0;
  const sim::Vec3 side = glm::normalize(glm::cross(kWay, sim::Vec3(1, 0, 0))), other = glm::cross(kWay, side);
  double n = 0.0, square_side = 0.0, square_other = 0.0, both = 0.0, sum = 0.0;
  for (std::uint32_t seed = 1; seed <= kKeys; ++seed) {
    const Ways ways = tipsWays(wandering(deviation, AngleDistribution::gaussian), seed);
    for (const sim::Vec3& direction : directionsOf(ways)) {
      const sim::Vec3 across = direction - kWay * glm::dot(direction, kWay);
      const sim::Vec3 turned = across * (angleOf(direction, kWay) / std::max(1e-9, glm::length(across)));
      const double x = glm::dot(turned, side), y = glm::dot(turned, other);
      n += 1.0;
      sum += x + y;
      square_side += x * x;
      square_other += y * y;
      both += x * y;
    }
  }
  // A sample's deviation itself deviates by sigma / root of 2 n.
  EXPECT_NEAR(std::sqrt(square_side / n), deviation, 3.0 * deviation / std::sqrt(2.0 * n));
  EXPECT_NEAR(std::sqrt(square_other / n), deviation, 3.0 * deviation / std::sqrt(2.0 * n));
  EXPECT_NEAR(both / n, 0.0, 3.0 * deviation * deviation / std::sqrt(n));
  EXPECT_NEAR(sum / n, 0.0, 3.0 * deviation * std::sqrt(2.0 / n));
}

TEST(Wander, TurnsNoFartherThanBack) {
  const auto angles = manyAngles(wandering(90.0, AngleDistribution::gaussian));
  EXPECT_NEAR(angles.back(), 180.0, 0.01);
  const auto back = angles.end() - std::lower_bound(angles.begin(), angles.end(), 179.95);
  const double expected = std::exp(-2.0), n = static_cast<double>(angles.size());
  EXPECT_NEAR(static_cast<double>(back) / n, expected, 3.0 * std::sqrt(expected * (1.0 - expected) / n));
}

TEST(Wander, OfATableIsItsDensity) {
  tests::onEveryLevel([] {
    // A roof over [0, 1]: its deviation is 1 / root of 24.
    const auto roof =
        manyAngles(wandering(60.0, AngleDistribution::table, {{0.0, 0.0}, {0.5, 7.0}, {1.0, 0.0}}));
    EXPECT_LE(roof.back(), 60.001);
    expectDistribution(
        roof,
        [](double t) {
          const double s = std::min(1.0, t / 60.0);
          return s < 0.5 ? 2.0 * s * s : 1.0 - 2.0 * (1.0 - s) * (1.0 - s);
        },
        30.0, 60.0 / std::sqrt(24.0));
    // Even, and beyond the angle.
    expectDistribution(
        manyAngles(wandering(50.0, AngleDistribution::table, {{0.2, 3.0}, {2.0, 3.0}})),
        [](double t) { return std::clamp((t / 50.0 - 0.2) / 1.8, 0.0, 1.0); }, 55.0, 90.0 / std::sqrt(12.0));
    // A fall to nothing, a gap, and more on its other side: of 1, 1 and 2 quarters.
    const auto gap = manyAngles(wandering(
        90.0, AngleDistribution::table,
        {{0.0, 2.0}, {0.25, 0.0}, {0.5, 0.0}, {0.75, 0.0}, {0.75001, 1.0}, {1.0, 1.0}, {2.0, 0.0}}));
    const auto within = [&](double low, double high) {
      const auto from = std::upper_bound(gap.begin(), gap.end(), low),
                 to = std::lower_bound(gap.begin(), gap.end(), high);
      return static_cast<double>(to - from) / static_cast<double>(gap.size());
    };
    EXPECT_EQ(within(22.51, 67.49), 0.0);
    EXPECT_NEAR(within(-1.0, 22.51), 0.25, 0.006);
    EXPECT_NEAR(within(67.49, 90.0), 0.25, 0.006);
    EXPECT_NEAR(within(90.0, 181.0), 0.5, 0.007);
  });
}

TEST(Wander, WithoutADistributionIsACones) {
  RuleSet rules = wandering(25.0, AngleDistribution::cone);
  const auto named = directionsOf(tipsWays(rules));
  rules.random_tree.wander_distribution.reset();
  EXPECT_EQ(directionsOf(tipsWays(rules)), named);
  rules.random_tree.wander_table = {{0.0, 1.0}, {1.0, 0.0}};
  const auto tabled = directionsOf(tipsWays(rules));
  EXPECT_NE(tabled, named);
  rules.random_tree.wander_distribution = AngleDistribution::table;
  EXPECT_EQ(directionsOf(tipsWays(rules)), tabled);
  rules.random_tree.wander_distribution = AngleDistribution::cone;
  EXPECT_EQ(directionsOf(tipsWays(rules)), named);
}

TEST(Wander, GrowsWiderByEveryDistribution) {
  constexpr int kFew = 200, kNarrow = 50;
  for (const AngleDistribution distribution :
       {AngleDistribution::cone, AngleDistribution::gaussian, AngleDistribution::table}) {
    SCOPED_TRACE(static_cast<int>(distribution));
    Ways ways = tipsWays(wandering(10.0, distribution, {{0.0, 1.0}, {1.0, 2.0}}));
    const auto plain = anglesOf(ways, kFew);
    ways.narrow = kNarrow;
    ways.widest = kFew;
    ways.narrowly = 0.5f;
    const auto widened = anglesOf(ways, kFew);
    for (int i = 0; i < kFew; ++i) {
      const double wider = std::max(0, i - kNarrow + 1) / static_cast<double>(kFew - kNarrow);
      const double factor = 0.5 + wider;
      const auto at = static_cast<std::size_t>(i);
      if (distribution == AngleDistribution::cone) {
        const double heights = (1.0 - cosine(widened[at])) / (1.0 - cosine(plain[at]));
        EXPECT_NEAR(heights, (1.0 - cosine(10.0 * factor)) / (1.0 - cosine(10.0)), 0.01) << i;
      } else {
        EXPECT_NEAR(widened[at], factor * plain[at], 2e-3) << i;
      }
    }
  }
}

TEST(Wander, OfASeedStaysInItsCone) {
  Surroundings around;  // without a heading
  const auto ways = [&](AngleDistribution distribution) {
    return waysOf(wandering(20.0, distribution, {{0.0, 1.0}, {9.0, 1.0}}), around, {}, {1, 2, 0, 3}, 0,
                  sim::Voxel(4000));
  };
  const auto cone = directionsOf(ways(AngleDistribution::cone), 500);
  EXPECT_EQ(directionsOf(ways(AngleDistribution::gaussian), 500), cone);
  EXPECT_EQ(directionsOf(ways(AngleDistribution::table), 500), cone);
}

}  // namespace
}  // namespace espalier::rules
