#include "sim/sweep/directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sim/light/sky.h"
#include "sim/world/field.h"

namespace espalier {
namespace {

using sim::Vec3;
using sim::Voxel;

int total(const sim::DirectionSet& set) {
  return std::accumulate(set.begin(), set.end(), 0, [](int sum, const auto& d) { return sum + d.weight; });
}

TEST(Directions, WeightsFollowTheSharesAndAddUp) {
  const std::vector<Voxel> vectors{{0, 1, 0}, {1, 1, 0}, {0, 1, 1}, {1, 1, 1}};
  const auto set = sim::directionSet(vectors, {0.5, 0.25, 0.0, 0.25}, 10);
  EXPECT_EQ(total(set), 10);
  EXPECT_EQ(set[0].weight, 5);
  EXPECT_EQ(set[1].weight + set[3].weight, 5);
  EXPECT_EQ(set[2].weight, 0);
  EXPECT_EQ(total(sim::directionSet(vectors, {0, 0, 0, 0}, 10)), 0);
}

TEST(Directions, CrossAsManyVoxelsAsThereAreStepsBetweenNeighbours) {
  for (const auto& d : sim::makeSky({.directions = 128}).directions) {
    // One voxel is entered through one face at a time.
    EXPECT_EQ(static_cast<int>(d.crossed.size()), sim::crossedCount(d.v));
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

TEST(Directions, VectorsAroundADirectionComeByTheirSize) {
  const Vec3 unit = glm::normalize(Vec3(-0.4, 0.01, 0.3));
  for (const int lowest : {0, 1}) {
    int last = 0;
    bool any_level = false;
    sim::forEachLatticeVector(unit, lowest, [&](int longest, Voxel v) {
      EXPECT_EQ(longest, std::max({std::abs(v.x), v.y, std::abs(v.z)}));
      EXPECT_GE(longest, last);
      EXPECT_GE(v.y, lowest);
      last = longest;
      any_level = any_level || v.y == 0;
      return true;
    });
    EXPECT_EQ(last, sim::kLongestComponent);
    EXPECT_EQ(any_level, lowest == 0);
  }
}

TEST(Directions, SineBetweenIsOfTheAngle) {
  EXPECT_NEAR(sim::sineBetween({1, 1, 0}, Vec3(0, 1, 0)), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(sim::sineBetween({0, 7, 0}, Vec3(0, 1, 0)), 0.0, 1e-15);
  EXPECT_EQ(sim::sineBetween({0, 0, 1}, Vec3(0, 1, 0)), 1.0);
  EXPECT_EQ(sim::sineBetween({0, 1, 0}, Vec3(0, -1, 0)), 1.0);
}

}  // namespace
}  // namespace espalier
