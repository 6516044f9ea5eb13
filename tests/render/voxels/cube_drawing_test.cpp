#include "render/voxels/cube_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/voxels/pale_scene.h"
#include "sim/tile/tiling.h"
#include "tests/support/golden.h"

namespace espalier::render {
namespace {

using sim::Vec3;
using sim::Voxel;

constexpr sim::Colour kRed(0.6f, 0.05f, 0.03f), kBlue(0.02f, 0.1f, 0.6f);
const Camera kAside{{13.0, 9.5, 16.0}, {2.5, 2.2, 2.5}, 30.0};
const Camera kInFront{{2.5, 2.5, 30.0}, {2.5, 2.5, 0.0}, 14.0};

/// Voxels of a metre, the first one's low corner at the origin.
sim::Frame five() {
  sim::Frame frame;
  frame.size = Voxel(5);
  frame.voxel_m = 1.0;
  frame.origin_m = Vec3(0.5);
  return frame;
}

CubeWorld worldOf(const std::vector<Voxel>& voxels, sim::Colour colour = kRed) {
  CubeWorld world{five(), {}, {}, {}};
  for (const Voxel v : voxels) world.cubes.push_back({v, colour});
  return world;
}

/// The colour of a place of the world, in a picture of 200 x 200 pixels from in front.
sim::Colour at(const Image& picture, Vec3 place_m) {
  const glm::vec2 p = Projection(kInFront, 200, 200).pixel(place_m);
  const float* pixel = picture.at(static_cast<int>(p.x), static_cast<int>(p.y));
  return {pixel[0], pixel[1], pixel[2]};
}

Image inFront(const CubeWorld& world) {
  return drawCubes(world, kInFront, 200, 200);
}

TEST(CubeDrawing, ATriangleAndALineInTheirVoxels) {
  CubeWorld world = worldOf({});
  const std::array<Vec3, 3> corners{{{0.4, 0.5, 3.9}, {3.2, 0.8, 2.6}, {1.5, 4.2, 1.8}}};
  const Vec3 from(4.5, 0.5, 3.2), to(4.2, 4.6, 0.6);
  std::vector<Voxel> red, blue;
  const auto vx = [](Vec3 p) { return p - 0.5; };
  sim::tileTriangle({vx(corners[0]), vx(corners[1]), vx(corners[2])}, red);
  sim::tileSegment(vx(from), vx(to), blue);
  for (const Voxel v : red) world.cubes.push_back({v, kRed});
  for (const Voxel v : blue) world.cubes.push_back({v, kBlue});
  world.triangles.push_back({corners, {true, true, true}, kRed});
  world.lines.push_back({from, to, kBlue});
  tests::expectLikeGolden(drawCubes(world, kAside, 240, 240), "cubes");
}

TEST(CubeDrawing, NearCubesLieOverFarOnes) {
  CubeWorld world = worldOf({{2, 2, 4}}, kRed);
  world.cubes.push_back({{2, 2, 0}, kBlue});
  const sim::Colour red_first = at(inFront(world), {2.3, 2.3, 5.0});
  std::swap(world.cubes[0].colour, world.cubes[1].colour);
  const sim::Colour blue_first = at(inFront(world), {2.3, 2.3, 5.0});
  EXPECT_GT(red_first.r - red_first.b, 0.05f);
  EXPECT_GT(blue_first.b - blue_first.r, 0.05f);
  std::reverse(world.cubes.begin(), world.cubes.end());
  EXPECT_EQ(at(inFront(world), {2.3, 2.3, 5.0}), blue_first) << "whatever their order";
}

TEST(CubeDrawing, PrimitivesAreSeenInCubesAndNowhereElse) {
  CubeWorld world = worldOf({{2, 2, 2}});
  const Image without = inFront(world);
  world.triangles.push_back({{{{0, 0, 2.5}, {5, 0, 2.5}, {2.5, 5, 2.5}}}, {true, true, true}, kBlue});
  world.lines.push_back({{0, 2.2, 2.5}, {5, 2.2, 2.5}, kBlue});
  const Image with = inFront(world);
  EXPECT_NE(at(with, {2.4, 2.6, 3.0}), at(without, {2.4, 2.6, 3.0}));
  for (const Vec3 beside : {Vec3(1.4, 1.4, 3.0), {3.6, 2.2, 3.0}, {2.5, 3.6, 3.0}, {0.5, 2.2, 3.0}})
    EXPECT_EQ(at(with, beside), at(without, beside)) << beside.x;
}

TEST(CubeDrawing, ACutPolygonShowsNoCut) {
  CubeWorld world = worldOf({{2, 2, 2}});
  const Vec3 a(2.1, 2.1, 2.5), b(2.9, 2.1, 2.5), c(2.9, 2.9, 2.5), d(2.1, 2.9, 2.5);
  world.triangles.push_back({{a, b, c}, {true, true, false}, kBlue});
  world.triangles.push_back({{a, c, d}, {false, true, true}, kBlue});
  const Image picture = inFront(world);
  const sim::Colour inside = at(picture, {2.6, 2.35, 2.5});
  EXPECT_LT(glm::length(at(picture, {2.5, 2.5, 2.5}) - inside), 0.01f);
  world.triangles[0].border[2] = world.triangles[1].border[0] = true;
  EXPECT_GT(glm::length(at(inFront(world), {2.5, 2.5, 2.5}) - inside), 0.1f) << "and a bend would be drawn";
}

TEST(CubeDrawing, FacesBetweenCubesAreLeftOut) {
  // From in front a row of five is as one: its inner faces would darken it.
  std::vector<Voxel> row;
  for (int z = 0; z < 5; ++z) row.push_back({2, 2, z});
  const sim::Colour long_row = at(inFront(worldOf(row)), {2.4, 2.4, 5.0});
  const sim::Colour ends = at(inFront(worldOf({{2, 2, 0}, {2, 2, 4}})), {2.4, 2.4, 5.0});
  EXPECT_GT(long_row.g, ends.g + 0.03f);
}

TEST(CubeDrawing, AnEmptyWorldIsItsLatticeAndWhatLiesBehindTheEyeIsLeftOut) {
  const Image empty = inFront(worldOf({}));
  EXPECT_NE(empty.pixels, paper(200, 200).pixels);
  // From within the world, turned away from the cubes.
  const Camera within{{2.5, 2.5, 2.5}, {2.5, 2.5, 9.0}, 60.0};
  const Image seen = drawCubes(worldOf({{2, 2, 0}, {1, 1, 1}}), within, 60, 60);
  EXPECT_EQ(seen.width, 60);
  for (const float value : seen.pixels) ASSERT_TRUE(value >= 0.0f && value <= 1.0f);
}

}  // namespace
}  // namespace espalier::render
