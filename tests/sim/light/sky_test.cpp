#include "sim/light/sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "sim/light/sky_shares.h"
#include "sim/world/field.h"
#include "tests/support/messages.h"

namespace espalier {
namespace {

using sim::Vec3;
using sim::Voxel;
using sim::Weighting;

constexpr double kWhole = sim::ExposureField::kWhole;

double total(const sim::DirectionSet& set) {
  return std::accumulate(set.begin(), set.end(), 0.0,
                         [](double sum, const auto& d) { return sum + d.weight; });
}

TEST(Sky, HasTheNumberOfDirectionsThatIsAskedFor) {
  for (const int count : {1, 2, 3, 16, 100, 128, 500, 4096}) {
    const auto set = sim::makeSky({.directions = count}).directions;
    EXPECT_EQ(set.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(total(set), kWhole) << count;
    for (std::size_t i = 0; i < set.size(); ++i) {
      const Voxel v = set[i].v;
      EXPECT_GE(v.y, 1);
      EXPECT_LE(std::max({std::abs(v.x), v.y, std::abs(v.z)}), sim::kLongestComponent);
      EXPECT_EQ(std::gcd(std::gcd(v.x, v.y), v.z), 1);
      EXPECT_EQ(set[i].crossed.back(), v);
      if (i > 0) {
        EXPECT_NE(v, set[i - 1].v);
      }
    }
  }
}

// The bound that sim/light/sky.h states.
TEST(Sky, IntegratesConstantsFirstHarmonicsAndTheSquaredHeight) {
  for (const int count : {16, 17, 24, 48, 100, 128, 256, 333, 512, 1000, 2048, 4096}) {
    double square = 0.0;
    Vec3 first(0.0);
    for (const auto& d : sim::makeSky({.directions = count}).directions) {
      const Vec3 unit = glm::normalize(Vec3(d.v));
      first += d.weight / kWhole * unit;
      square += d.weight / kWhole * unit.y * unit.y;
    }
    EXPECT_NEAR(first.x, 0.0, 1e-5) << count;
    EXPECT_NEAR(first.y, 0.5, 1e-5) << count;
    EXPECT_NEAR(first.z, 0.0, 1e-5) << count;
    EXPECT_NEAR(square, 1.0 / 3.0, 1e-5) << count;
  }
}

TEST(Sky, SharesAreThoseOfTheNearestDirection) {
  std::vector<Vec3> units;
  for (const auto& d : sim::makeSky({.directions = 40}).directions)
    units.push_back(glm::normalize(Vec3(d.v)));
  const auto shares = sim::voronoiShares(units);
  EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1.0, 1e-12);
  std::vector<double> counted(units.size());
  constexpr int kSamples = 200'000;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int s = 0; s < kSamples; ++s) {
    const double y = uniform(random), turn = 2.0 * std::numbers::pi * uniform(random);
    const double across = std::sqrt(1.0 - y * y);
    const Vec3 point(across * std::cos(turn), y, across * std::sin(turn));
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < units.size(); ++i) {
      if (glm::dot(units[i], point) > glm::dot(units[nearest], point)) nearest = i;
    }
    counted[nearest] += 1.0 / kSamples;
  }
  for (std::size_t i = 0; i < units.size(); ++i) EXPECT_NEAR(shares[i], counted[i], 0.002) << i;
}

TEST(Sky, WeightsAreEvenEnoughThatNoneCountsForMuch) {
  for (const auto& d : sim::makeSky({.directions = 256}).directions) {
    EXPECT_GT(d.weight, 0.5 * kWhole / 256);
    EXPECT_LT(d.weight, 1.5 * kWhole / 256);
  }
}

TEST(Sky, OpenGroundReceivesTheWholeOfEverySky) {
  for (const auto weighting : {Weighting::uniform, Weighting::cosine, Weighting::cie_overcast}) {
    const auto sky = sim::makeSky({weighting, 0.005, 200});
    EXPECT_EQ(total(sim::receivedBy(sky)), kWhole);
    // The directions' own sum is exact too, before it is made to be.
    double sum = 0.0;
    for (const auto& d : sky.directions)
      sum += d.weight / kWhole * sim::received(weighting, glm::normalize(Vec3(d.v)), Vec3(0, 1, 0));
    EXPECT_NEAR(sum, 1.0, 4e-5);
  }
}

TEST(Sky, AWallReceivesHalfAndLessUnderAnOvercastSky) {
  const auto wall = [](Weighting weighting, int count) {
    return total(sim::receivedBy(sim::makeSky({weighting, 0.005, count}), Vec3(1, 0, 0))) / kWhole;
  };
  EXPECT_NEAR(wall(Weighting::cosine, 256), 0.5, 1e-4);
  // Moon and Spencer's overcast sky: 3/14 + 4/(7 pi).
  EXPECT_NEAR(wall(Weighting::cie_overcast, 256), 0.39618, 1e-4);
  // And it is what the directions themselves add up to.
  for (const auto weighting : {Weighting::cosine, Weighting::cie_overcast}) {
    for (const Vec3 normal :
         {Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0.6, 0.8, 0.0), Vec3(0.48, -0.6, 0.64), Vec3(0, -1, 0)}) {
      const auto sky = sim::makeSky({weighting, 0.005, 2000});
      double sum = 0.0;
      for (const auto& d : sky.directions)
        sum += d.weight / kWhole * sim::received(weighting, glm::normalize(Vec3(d.v)), normal);
      EXPECT_NEAR(sum, sim::unobstructed(weighting, normal), 0.001);
      EXPECT_NEAR(total(sim::receivedBy(sky, normal)) / kWhole, sim::unobstructed(weighting, normal), 1e-5);
    }
  }
}

TEST(Sky, ASurfaceReceivesNothingFromBehind) {
  const auto sky = sim::makeSky({Weighting::cosine, 0.005, 200});
  for (const auto& d : sim::receivedBy(sky, Vec3(1, 0, 0))) EXPECT_EQ(d.weight == 0, d.v.x <= 0);
}

TEST(Sky, TakesMoreDirectionsForASmallerError) {
  std::size_t last = 0;
  for (const double error : {0.05, 0.02, 0.01, 0.005, 0.002}) {
    const auto sky = sim::makeSky({.standard_error = error});
    EXPECT_LE(sky.standard_error, error);
    EXPECT_GT(sky.directions.size(), last);
    last = sky.directions.size();
  }
}

TEST(Sky, RefusesWhatMakesNoSky) {
  using tests::messageOf;
  EXPECT_EQ(messageOf([] { sim::makeSky({.directions = 0}); }), "a sky of 0 directions; expected 1 to 4096");
  EXPECT_EQ(messageOf([] { sim::makeSky({.directions = 5000}); }),
            "a sky of 5000 directions; expected 1 to 4096");
  EXPECT_EQ(messageOf([] { sim::makeSky({.standard_error = 0.0001}); }),
            "a standard error of 0.0001 for a uniform sky would need more than 4096 directions; expected at "
            "least 0.001");
  for (const double error : {0.0, -1.0, std::nan("")}) {
    const auto message = messageOf([&] { sim::makeSky({.standard_error = error}); });
    EXPECT_NE(message.find("expected at least 0.001"), message.npos) << message;
  }
}

TEST(Sky, SaysWhatItIs) {
  EXPECT_EQ(sim::describe(sim::makeSky({Weighting::cosine, 0.005, 256})),
            "cosine-weighted view factor, 256 directions, standard error 0.008");
  EXPECT_EQ(sim::describe(sim::makeSky({Weighting::cie_overcast, 0.01})).substr(0, 17), "CIE overcast sky,");
}

}  // namespace
}  // namespace espalier
