#include "sim/light/exposure.h"

#include <gtest/gtest.h>

#include "sim/light/sky.h"
#include "sim/light/sun.h"
#include "sim/sweep/sweep.h"
#include "tests/support/bit_worlds.h"

// Closed forms of how much sky is seen (radiation heat transfer). Voxel error comes on top and shrinks with
// the voxel.
namespace espalier {
namespace {

using sim::Vec3;
using sim::Voxel;

constexpr int kDirections = 1000;  // so that what is left is the voxels' error

TEST(SkyExposure, OpenGroundSeesAll) {
  sim::BitVolume ground({31, 12, 29});
  tests::addBox(ground, {0, 0, 0}, {30, 0, 28});
  const auto field = sim::sweepExposure(ground, sim::makeSky({.directions = 128}).directions);
  for (int x = 0; x < 31; ++x) EXPECT_EQ(field.at({x, 1, 14}), 1.0f);
}

TEST(SkyExposure, TheFootOfAnEndlessWallSeesHalf) {
  sim::BitVolume wall({60, 400, 401});
  tests::addBox(wall, {0, 0, 0}, {0, 399, 400});
  for (const auto weighting : {sim::Weighting::uniform, sim::Weighting::cosine}) {
    const auto outlook =
        sim::lookOut(wall, {1, 1, 200}, sim::receivedBy(sim::makeSky({weighting, 0.005, kDirections})));
    EXPECT_NEAR(outlook.fraction(), 0.5, 0.02);
  }
}

TEST(SunExposure, ASunThatLeansAwayIsHiddenByTheWall) {
  sim::BitVolume wall({81, 60, 41});
  tests::addBox(wall, {0, 0, 20}, {80, 59, 20});
  const auto leaning_south = sim::makeSun({20.0, 180.0, 48}).directions;
  EXPECT_EQ(sim::lookOut(wall, {40, 1, 21}, leaning_south).fraction(), 1.0);   // the bright side
  EXPECT_LT(sim::lookOut(wall, {40, 1, 19}, leaning_south).fraction(), 0.35);  // behind it
}

TEST(Outlook, TheBrightestWayLeadsOutOfACornerUpwards) {
  sim::BitVolume corner({40, 40, 40});
  tests::addBox(corner, {0, 0, 0}, {0, 39, 39});
  tests::addBox(corner, {0, 0, 0}, {39, 39, 0});
  const Vec3 toward =
      glm::normalize(sim::lookOut(corner, {1, 1, 1}, sim::makeSky({.directions = 200}).directions).toward);
  EXPECT_GT(toward.x, 0.3);
  EXPECT_GT(toward.y, 0.3);
  EXPECT_NEAR(toward.x, toward.z, 0.05);
}

}  // namespace
}  // namespace espalier
