#include <gtest/gtest.h>

#include <glm/vector_relational.hpp>

#include "sim/tile/build_world.h"
#include "tests/support/each_voxel.h"
#include "tests/support/meshes.h"
#include "tests/support/worlds.h"

// What of a scene takes light: no more than is there, and no light leaks.
namespace espalier::sim {
namespace {

World worldOf(const Mesh& mesh, bool solid, Voxel size) {
  return buildWorld(tests::unitFrame(size), {{mesh, solid}}, 0);
}

/// Whether light that steps from voxel to voxel through their faces gets from one to the other.
bool leaks(const BitVolume& opaque, Voxel from, Voxel to) {
  BitVolume seen(opaque.size());
  std::vector<Voxel> todo{from};
  seen.set(from);
  while (!todo.empty()) {
    const Voxel v = todo.back();
    todo.pop_back();
    if (v == to) return true;
    for (const Voxel step : {Voxel(1, 0, 0), Voxel(-1, 0, 0), Voxel(0, 1, 0), Voxel(0, -1, 0), Voxel(0, 0, 1),
                             Voxel(0, 0, -1)}) {
      const Voxel next = v + step;
      if (!contains(opaque.size(), next) || opaque.at(next) || seen.at(next)) continue;
      seen.set(next);
      todo.push_back(next);
    }
  }
  return false;
}

Mesh turned(Mesh mesh, Vec3 about) {
  for (Vec3& p : mesh.vertices_m) {
    const Vec3 q = p - about;
    const Vec3 r(0.8 * q.x - 0.6 * q.z, q.y, 0.6 * q.x + 0.8 * q.z);
    p = about + Vec3(r.x, 0.96 * r.y - 0.28 * r.z, 0.28 * r.y + 0.96 * r.z);
  }
  return mesh;
}

const Vec3 kMiddle(20.3, 19.8, 20.1);

TEST(Opaque, OfASolidTheVoxelsWhoseCentresAreInside) {
  const Mesh sphere = tests::sphereMesh(kMiddle, 14.0, 24);
  for (const Mesh& mesh : {sphere, tests::insideOut(sphere)}) {
    const World world = worldOf(mesh, true, Voxel(40));
    tests::forEachVoxel(Voxel(40), [&](Voxel v) {
      const double out = glm::distance(Vec3(v), kMiddle) - 14.0;
      if (std::abs(out) < 0.15) return;  // facets lie below the sphere
      ASSERT_EQ(world.opaque().at(v), out < 0.0) << v.x << ' ' << v.y << ' ' << v.z;
    });
  }
}

TEST(Opaque, ABoxBetweenVoxelsIsAsLargeAsItIs) {
  const World world = worldOf(tests::boxMesh({1.5, 2.5, 3.5}, {6.5, 9.5, 7.5}), true, Voxel(14));
  EXPECT_EQ(world.opaque().count(), 5u * 7 * 4);
  EXPECT_EQ(world.occupied().count(), 6u * 8 * 5);  // it touches more
  tests::forEachVoxel(Voxel(14), [&](Voxel v) {
    EXPECT_EQ(world.opaque().at(v), glm::all(glm::greaterThan(Vec3(v), Vec3(1.5, 2.5, 3.5))) &&
                                        glm::all(glm::lessThan(Vec3(v), Vec3(6.5, 9.5, 7.5))));
  });
}

TEST(Opaque, AClosedShellLetsNoLightOut) {
  const Mesh sphere = tests::sphereMesh(kMiddle, 14.0, 24);
  const Mesh box = turned(tests::boxMesh({9, 10, 8}, {31, 29, 33}), kMiddle);
  Mesh patched = sphere;  // every third triangle faces the wrong way
  for (std::size_t i = 0; i < patched.triangles.size(); i += 3)
    std::swap(patched.triangles[i][1], patched.triangles[i][2]);
  for (const Mesh& mesh : {sphere, tests::insideOut(sphere), patched, box, tests::insideOut(box)}) {
    const World world = worldOf(mesh, false, Voxel(44));
    EXPECT_FALSE(world.opaque().at({20, 20, 20}));
    EXPECT_FALSE(leaks(world.opaque(), {20, 20, 20}, {0, 0, 0}));
  }
}

TEST(Opaque, AWallThinnerThanAVoxelLetsNoLightThrough) {
  // Hollow solids: two shells, one inside out.
  for (const double thick : {0.05, 0.3, 0.7, 1.0, 1.4}) {
    const Mesh box = turned(
        tests::together(tests::boxMesh({9, 10, 8}, {31, 29, 33}),
                        tests::insideOut(tests::boxMesh(Vec3(9, 10, 8) + thick, Vec3(31, 29, 33) - thick))),
        kMiddle);
    const Mesh ball = tests::together(tests::sphereMesh(kMiddle, 14.0, 24),
                                      tests::insideOut(tests::sphereMesh(kMiddle, 14.0 - thick, 24)));
    for (const Mesh& mesh : {box, ball}) {
      const World world = worldOf(mesh, true, Voxel(44));
      EXPECT_FALSE(world.opaque().at({20, 20, 20})) << thick;
      EXPECT_FALSE(leaks(world.opaque(), {20, 20, 20}, {0, 0, 0})) << thick;
    }
  }
}

TEST(Opaque, OfAnOpenSurfaceWhatLiesBehindIt) {
  const auto hills = [](double x, double z) { return 12 + 4 * std::sin(0.35 * x) * std::cos(0.3 * z); };
  Mesh land = tests::terrainMesh(90, 0.5, hills);
  const World world = worldOf(land, false, {40, 30, 40});
  EXPECT_FALSE(leaks(world.opaque(), {20, 29, 20}, {20, 0, 20}));
  tests::forEachVoxel({40, 30, 40}, [&](Voxel v) {
    if (!world.opaque().at(v)) return;
    EXPECT_LT(v.y, hills(v.x, v.z) + 0.05);
    EXPECT_GT(v.y, hills(v.x, v.z) - 2.5);  // a voxel thick, along whichever axis is steepest
  });
}

TEST(Opaque, AnOpenSurfaceFarLargerThanTheWorld) {
  Mesh plain = tests::emptyMesh("plain");
  plain.vertices_m = {{-1e7, 7.3, -1e7}, {3e7, 7.3, 0.0}, {-1e7, 7.3, 1e7}};
  tests::addTriangle(plain, 0, 2, 1);
  const World world = worldOf(plain, false, Voxel(16));
  EXPECT_EQ(world.opaque().count(), 16u * 16);
  EXPECT_FALSE(leaks(world.opaque(), {8, 15, 8}, {8, 0, 8}));
}

TEST(Opaque, WiresAndPoints) {
  Mesh wire = tests::emptyMesh("wire");
  wire.vertices_m = {{2.2, 3.1, 4.4}, {12.2, 3.1, 4.4}};
  tests::addTriangle(wire, 0, 1, 1);
  const World world = worldOf(wire, false, Voxel(16));
  EXPECT_EQ(world.opaque().count(), 11u);
  EXPECT_EQ(world.opaque().words(), world.occupied().words());
}

TEST(Opaque, WhatAnEarlierMeshTouchesButALaterOneFills) {
  const Mesh sheet = tests::boxMesh({4.2, 4.2, 4.2}, {4.3, 12.0, 12.0}, "sheet");
  const Mesh box = tests::boxMesh({2.5, 2.5, 2.5}, {13.5, 13.5, 13.5});
  const World world = buildWorld(tests::unitFrame(Voxel(16)), {{sheet, false}, {box, true}}, 0);
  EXPECT_EQ(world.opaque().count(), 11u * 11 * 11);
}

TEST(Inside, WholeBlocksTakeNoRoom) {
  const Mesh box = tests::boxMesh(Vec3(-5.0), Vec3(90.2, 70.2, 80.2));
  const World world = worldOf(box, true, Voxel(100, 80, 90));
  std::size_t counted = 0;
  for (const TiledVoxel& t : world.surfaces()) {
    ++counted;
    ASSERT_EQ(t.surface.part, 1);
    ASSERT_EQ(world.partAt(t.voxel), 1);
    const bool inner = glm::all(glm::lessThan(t.voxel, Voxel(90, 70, 80)));
    ASSERT_EQ(t.surface.normal == Vec3f(0.0f), inner);
    if (inner) {
      ASSERT_EQ(t.surface.coverage, 1.0f);
    }
  }
  EXPECT_EQ(counted, 91u * 71 * 81);
  EXPECT_EQ(world.nearnessAt({40, 40, 40})->layer, 0);
}

}  // namespace
}  // namespace espalier::sim
