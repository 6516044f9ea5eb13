#include "sim/sense/peaks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace espalier::sim {
namespace {

/// A ridge along x whose height at each x is given, from y = 2 up, with every voxel below filled.
World ridge(const std::vector<int>& heights) {
  World world({Vec3(0.0), 0.04, {static_cast<int>(heights.size()), 32, 3}});
  const PartId part = world.addPart({"mesh", "ridge", PartKind::scene, -1});
  std::vector<TiledVoxel> voxels;
  for (int x = 0; x < static_cast<int>(heights.size()); ++x) {
    for (int y = 2; y <= heights[static_cast<std::size_t>(x)]; ++y)
      voxels.push_back({{x, y, 1}, {part, Colour(0.5f), 1.0f}});
  }
  world.occupy(voxels);
  return world;
}

std::vector<Vec3> peaks(const World& world, int prominence_vx) {
  const PartId part = 1;
  std::vector<Vec3> places;
  for (const Peak& peak : peaksOf(world, {&part, 1}, prominence_vx)) {
    EXPECT_EQ(peak.part, part);
    places.push_back(peak.at_vx);
  }
  return places;
}

TEST(Peaks, AreTheTopsThatOneMustGoDownFrom) {
  const World world = ridge({4, 8, 12, 8, 6, 9, 10, 10, 9, 8, 9, 8, 4});
  EXPECT_EQ(peaks(world, 3), (std::vector<Vec3>{{2, 12, 1}, {6.5, 10, 1}})) << "the last rises by one alone";
  EXPECT_EQ(peaks(world, 1), (std::vector<Vec3>{{2, 12, 1}, {6.5, 10, 1}, {10, 9, 1}}));
  EXPECT_EQ(peaks(world, 5), (std::vector<Vec3>{{2, 12, 1}}));
}

TEST(Peaks, StairsOfASlopeAreNone) {
  std::vector<int> heights;
  for (int x = 0; x < 40; ++x) heights.push_back(3 + (x < 27 ? x : 54 - x) * 2 / 3);
  EXPECT_EQ(peaks(ridge(heights), 3).size(), 1u);
}

TEST(Peaks, EachPieceHasOneAndALevelOneHasNone) {
  EXPECT_EQ(peaks(ridge({8, 6, 0, 0, 5, 7, 0, 0, 2, 2, 2}), 3), (std::vector<Vec3>{{0, 8, 1}, {5, 7, 1}}));
}

TEST(Peaks, GuidesHaveThemToo) {
  World world({Vec3(0.0), 0.04, {21, 21, 3}});
  const PartId part = world.addPart({"mesh", "arch", PartKind::scene, -1});
  std::vector<TiledVoxel> arch;
  for (int x = 0; x <= 20; ++x)
    arch.push_back({{x, static_cast<int>(std::sqrt(100.0 - (x - 10) * (x - 10))), 1}, {part}});
  world.addGuide(arch);
  EXPECT_EQ(peaks(world, 3), (std::vector<Vec3>{{10, 10, 1}}));
}

}  // namespace
}  // namespace espalier::sim
