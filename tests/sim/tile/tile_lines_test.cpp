#include <gtest/gtest.h>

#include <algorithm>

#include "sim/base/error.h"
#include "sim/tile/build_world.h"
#include "sim/tile/tiling.h"
#include "tests/support/meshes.h"
#include "tests/support/worlds.h"

/// Lines and guides in a world.
namespace espalier::sim {
namespace {

TiledMesh lines(const std::vector<std::pair<Vec3, Vec3>>& ends, bool guide = false) {
  TiledMesh tiled{tests::emptyMesh("wire")};
  tiled.mesh.regions = {"wire"};
  for (const auto& [from, to] : ends) tiled.lines.push_back({from, to, 0});
  tiled.guide = guide;
  return tiled;
}

TEST(TileLines, AreTheVoxelsThatTheirSegmentsPassAndNoOthers) {
  const Vec3 a(1.2, 2.3, 3.4), b(10.6, 8.1, 5.9), point(12, 1, 1);
  const World world = buildWorld(tests::unitFrame(Voxel(14)), {lines({{a, b}, {point, point}})}, 2);
  std::vector<Voxel> expected;
  tileSegment(voxelFromWorld(world.frame(), a), voxelFromWorld(world.frame(), b), expected);
  tileSegment(voxelFromWorld(world.frame(), point), voxelFromWorld(world.frame(), point), expected);
  EXPECT_EQ(world.occupied().count(), expected.size());
  for (const Voxel v : expected) EXPECT_EQ(world.partAt(v), 1) << v.x << " " << v.y << " " << v.z;
  EXPECT_EQ(world.opaque().count(), 0u) << "a line is too thin to take light";
}

TEST(TileLines, AreCutToTheWorld) {
  const World world =
      buildWorld(tests::unitFrame(Voxel(8)),
                 {lines({{Vec3(-1e6, 3, 3), Vec3(1e6, 3, 3)}, {Vec3(0, 99, 0), Vec3(9, 99, 9)}})}, 0);
  EXPECT_EQ(world.occupied().count(), 8u);
}

TEST(Guide, IsFeltAndStandsInNobodysWay) {
  const auto frame = tests::unitFrame(Voxel(12));
  const TiledMesh wire = lines({{Vec3(2, 6, 6), Vec3(9, 6, 6)}}),
                  guide = lines({{Vec3(2, 6, 6), Vec3(9, 6, 6)}}, true);
  const World real = buildWorld(frame, {wire}, 3), felt = buildWorld(frame, {guide}, 3);
  ASSERT_GT(real.occupied().count(), 0u);
  EXPECT_EQ(felt.occupied().count(), 0u);
  EXPECT_EQ(felt.solid().count(), 0u);
  EXPECT_EQ(felt.opaque().count(), 0u);
  for (int y = 0; y < 12; ++y) {
    for (int z = 0; z < 12; ++z) {
      for (int x = 0; x < 12; ++x) {
        const auto a = real.nearnessAt({x, y, z}), b = felt.nearnessAt({x, y, z});
        ASSERT_EQ(a.has_value(), b.has_value());
        if (a) { EXPECT_TRUE(a->layer == b->layer && a->part == b->part && a->distance_vx == b->distance_vx); }
      }
    }
  }
  World copy = felt;
  copy.setLayers(1);
  EXPECT_EQ(copy.nearnessAt({5, 6, 6})->layer, 0) << "a copy feels it too";
  EXPECT_EQ(copy.guideAt({5, 6, 6}), 1);
}

TEST(Guide, OfAMeshIsItsSurface) {
  TiledMesh box{tests::boxMesh({2, 2, 2}, {8, 8, 8}), false};
  box.guide = true;
  const World world = buildWorld(tests::unitFrame(Voxel(12)), {box}, 4);
  EXPECT_EQ(world.occupied().count(), 0u);
  EXPECT_EQ(world.nearnessAt({2, 5, 5})->layer, 0);
  EXPECT_EQ(world.nearnessAt({5, 5, 5})->layer, 3);
}

TEST(Guide, GivesWayToWhatStands) {
  const TiledMesh guide = lines({{Vec3(0, 6, 6), Vec3(11, 6, 6)}}, true);
  const World world = buildWorld(tests::unitFrame(Voxel(12)),
                                 {{tests::boxMesh({4.5, 4.5, 4.5}, {7.5, 7.5, 7.5}), true}, guide}, 2);
  EXPECT_EQ(world.guideAt({6, 6, 6}), kFree);
  EXPECT_EQ(world.part(world.nearnessAt({6, 6, 6})->part).object, "box");
  EXPECT_EQ(world.part(world.nearnessAt({1, 6, 6})->part).object, "wire");
}

}  // namespace
}  // namespace espalier::sim
