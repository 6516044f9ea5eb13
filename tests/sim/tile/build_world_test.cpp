#include "sim/tile/build_world.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/tile/tiling.h"
#include "tests/support/meshes.h"
#include "tests/support/messages.h"
#include "tests/support/worlds.h"

namespace espalier::sim {
namespace {

double totalCoverage(const World& world) {
  double sum = 0.0;
  for (const TiledVoxel& t : world.surfaces()) sum += t.surface.coverage;
  return sum;
}

TEST(BuildWorld, ABoxBetweenVoxelsCountsExactly) {
  // Faces in the planes between voxels: by the rule each goes to the layer above it, so low faces lie just
  // inside the box and high faces just outside.
  const Mesh box = tests::boxMesh({1.5, 2.5, 3.5}, {6.5, 9.5, 7.5});
  std::vector<FillReport> fills;
  const World world = buildWorld(tests::unitFrame(Voxel(14)), {{box, true}}, 0, &fills);
  // Shell of 6 x 8 x 5 voxels, whose inside is 4 x 6 x 3.
  EXPECT_EQ(world.occupied().count(), 6u * 8 * 5);
  ASSERT_EQ(fills.size(), 1u);
  EXPECT_EQ(fills[0].object, "box");
  EXPECT_EQ(fills[0].filled, 4u * 6 * 3);
  EXPECT_EQ(fills[0].doubtful, 0u);
  const World shell = buildWorld(tests::unitFrame(Voxel(14)), {{box, false}}, 0);
  EXPECT_EQ(shell.occupied().count(), 6u * 8 * 5 - 4 * 6 * 3);
  for (const TiledVoxel& t : shell.surfaces()) {
    EXPECT_EQ(world.surfaceAt(t.voxel)->normal, t.surface.normal);
  }
  const auto inside = world.surfaceAt({4, 5, 5});
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->coverage, 1.0f);
  EXPECT_EQ(inside->normal, Vec3f(0.0f));
}

TEST(BuildWorld, WhatDoesNotShadeStandsInTheWayOfAllButLight) {
  const Mesh box = tests::boxMesh({1.5, 2.5, 3.5}, {6.5, 9.5, 7.5});
  for (const bool solid : {true, false}) {
    TiledMesh glass{box, solid};
    const World wall = buildWorld(tests::unitFrame(Voxel(14)), {glass}, 1);
    glass.shade = false;
    const World clear = buildWorld(tests::unitFrame(Voxel(14)), {glass}, 1);
    EXPECT_EQ(clear.solid().words(), wall.solid().words());
    EXPECT_GT(wall.opaque().count(), 0u);
    EXPECT_EQ(clear.opaque().count(), 0u);
    EXPECT_EQ(clear.nearnessAt({4, 5, 11})->distance_vx, wall.nearnessAt({4, 5, 11})->distance_vx);
  }
}

TEST(BuildWorld, CoverageIsTheAreaInsideTheVoxel) {
  // A horizontal rectangle, its border at quarters of voxels.
  Mesh sheet = tests::emptyMesh("sheet");
  sheet.vertices_m = {{1.75, 3.0, 1.0}, {5.25, 3.0, 1.0}, {5.25, 3.0, 4.0}, {1.75, 3.0, 4.0}};
  tests::addTriangle(sheet, 0, 2, 1);
  tests::addTriangle(sheet, 0, 3, 2);
  const World world = buildWorld(tests::unitFrame(Voxel(8)), {{sheet, false}}, 1);
  const auto surface = [&](int x, int z) { return world.surfaceAt({x, 3, z}).value_or(Surface{}); };
  EXPECT_FLOAT_EQ(surface(3, 2).coverage, 1.0f);
  EXPECT_FLOAT_EQ(surface(2, 2).coverage, 0.75f);
  EXPECT_FLOAT_EQ(surface(3, 1).coverage, 0.5f);
  EXPECT_FLOAT_EQ(surface(5, 4).coverage, 0.75f * 0.5f);
  EXPECT_EQ(surface(3, 2).normal, Vec3f(0, 1, 0));
  EXPECT_NEAR(totalCoverage(world), 3.5 * 3.0, 1e-5);
  EXPECT_EQ(world.nearnessAt({3, 4, 2})->layer, 1);
}

TEST(BuildWorld, CoverageSumsToTheAreaOfASphere) {
  // Coverage is cut off at 1, so voxels that the sphere crosses aslant lose some: at most a factor of the
  // root of 3.
  const Mesh sphere = tests::sphereMesh({20, 20, 20}, 15.0, 40);
  const World world = buildWorld(tests::unitFrame(Voxel(40)), {{sphere, false}}, 0);
  EXPECT_LT(totalCoverage(world), tests::area(sphere) + 1e-3);
  EXPECT_GT(totalCoverage(world), 0.8 * tests::area(sphere));
  const auto top = world.surfaceAt({20, 35, 20});
  ASSERT_TRUE(top);
  EXPECT_GT(top->normal.y, 0.99f);
}

TEST(BuildWorld, ASphereConvergesAsVoxelsShrink) {
  // The surface is met by about 1.5 voxels per unit of area: the mean over directions of |n.x| + |n.y| +
  // |n.z|, as a voxel is met when its centre lies within half of that of the surface. Filled volume is right
  // to the surface's own half voxel.
  constexpr double kRadius = 0.5;
  for (const double voxel : {0.05, 0.025, 0.0125}) {
    const Mesh sphere = tests::sphereMesh(Vec3(0.01, 0.02, 0.03), kRadius, 64);
    const std::vector<TiledMesh> meshes{{sphere, true}};
    std::vector<FillReport> fills;
    const World world = buildWorld(frameAround(meshes, voxel, voxel), meshes, 0, &fills);
    ASSERT_EQ(fills.at(0).doubtful, 0u);
    const double shell = static_cast<double>(world.occupied().count() - fills[0].filled);
    const double expected_shell = 1.5 * tests::area(sphere) / (voxel * voxel);
    EXPECT_NEAR(shell / expected_shell, 1.0, 0.8 * voxel / kRadius + 0.01) << "voxel " << voxel;
    // Half of the surface's voxels lie outside.
    const double volume = (static_cast<double>(fills[0].filled) + shell / 2) * voxel * voxel * voxel;
    const double error = std::abs(volume / tests::signedVolume(sphere) - 1.0);
    EXPECT_LT(error, 0.05 * voxel / kRadius) << "voxel " << voxel;
  }
}

TEST(BuildWorld, PartsAreRegionsAndTheLargestTakesTheVoxel) {
  Mesh mesh = tests::emptyMesh("house");
  mesh.regions = {"wall", "roof"};
  mesh.materials = {{"red", {1, 0, 0}}, {"blue", {0, 0, 1}}};
  mesh.vertices_m = {{0, 2, 0}, {2.75, 2, 0}, {2.75, 2, 3}, {0, 2, 3}, {6, 2, 0}, {6, 2, 3}};
  tests::addTriangle(mesh, 0, 1, 2, 0);
  tests::addTriangle(mesh, 0, 2, 3, 0);
  tests::addTriangle(mesh, 1, 4, 5, 1);
  tests::addTriangle(mesh, 1, 5, 2, 1);
  const World world = buildWorld(tests::unitFrame(Voxel(8)),
                                 {{tests::boxMesh({0, 6, 0}, {1, 7, 1}, "first"), false}, {mesh, false}}, 0);
  ASSERT_EQ(world.parts().size(), 3u);
  EXPECT_EQ(world.part(2).object, "house");
  EXPECT_EQ(world.part(2).region, "wall");
  EXPECT_EQ(world.part(3).region, "roof");
  EXPECT_EQ(world.part(3).kind, PartKind::scene);
  EXPECT_EQ(world.partAt({2, 2, 1}), 2);
  // Voxel 3 spans 2.5 to 3.5: a quarter wall, three quarters roof.
  const auto shared = world.surfaceAt({3, 2, 1});
  ASSERT_TRUE(shared);
  EXPECT_EQ(shared->part, 3);
  EXPECT_NEAR(shared->colour.r, 0.25f, 1e-5f);
  EXPECT_NEAR(shared->colour.b, 0.75f, 1e-5f);
}

TEST(BuildWorld, EqualShareGoesToTheLowestPartAndOppositeSidesLeaveNoNormal) {
  Mesh mesh = tests::emptyMesh("leaf");
  mesh.regions = {"under", "over"};
  mesh.materials = {{"a", Colour(0.2f)}, {"b", Colour(0.4f)}};
  mesh.vertices_m = {{1, 2, 1}, {4, 2, 1}, {1, 2, 4}};
  tests::addTriangle(mesh, 0, 2, 1, 1);
  tests::addTriangle(mesh, 0, 1, 2, 0);
  const World world = buildWorld(tests::unitFrame(Voxel(6)), {{mesh, false}}, 0);
  const auto both = world.surfaceAt({2, 2, 2});
  ASSERT_TRUE(both);
  EXPECT_EQ(both->part, 1);
  EXPECT_NEAR(both->colour.r, 0.3f, 1e-6f);
  EXPECT_EQ(both->normal, Vec3f(0.0f));
}

TEST(BuildWorld, EarlierMeshesKeepTheirVoxels) {
  const Mesh first = tests::boxMesh({2, 2, 2}, {6, 6, 6}, "first");
  const Mesh second = tests::boxMesh({4, 4, 4}, {9, 9, 9}, "second");
  const World world = buildWorld(tests::unitFrame(Voxel(12)), {{first, true}, {second, true}}, 0);
  EXPECT_EQ(world.partAt({5, 5, 5}), 1);
  EXPECT_EQ(world.partAt({6, 6, 6}), 1);
  EXPECT_EQ(world.partAt({8, 8, 8}), 2);
}

TEST(BuildWorld, VoxelsThatAreOnlyTouchedAreTiled) {
  // A triangle in the plane below voxel 3 whose tip touches the corner of another voxel.
  Mesh mesh = tests::emptyMesh("tip");
  mesh.vertices_m = {{1, 2.5, 1}, {2, 2.5, 1}, {2.5, 2.5, 2.5}};
  tests::addTriangle(mesh, 0, 2, 1);
  const World world = buildWorld(tests::unitFrame(Voxel(6)), {{mesh, false}}, 0);
  std::vector<Voxel> expected;
  tileTriangle({mesh.vertices_m[0], mesh.vertices_m[1], mesh.vertices_m[2]}, expected);
  const auto surfaces = world.surfaces();
  ASSERT_EQ(surfaces.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(surfaces[i].voxel, expected[i]);
  const auto tip = world.surfaceAt({3, 3, 3});
  ASSERT_TRUE(tip);
  EXPECT_EQ(tip->coverage, 0.0f);
  EXPECT_EQ(tip->colour, Colour(0.5f));
  EXPECT_EQ(tip->normal, Vec3f(0, 1, 0));
}

TEST(BuildWorld, ClipsWhatLiesOutsideHoweverLarge) {
  // A ground a thousand kilometres wide, and a wall that is partly in the world.
  Mesh ground = tests::emptyMesh("ground");
  ground.vertices_m = {{-5e5, 2.1, -5e5}, {5e5, 2.1, -5e5}, {0, 2.1, 9e5}};
  tests::addTriangle(ground, 0, 2, 1);
  const World world = buildWorld(tests::unitFrame(Voxel(20)),
                                 {{ground, false}, {tests::boxMesh({-50, -50, 10}, {10, 50, 99}), false}}, 2);
  for (int x = 0; x < 20; ++x) {
    for (int z = 0; z < 20; ++z) {
      EXPECT_EQ(world.partAt({x, 2, z}), 1);
      EXPECT_FLOAT_EQ(world.surfaceAt({x, 2, z})->coverage, 1.0f);
    }
  }
  EXPECT_EQ(world.partAt({5, 15, 10}), 2);
  EXPECT_EQ(world.partAt({10, 15, 15}), 2);
  EXPECT_EQ(world.partAt({11, 15, 15}), kFree);
}

TEST(BuildWorld, IsTheSameOnAnyNumberOfThreads) {
  const auto bumps = [](double x, double z) { return 8 + 3 * std::sin(0.7 * x) * std::cos(0.5 * z); };
  Mesh hole = tests::without(tests::sphereMesh({20, 22, 20}, 12, 30), [](Vec3 p) { return p.y > 31; });
  const auto make = [&](int threads, std::vector<FillReport>& fills) {
    std::optional<World> world;
    sim::onThreads(threads, [&] {
      world = buildWorld(tests::unitFrame({45, 40, 42}),
                         {{tests::terrainMesh(50, 0.83, bumps), false}, {hole, true}}, 4, &fills);
    });
    return std::move(*world);
  };
  std::vector<FillReport> fills;
  const World one = make(1, fills);
  EXPECT_EQ(tests::differenceOf(one, make(2, fills)), "");
  EXPECT_EQ(tests::differenceOf(one, make(5, fills)), "");
  for (const FillReport& f : fills) {
    EXPECT_EQ(f.filled, fills[0].filled);
    EXPECT_EQ(f.doubtful, fills[0].doubtful);
  }
  hole.vertices_m.back().y += 0.5;  // of which the comparison would tell
  std::vector<FillReport> others;
  EXPECT_NE(tests::differenceOf(one, make(1, others)), "");
}

TEST(BuildWorld, RefusesVoxelsThatNoWorldCanHave) {
  const auto build = [](double voxel_m) {
    return tests::messageOf([&] { buildWorld({Vec3(0.0), voxel_m, Voxel(3)}, {}, 0); });
  };
  EXPECT_TRUE(build(1.2e-5).starts_with("voxels of 1.2e-05 m; expected 2e-05 to 1000000 m")) << build(1.2e-5);
  EXPECT_TRUE(build(1.1e6).starts_with("voxels of 1.1e+06 m; expected 2e-05 to 1000000 m")) << build(1.1e6);
  EXPECT_EQ(build(kLeastVoxel_m), "no error");
  EXPECT_EQ(build(kMostVoxel_m), "no error");
}

TEST(BuildWorld, RefusesMeshesThatAreNotSound) {
  const auto build = [](const Mesh& mesh) {
    return tests::messageOf([&] { buildWorld(tests::unitFrame(Voxel(4)), {{mesh, false}}, 0); });
  };
  Mesh mesh = tests::boxMesh(Vec3(0.0), Vec3(1.0));
  mesh.vertices_m[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(build(mesh), "mesh 'box': a vertex is not finite");
  mesh.vertices_m[3].y = 1e300;
  EXPECT_TRUE(build(mesh).starts_with("mesh 'box': a vertex lies more than 1e+12 voxels from the world;"))
      << build(mesh);
  mesh = tests::boxMesh(Vec3(0.0), Vec3(1.0));
  mesh.triangles[0][1] = 8;
  EXPECT_EQ(build(mesh), "mesh 'box': a triangle's vertex does not exist");
  mesh = tests::boxMesh(Vec3(0.0), Vec3(1.0));
  mesh.region.pop_back();
  EXPECT_EQ(build(mesh), "mesh 'box': every triangle needs a region that exists");
  mesh = tests::boxMesh(Vec3(0.0), Vec3(1.0));
  mesh.material[2] = 1;
  EXPECT_EQ(build(mesh), "mesh 'box': every triangle needs a material that exists");
}

}  // namespace
}  // namespace espalier::sim
