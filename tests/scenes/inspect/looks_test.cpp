#include "scenes/inspect/looks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scenes/import/mesh_import.h"
#include "scenes/inspect/inspected.h"
#include "tests/support/meshes.h"
#include "tests/support/scratch.h"

/// What a mesh is taken for that says nothing of itself.
namespace espalier::scenes {
namespace {

using sim::Mesh;
using sim::Vec3;

/// z up in the file: what `up: z` turns back.
Mesh lying(Mesh mesh) {
  for (Vec3& p : mesh.vertices_m) p = {p.x, -p.z, p.y};
  return mesh;
}

Mesh scaled(Mesh mesh, double by) {
  for (Vec3& p : mesh.vertices_m) p *= by;
  return mesh;
}

/// Walls on the ground, about the origin, without floor and roof.
Mesh walls() {
  Mesh mesh = tests::boxMesh({-4, 0, -3}, {4, 3, 3});
  mesh.triangles.erase(mesh.triangles.begin() + 4, mesh.triangles.begin() + 8);
  mesh.region.resize(mesh.triangles.size());
  mesh.material.resize(mesh.triangles.size());
  return mesh;
}

TEST(Looks, WhatStandsOnTheGroundIsUprightWhicheverWayItsAxesGo) {
  for (const Mesh& mesh :
       {walls(), tests::boxMesh({-4, 0, -3}, {4, 3, 3}), tests::boxMesh({-4, -0.1, -3}, {4, 0, 3}),
        tests::terrainMesh(8, 1.0, [](double x, double z) { return 0.2 * std::sin(x) + 0.1 * z; })}) {
    const UpLooks up = upOf(shapeOf(mesh), false), turned = upOf(shapeOf(lying(mesh)), false);
    EXPECT_EQ(up.up, UpAxis::y) << up.why;
    EXPECT_EQ(turned.up, UpAxis::z) << turned.why;
    EXPECT_TRUE(up.sure && turned.sure);
    EXPECT_EQ(up.why.empty(), false);
  }
}

TEST(Looks, NothingIsToldOfABall) {
  const UpLooks up = upOf(shapeOf(tests::sphereMesh({0, 0, 0}, 1.0, 12)), false);
  EXPECT_EQ(up.up, UpAxis::y);
  EXPECT_FALSE(up.sure);
}

TEST(Looks, AFormatThatSaysYIsBelievedUntilMuchSpeaksAgainstIt) {
  const MeshShape ball = shapeOf(tests::sphereMesh({0, 0, 0}, 1.0, 12));
  EXPECT_TRUE(upOf(ball, true).sure);
  EXPECT_EQ(upOf(shapeOf(lying(walls())), true).up, UpAxis::z);
}

TEST(Looks, UnitsAreThoseThatMakeAHouseOfIt) {
  const auto unit = [](const Mesh& mesh, UpAxis up) { return unitOf(shapeOf(mesh), up, false).unit; };
  EXPECT_EQ(unit(walls(), UpAxis::y), LengthUnit::m);
  EXPECT_EQ(unit(scaled(walls(), 100.0), UpAxis::y), LengthUnit::cm);
  EXPECT_EQ(unit(scaled(walls(), 1000.0), UpAxis::y), LengthUnit::mm);
  EXPECT_EQ(unit(scaled(lying(walls()), 100.0), UpAxis::z), LengthUnit::cm);
  EXPECT_EQ(unit(tests::boxMesh({0, 0, 0}, {0.1, 0.2, 0.1}), UpAxis::y), LengthUnit::m);
  EXPECT_EQ(unit(tests::terrainMesh(8, 300.0, [](double x, double) { return 0.2 * x; }), UpAxis::y),
            LengthUnit::m);
  EXPECT_EQ(unit(tests::boxMesh({0, 0, 0}, {900, 60, 700}), UpAxis::y), LengthUnit::m);
}

TEST(Looks, OfAFileBecomeTheLinesOfAScene) {
  const tests::Scratch scratch;
  std::string text;
  const Mesh mesh = scaled(lying(walls()), 100.0);
  for (const Vec3& p : mesh.vertices_m) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  const Inspected found = inspectMesh(scratch.write("walls.obj", text)).found;
  EXPECT_EQ(found.line.placement.unit, LengthUnit::cm);
  EXPECT_EQ(found.line.placement.up, UpAxis::z);
  EXPECT_EQ(found.line.name, "walls");
  EXPECT_FALSE(found.line.solid);
  EXPECT_LT(glm::distance(found.low_m, Vec3(-4, 0, -3)), 1e-6);
  EXPECT_LT(glm::distance(found.high_m, Vec3(4, 3, 3)), 1e-6);
  EXPECT_EQ(found.surface.rims, 2u);
}

TEST(Looks, WhatLiesFarAwayIsBroughtToTheOrigin) {
  const tests::Scratch scratch;
  std::string text;
  for (const Vec3& p : walls().vertices_m) text += fmt::format("v {} {} {}\n", p.x + 20'000, p.y + 400, p.z);
  const Inspected found =
      inspectMesh(scratch.write("far.obj", text + "f 1 2 3\nf 2 3 4\nf 5 6 7\nf 1 2 5\n")).found;
  EXPECT_NEAR(found.from_origin_m, 20'004, 1.0);
  EXPECT_EQ(found.line.placement.translate_m, Vec3(-20'000, -400, 0));
  EXPECT_LT(std::abs(found.low_m.x + 4.0), 0.01);
}

/// A mesh is read once, and has the regions all the same that reading it by materials would give it.
TEST(Looks, RegionsFromMaterialsAreThoseOfTheReader) {
  const tests::Scratch scratch;
  scratch.write("walls.mtl", "newmtl lime\nKd 1 1 1\nnewmtl brick\nKd 0.5 0.1 0.1\n");
  std::string text = "mtllib walls.mtl\ng all\n";
  for (const Vec3& p : walls().vertices_m) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  const auto file = scratch.write("walls.obj", text +
                                                   "usemtl brick\nf 1 2 3\nusemtl lime\nf 2 3 4\n"
                                                   "usemtl brick\nf 5 6 7\nusemtl lime\nf 1 1 5\n");
  const Inspection inspection = inspectMesh(file);
  const sim::Mesh read = importMesh(file, RegionsFrom::material);
  EXPECT_EQ(inspection.found.regions, RegionsFrom::material);
  EXPECT_EQ(inspection.placed.regions, read.regions);
  EXPECT_EQ(inspection.placed.region, read.region);
  ASSERT_EQ(read.regions.size(), 2u);
}

}  // namespace
}  // namespace espalier::scenes
