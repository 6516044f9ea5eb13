#include "sim/light/random_sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sim/base/parallel.h"
#include "tests/support/bit_worlds.h"
#include "tests/support/messages.h"

namespace espalier {
namespace {

using sim::RandomSky;
using sim::Vec3;
using sim::Voxel;
using sim::Weighting;

TEST(RandomSky, ScattersItsRaysEvenly) {
  const RandomSky sky{100, 1};
  const double spacing = sim::randomSkySpacing(100);
  int crowded = 0;
  Vec3 sum(0.0);
  for (int x = 0; x < 50; ++x) {
    const auto directions = sim::randomDirections(sky, {x, 3, 9});
    ASSERT_EQ(directions.size(), 100u);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      EXPECT_NEAR(glm::length(directions[i]), 1.0, 1e-12);
      EXPECT_GE(directions[i].y, 0.0);
      sum += directions[i] / 5000.0;
      for (std::size_t j = 0; j < i; ++j)
        crowded += std::abs(glm::dot(directions[i], directions[j])) > spacing;
    }
  }
  EXPECT_LT(crowded, 50);  // of 247,500 pairs
  EXPECT_NEAR(sum.y, 0.5, 0.005);
  EXPECT_NEAR(sum.x, 0.0, 0.01);
  EXPECT_NEAR(sum.z, 0.0, 0.01);
}

TEST(RandomSky, RaysFollowFromPlaceAndSeedAlone) {
  const auto here = sim::randomDirections({20, 1}, {1, 2, 3});
  EXPECT_EQ(sim::randomDirections({20, 1}, {1, 2, 3}), here);
  EXPECT_NE(sim::randomDirections({20, 2}, {1, 2, 3}), here);
  EXPECT_NE(sim::randomDirections({20, 1}, {3, 2, 1}), here);
}

TEST(RandomSky, OpenGroundSeesAllAndAWallHalf) {
  sim::BitVolume wall({40, 200, 201});
  tests::addBox(wall, {0, 0, 0}, {39, 0, 200});
  for (const auto weighting : {Weighting::uniform, Weighting::cosine, Weighting::cie_overcast})
    EXPECT_EQ(sim::lookOut(wall, {20, 1, 100}, {100, 1}, weighting).fraction(), 1.0);
  tests::addBox(wall, {0, 1, 0}, {0, 199, 200});
  double mean = 0.0;
  for (int z = 80; z < 120; ++z)
    mean += sim::lookOut(wall, {1, 1, z}, {100, 1}, Weighting::uniform).fraction();
  EXPECT_NEAR(mean / 40.0, 0.5, 0.02);
  const auto outlook = sim::lookOut(wall, {1, 1, 100}, {100, 1}, Weighting::uniform);
  EXPECT_GT(outlook.toward.x, 0.2 * outlook.sum);  // away from the wall
}

// The same world seen by a large set of lattice directions.
TEST(RandomSky, AgreesWithTheLatticeToWithinItsNoise) {
  const auto bits = tests::randomBits({30, 30, 30}, 0.02, 4);
  const auto lattice = sim::makeSky({Weighting::cosine, 0.005, 2000});
  const auto set = sim::receivedBy(lattice);
  double squares = 0.0;
  int count = 0;
  for (int z = 2; z < 28; z += 5) {
    for (int x = 2; x < 28; x += 5) {
      const double truth = sim::lookOut(bits, {x, 8, z}, set).fraction();
      squares += std::pow(sim::lookOut(bits, {x, 8, z}, {100, 1}, Weighting::cosine).fraction() - truth, 2);
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.05);
  EXPECT_GT(std::sqrt(squares / count), 0.01);  // what 100 rays cannot know
}

TEST(RandomSky, FillsFieldsLikeSingleLooksOnAnyNumberOfThreads) {
  const auto bits = tests::randomBits({17, 12, 13}, 0.05, 5);
  sim::BitVolume some({17, 12, 13});
  tests::addBox(some, {3, 2, 4}, {9, 5, 8});
  const auto where = std::make_shared<const sim::VoxelSet>(some);
  const RandomSky sky{20, 3};
  const auto field = sim::randomExposure(bits, sky, Weighting::uniform, where);
  const auto everywhere = sim::randomExposure(bits, sky, Weighting::uniform, nullptr);
  ASSERT_EQ(field.values.size(), where->count());
  for (const Voxel v : where->voxels()) {
    const auto sum = sim::lookOut(bits, v, sky, Weighting::uniform).sum;
    EXPECT_EQ(field.values[field.index(v)], sum);
    EXPECT_EQ(everywhere.values[everywhere.index(v)], sum);
  }
  sim::onThreads(3, [&] {
    EXPECT_EQ(sim::randomExposure(bits, sky, Weighting::uniform, nullptr).values, everywhere.values);
    EXPECT_NE(sim::randomExposure(bits, {20, 4}, Weighting::uniform, nullptr).values, everywhere.values);
  });
}

TEST(RandomSky, RefusesNoRays) {
  const sim::BitVolume bits({3, 3, 3});
  EXPECT_EQ(tests::messageOf([&] {
              sim::lookOut(bits, {1, 1, 1}, {0, 1}, Weighting::uniform);
            }),
            "a sky of 0 random rays; expected 1 to 4096");
  EXPECT_EQ(tests::messageOf([&] {
              sim::randomExposure(bits, {9999, 1}, Weighting::uniform, nullptr);
            }),
            "a sky of 9999 random rays; expected 1 to 4096");
}

}  // namespace
}  // namespace espalier
