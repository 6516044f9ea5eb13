#include "scenes/import/facing.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/base/parallel.h"
#include "sim/base/random.h"
#include "tests/support/meshes.h"

namespace espalier::scenes {
namespace {

using sim::Mesh;
using sim::Vec3;

/// Which triangles were turned, and what was said of it.
struct Found {
  std::vector<bool> turned;
  std::vector<FacingReport> reports;
  std::size_t count() const {
    return static_cast<std::size_t>(std::count(turned.begin(), turned.end(), true));
  }
};

Found found(const Mesh& mesh) {
  std::vector<sim::TiledMesh> meshes{{mesh, false, true}};
  Found result;
  result.reports = findFacing(meshes);
  result.turned = meshes[0].turned;
  result.turned.resize(mesh.triangles.size());
  return result;
}

const Vec3 kLow(-3, 0, -2), kHigh(4, 5, 3);

Mesh house() {
  return tests::boxMesh(kLow, kHigh, "house");
}

/// The same triangles, none of which shares a vertex with another.
Mesh soup(const Mesh& mesh) {
  Mesh loose = tests::emptyMesh(mesh.name);
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(loose.vertices_m.size());
    for (const std::uint32_t corner : t) loose.vertices_m.push_back(mesh.vertices_m[corner]);
    tests::addTriangle(loose, first, first + 1, first + 2);
  }
  return loose;
}

Mesh sheet(Vec3 corner, Vec3 u, Vec3 v) {
  Mesh mesh = tests::emptyMesh("sheet");
  mesh.vertices_m = {corner, corner + u, corner + u + v, corner + v};
  tests::addTriangle(mesh, 0, 1, 2);
  tests::addTriangle(mesh, 0, 2, 3);
  return mesh;
}

TEST(Facing, WhatFacesTheLightStays) {
  const Found f = found(house());
  EXPECT_EQ(f.count(), 0u);
  EXPECT_TRUE(f.reports.empty());
}

TEST(Facing, AHouseThatIsInsideOutIsTurnedWhole) {
  for (const Mesh& mesh : {tests::insideOut(house()), tests::insideOut(soup(house()))}) {
    const Found f = found(mesh);
    // Of loose faces the floor's underside is dark on both sides.
    EXPECT_GE(f.count(), mesh.triangles.size() - 2);
    ASSERT_EQ(f.reports.size(), 1u);
    EXPECT_EQ(f.reports[0].object, "house");
    EXPECT_EQ(f.reports[0].turned, f.count());
    EXPECT_GT(f.reports[0].area_share, 0.75);
  }
}

TEST(Facing, EachFaceThatIsWoundAgainstItsNeighboursIsTurned) {
  const Mesh ball = tests::sphereMesh(Vec3(2, 9, 1), 4.0, 12);
  Mesh mixed = ball;
  std::vector<bool> wrong(ball.triangles.size());
  for (std::uint32_t t = 0; t < ball.triangles.size(); ++t) {
    sim::Draws draws({8, t}, sim::Purpose::custom);
    wrong[t] = draws.uniform() < 0.45;
    if (wrong[t]) std::swap(mixed.triangles[t][1], mixed.triangles[t][2]);
  }
  EXPECT_EQ(found(mixed).turned, wrong);
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    wrong[t] = !wrong[t];
    std::swap(mixed.triangles[t][1], mixed.triangles[t][2]);
  }
  EXPECT_EQ(found(mixed).turned, wrong);
}

TEST(Facing, GroundFacesUp) {
  const Mesh down = sheet(Vec3(0), Vec3(8, 0, 0), Vec3(0, 0, 8));
  EXPECT_EQ(found(down).count(), 2u);
  EXPECT_EQ(found(tests::insideOut(down)).count(), 0u);
}

/// A wall that stands alone has light on both sides: nobody knows better than who made it.
TEST(Facing, WhatHasLightOnBothSidesStays) {
  const Mesh wall = sheet(Vec3(0), Vec3(8, 0, 0), Vec3(0, 3, 0));
  EXPECT_EQ(found(wall).count(), 0u);
  EXPECT_EQ(found(tests::insideOut(wall)).count(), 0u);
  const Mesh court = tests::insideOut(tests::without(house(), [](Vec3 p) { return p.y > 4.9; }));
  EXPECT_EQ(found(court).count(), 0u);
}

/// Other meshes stand in the light: a box in a closed box is dark on all sides.
TEST(Facing, WhatIsDarkOnBothSidesStays) {
  std::vector<sim::TiledMesh> meshes{
      {house(), false, true},
      {tests::insideOut(tests::boxMesh(Vec3(-1, 1, -1), Vec3(1, 2, 1))), false, true}};
  EXPECT_TRUE(findFacing(meshes).empty());
  EXPECT_TRUE(meshes[1].turned.empty());
}

TEST(Facing, WhoVouchesForItsWindingIsNotAsked) {
  for (const bool solid : {false, true}) {
    std::vector<sim::TiledMesh> meshes{{tests::insideOut(house()), solid}};
    EXPECT_TRUE(findFacing(meshes).empty());
    EXPECT_TRUE(meshes[0].turned.empty());
  }
}

TEST(Facing, DoesNotDependOnThreadsOrScale) {
  const Mesh mesh = tests::insideOut(soup(tests::sphereMesh(Vec3(2, 9, 1), 4.0, 12)));
  const Found one = found(mesh);
  for (const int threads : {1, 2, 5}) {
    sim::onThreads(threads, [&] { EXPECT_EQ(found(mesh).turned, one.turned); });
  }
  Mesh small = mesh;
  for (Vec3& p : small.vertices_m) p *= 0.001;
  EXPECT_EQ(found(small).turned, one.turned);
}

}  // namespace
}  // namespace espalier::scenes
