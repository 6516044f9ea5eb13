#include "sim/directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "sim/field.h"
#include "sim/sky.h"
#include "sim/sun.h"

namespace espalier {
namespace {

using sim::Vec3;
using sim::Voxel;

int total(const sim::DirectionSet& set) {
  return std::accumulate(set.begin(), set.end(), 0, [](int sum, const auto& d) { return sum + d.weight; });
}

Vec3 moment(const sim::DirectionSet& set) {
  Vec3 sum(0.0);
  for (const auto& d : set)
    sum += static_cast<double>(d.weight) / sim::ExposureField::kWhole * glm::normalize(Vec3(d.v));
  return sum;
}

TEST(Directions, WeightsAddUpToTheWhole) {
  for (const int count : {1, 16, 100, 128, 500}) {
    EXPECT_EQ(total(sim::makeSky({.directions = count}).directions), sim::ExposureField::kWhole) << count;
    EXPECT_EQ(total(sim::makeSun({20.0, 135.0, count}).directions), sim::ExposureField::kWhole) << count;
  }
}

TEST(Directions, ArePrimitiveAndLookUp) {
  for (const auto& d : sim::makeSky({.directions = 300}).directions) {
    EXPECT_GE(d.v.y, 1);
    EXPECT_EQ(std::gcd(std::gcd(d.v.x, d.v.y), d.v.z), 1);
    EXPECT_EQ(d.crossed.back(), d.v);
  }
}

// The mean of the height over a uniform hemisphere is 1/2, and over one weighted by the cosine 2/3.
TEST(Directions, IntegrateTheHeightOfTheSky) {
  const Vec3 uniform = moment(sim::makeSky({.directions = 128}).directions);
  EXPECT_NEAR(uniform.y, 0.5, 0.004);
  EXPECT_NEAR(uniform.x, 0.0, 0.004);
  EXPECT_NEAR(uniform.z, 0.0, 0.004);
  EXPECT_NEAR(moment(sim::receivedBy(sim::makeSky({sim::Weighting::cosine, 0.005, 128}))).y, 2.0 / 3.0,
              0.004);
}

TEST(Directions, CosineWeightingLeavesOutWhatLiesBehindTheSurface) {
  for (const auto& d : sim::receivedBy(sim::makeSky({sim::Weighting::cosine, 0.005, 200}), Vec3(1, 0, 0)))
    EXPECT_EQ(d.weight == 0, d.v.x <= 0);
}

TEST(Directions, CrossAsManyVoxelsAsThereAreStepsBetweenNeighbours) {
  for (const auto& d : sim::makeSky({.directions = 128}).directions) {
    // One voxel is entered through one face at a time.
    EXPECT_EQ(static_cast<int>(d.crossed.size()), std::abs(d.v.x) + std::abs(d.v.y) + std::abs(d.v.z));
    Voxel last(0);
    for (const Voxel o : d.crossed) {
      const Voxel step = glm::abs(o - last);
      EXPECT_EQ(step.x + step.y + step.z, 1);
      last = o;
    }
  }
}

TEST(Directions, TheNearestLatticeVectorIsTheNearest) {
  for (const Vec3 wanted :
       {Vec3(0.3, 0.5, -0.8), Vec3(0.01, 0.99, 0.02), Vec3(-0.9, 0.05, 0.4), Vec3(0.57, 0.58, 0.58)}) {
    const Vec3 unit = glm::normalize(wanted);
    double best = -2.0;
    for (int y = 1; y <= 9; ++y) {
      for (int z = -9; z <= 9; ++z) {
        for (int x = -9; x <= 9; ++x) best = std::max(best, glm::dot(glm::normalize(Vec3(x, y, z)), unit));
      }
    }
    EXPECT_NEAR(glm::dot(glm::normalize(Vec3(sim::nearestLatticeVector(unit, 9))), unit), best, 1e-12);
  }
}

TEST(Sun, RisesInTheEastAndLeansTheWayItIsTold) {
  const sim::SunArc south{20.0, 180.0, 48};
  const Vec3 rise = sim::sunDirection(south, 6.0), noon = sim::sunDirection(south, 12.0);
  EXPECT_NEAR(rise.x, 1.0, 1e-6);
  EXPECT_NEAR(noon.y, std::cos(20.0 * std::numbers::pi / 180.0), 1e-6);
  EXPECT_GT(noon.z, 0.3);
  for (const auto& d : sim::makeSun(south).directions) EXPECT_GE(d.v.z, 0);
  EXPECT_GT(sim::sunDirection({20.0, 90.0, 1}, 12.0).x, 0.3);
}

TEST(Sun, LatticeDirectionsLieWithinADegreeAndAHalfOfTheArc) {
  const Vec3 pole = glm::normalize(
      glm::cross(sim::sunDirection({20.0, 150.0, 48}, 6.0), sim::sunDirection({20.0, 150.0, 48}, 12.0)));
  for (const auto& d : sim::makeSun({20.0, 150.0, 48}).directions) {
    const double off =
        std::asin(std::abs(glm::dot(glm::normalize(Vec3(d.v)), pole))) * 180.0 / std::numbers::pi;
    EXPECT_LT(off, 1.5);
  }
}

}  // namespace
}  // namespace espalier
