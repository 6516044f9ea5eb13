#include "scenes/inspect/surface.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

/// What is found wrong with surfaces, on meshes with known faults.
namespace espalier::scenes {
namespace {

using sim::Mesh;
using sim::Vec3;

void turn(Mesh& mesh, std::size_t triangle) {
  std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
}

void drop(Mesh& mesh, std::size_t triangles) {
  mesh.triangles.resize(mesh.triangles.size() - triangles);
  mesh.region.resize(mesh.triangles.size());
  mesh.material.resize(mesh.triangles.size());
}

TEST(Surface, OfABoxIsClosedAndSolid) {
  const Surface box = surfaceOf(tests::boxMesh({0, 0, 0}, {2, 3, 5}));
  EXPECT_EQ(box.corners, 8u);
  EXPECT_EQ(box.open_edges + box.rims + box.crowded_edges + box.flipped + box.duplicates, 0u);
  EXPECT_NEAR(box.winding, 1.0, 1e-9);
  EXPECT_EQ(bodyOf(box.winding), Body::solid);
  ASSERT_EQ(box.pieces.size(), 1u);
  EXPECT_DOUBLE_EQ(box.pieces[0].area, 62.0);
  ASSERT_EQ(box.regions.size(), 1u);
  EXPECT_DOUBLE_EQ(box.regions[0].area, 62.0);
  EXPECT_EQ(box.regions[0].triangles, 12u);
}

TEST(Surface, ThatLooksInwardsIsToldFromOneWithTurnedTriangles) {
  Mesh ball = tests::insideOut(tests::sphereMesh({0, 0, 0}, 1.0, 12));
  const Surface inward = surfaceOf(ball);
  EXPECT_NEAR(inward.winding, -1.0, 0.05);
  EXPECT_EQ(bodyOf(inward.winding), Body::inside_out);
  EXPECT_EQ(inward.flipped, 0u);
  for (const std::size_t t : {3u, 50u, 120u}) turn(ball, t);
  EXPECT_EQ(surfaceOf(ball).flipped, 3u);
}

TEST(Surface, WithHolesHasARimForEachAndIsSolidStill) {
  Mesh ball = tests::sphereMesh({0, 0, 0}, 1.0, 24);
  std::swap(ball.triangles[100], ball.triangles[ball.triangles.size() - 2]);
  drop(ball, 2);
  const Surface holed = surfaceOf(ball);
  EXPECT_EQ(holed.open_edges, 6u);
  EXPECT_EQ(holed.rims, 2u);
  EXPECT_EQ(bodyOf(holed.winding), Body::solid);
}

TEST(Surface, ThatIsASheetHasNoInside) {
  Mesh sheet = tests::emptyMesh("sheet");
  sheet.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
  tests::addTriangle(sheet, 0, 2, 1);
  tests::addTriangle(sheet, 0, 3, 2);
  const Surface found = surfaceOf(sheet);
  EXPECT_EQ(found.winding, 0.0);
  EXPECT_EQ(bodyOf(found.winding), Body::sheet);
  EXPECT_EQ(found.open_edges, 4u);
  EXPECT_EQ(found.rims, 1u);
}

TEST(Surface, HalfABallIsWideOpen) {
  Mesh ball = tests::sphereMesh({0, 0, 0}, 1.0, 24);
  Mesh half = ball;
  half.triangles.clear();
  half.region.clear();
  half.material.clear();
  for (const auto& [a, b, c] : ball.triangles) {
    if (ball.vertices_m[a].y + ball.vertices_m[b].y + ball.vertices_m[c].y > 0.0)
      tests::addTriangle(half, a, b, c);
  }
  const Surface found = surfaceOf(half);
  EXPECT_EQ(bodyOf(found.winding), Body::open);
  EXPECT_EQ(found.rims, 1u);
}

TEST(Surface, UnweldedCornersAreOneAndDuplicatesAreCounted) {
  const Mesh box = tests::boxMesh({0, 0, 0}, {1, 1, 1});
  Mesh loose = tests::emptyMesh("loose");
  for (const auto& triangle : box.triangles) {
    for (const auto corner : triangle) loose.vertices_m.push_back(box.vertices_m[corner]);
    const auto n = static_cast<std::uint32_t>(loose.vertices_m.size());
    tests::addTriangle(loose, n - 3, n - 2, n - 1);
  }
  EXPECT_EQ(surfaceOf(loose).corners, 8u);
  EXPECT_EQ(surfaceOf(loose).open_edges, 0u);
  tests::addTriangle(loose, 4, 3, 5);  // the other way round
  const Surface twice = surfaceOf(loose);
  EXPECT_EQ(twice.duplicates, 1u);
  EXPECT_EQ(twice.crowded_edges, 3u);
}

TEST(Surface, PiecesAreToldApartTheLargestFirst) {
  const Mesh large = tests::insideOut(tests::boxMesh({5, 0, 0}, {8, 3, 3}));
  const Surface found = surfaceOf(tests::together(tests::boxMesh({0, 0, 0}, {1, 1, 1}), large));
  ASSERT_EQ(found.pieces.size(), 2u);
  EXPECT_DOUBLE_EQ(found.pieces[0].area, 54.0);
  EXPECT_EQ(bodyOf(found.pieces[0].winding.value()), Body::inside_out);
  EXPECT_EQ(bodyOf(found.pieces[1].winding.value()), Body::solid);
}

/// A room within walls: its faces look into the room, away from what is solid.
TEST(Surface, ACavityIsNotInsideOut) {
  const Mesh room = tests::insideOut(tests::boxMesh({1, 1, 1}, {3, 3, 3}));
  const Surface found = surfaceOf(tests::together(tests::boxMesh({0, 0, 0}, {4, 4, 4}), room));
  for (const SurfacePart& piece : found.pieces) EXPECT_EQ(bodyOf(piece.winding.value()), Body::solid);
}

}  // namespace
}  // namespace espalier::scenes
