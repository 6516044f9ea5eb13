#include "sim/tile/occupancy.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "tests/support/meshes.h"
#include "tests/support/worlds.h"

namespace espalier::sim {
namespace {

struct Scene {
  World world;
  Field<Occupancy> occupancy;

  Occupancy at(Voxel v) const {
    if (occupancy.where->has(v)) return occupancy.values[occupancy.index(v)];
    return world.occupied().at(v) ? Occupancy{1.0f, 1.0f} : Occupancy{};
  }
  double sum() const {
    double all = 0.0;
    for (const TiledVoxel& t : world.surfaces()) all += static_cast<double>(at(t.voxel).alpha);
    return all;
  }
};

Scene sceneOf(const std::vector<TiledMesh>& meshes, Voxel size, double thickness_vx = 0.1) {
  World world = buildWorld(tests::unitFrame(size), meshes, 0);
  const std::vector<double> thickness(meshes.size(), thickness_vx);
  Field<Occupancy> occupancy = meshOccupancy(world, world.occupied(), meshes, thickness);
  return {std::move(world), std::move(occupancy)};
}

/// About the middle of a world of this size.
Mesh tiltedBox(Vec3 edges, double turn_deg, Vec3 axis, Voxel size) {
  Mesh mesh = tests::boxMesh(-0.5 * edges, 0.5 * edges);
  const glm::dquat turned = glm::angleAxis(turn_deg * std::numbers::pi / 180.0, glm::normalize(axis));
  for (Vec3& p : mesh.vertices_m) p = turned * p + 0.5 * Vec3(size) - Vec3(0.3, 0.41, 0.17);
  return mesh;
}

TEST(Occupancy, TiltedBoxesSumToTheirVolume) {
  const Voxel size(64);
  for (const double edge : {1.7, 4.3, 12.0, 31.0}) {
    for (const double turn : {0.0, 11.0, 30.0, 45.0, 77.0}) {
      for (const Vec3 axis : {Vec3(0, 0, 1), Vec3(1, 2, 3), Vec3(1, 0, 0), Vec3(-3, 1, 0.2)}) {
        SCOPED_TRACE(testing::Message() << edge << " " << turn << " about " << axis.x << " " << axis.y);
        const Vec3 edges(edge, 0.8 * edge, 1.1 * edge);
        const Scene scene = sceneOf({{tiltedBox(edges, turn, axis, size), true}}, size);
        const double volume = edges.x * edges.y * edges.z;
        EXPECT_NEAR(scene.sum(), volume, 0.0005 * volume);
      }
    }
  }
}

TEST(Occupancy, ASphereSumsToTheVolumeOfItsMesh) {
  for (const double radius : {3.0, 10.3, 25.0}) {
    const Mesh mesh = tests::sphereMesh(Vec3(30.2, 29.7, 30.4), radius, 48);
    double volume = 0.0;
    for (const auto& t : mesh.triangles)
      volume +=
          glm::dot(mesh.vertices_m[t[0]], glm::cross(mesh.vertices_m[t[1]], mesh.vertices_m[t[2]])) / 6.0;
    EXPECT_NEAR(sceneOf({{mesh, true}}, Voxel(60)).sum(), volume, 0.0005 * volume);
    EXPECT_NEAR(volume, 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3), 0.005 * volume);
    // Nobody needs to call it solid, and meshes are inside out.
    EXPECT_NEAR(sceneOf({{tests::insideOut(mesh), false, true}}, Voxel(60)).sum(), volume, 0.0005 * volume);
  }
}

TEST(Occupancy, FlatFacesCutVoxelsWhereTheyLie) {
  // Voxels reach half a voxel width to either side of whole numbers.
  const Scene scene = sceneOf({{tests::boxMesh({2.0, 3.25, 4.0}, {8.0, 7.75, 9.0}), true}}, Voxel(12));
  EXPECT_NEAR(scene.at({5, 3, 6}).alpha, 0.25, 1e-6);
  EXPECT_NEAR(scene.at({5, 8, 6}).alpha, 0.25, 1e-6);
  EXPECT_NEAR(scene.at({2, 5, 6}).alpha, 0.5, 1e-6);
  EXPECT_NEAR(scene.at({2, 3, 4}).alpha, 0.5 * 0.25 * 0.5, 1e-6);
  EXPECT_EQ(scene.at({5, 5, 6}), (Occupancy{1.0f, 1.0f}));
  EXPECT_EQ(scene.at({5, 3, 6}).stops, scene.at({5, 3, 6}).alpha);
}

TEST(Occupancy, WallsThinnerThanAVoxelAreAsThickAsTheyAre) {
  const Scene scene = sceneOf({{tests::boxMesh({3.1, 1.0, 1.0}, {3.3, 9.0, 9.0}), false, true}}, Voxel(12));
  EXPECT_NEAR(scene.at({3, 5, 5}).alpha, 0.2, 1e-6);
  const Scene lying = sceneOf({{tests::boxMesh({1.0, 3.1, 1.0}, {9.0, 3.3, 9.0}), false, true}}, Voxel(12));
  EXPECT_NEAR(lying.at({5, 3, 5}).alpha, 0.2, 1e-6);
}

TEST(Occupancy, SolidsThatReachBeyondTheWorldAreFullInIt) {
  const Scene scene = sceneOf({{tests::boxMesh({-30, -30, -30}, {40, 4.25, 40}), true}}, Voxel(10));
  EXPECT_NEAR(scene.sum(), 100 * 4.75, 1e-3);
}

TEST(Occupancy, SheetsAreAsThickAsTheyAreSaidToBe) {
  const Vec3 centre(16.0);
  for (const Vec3 normal : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 2, 3)}) {
    Mesh sheet = tests::emptyMesh("sheet");
    const Vec3 n = glm::normalize(normal);
    const Vec3 u = glm::normalize(glm::cross(n, Vec3(0.3, 0.5, -0.4))), w = glm::cross(n, u);
    sheet.vertices_m = {centre - 9.0 * u - 5.0 * w, centre + 9.0 * u - 5.0 * w, centre + 9.0 * u + 5.0 * w,
                        centre - 9.0 * u + 5.0 * w};
    tests::addTriangle(sheet, 0, 1, 2);
    tests::addTriangle(sheet, 0, 2, 3);
    const Scene scene = sceneOf({{sheet, false, true}}, Voxel(32), 0.125);
    EXPECT_NEAR(scene.sum(), 18.0 * 10.0 * 0.125, 0.005 * 22.5);
  }
  const Occupancy leaf = sheetOccupancy(0.5, 0.02);
  EXPECT_FLOAT_EQ(leaf.alpha, 0.01f);
  EXPECT_FLOAT_EQ(leaf.stops, 0.5f);
  EXPECT_EQ(sheetOccupancy(40.0, 3.0), (Occupancy{1.0f, 1.0f}));
}

TEST(Occupancy, OverlappingSolidsAreFull) {
  const Mesh both =
      tests::together(tests::boxMesh({2, 2, 2}, {8, 8, 8}), tests::boxMesh({5, 4, 4}, {13, 6, 6}));
  const Scene scene = sceneOf({{both, true}}, Voxel(16));
  EXPECT_FLOAT_EQ(scene.at({5, 5, 5}).alpha, 1.0f);
  EXPECT_FLOAT_EQ(scene.at({7, 5, 5}).alpha, 1.0f);
  EXPECT_NEAR(scene.at({13, 5, 5}).alpha, 0.5, 1e-6);
  EXPECT_NEAR(scene.sum(), 6 * 6 * 6 + 5 * 2 * 2, 0.05 * 236);
}

TEST(Occupancy, IsTheSameOnAnyNumberOfThreads) {
  const std::vector<TiledMesh> meshes{
      {tests::sphereMesh(Vec3(20.0), 13.3, 24), true},
      {tiltedBox(Vec3(20, 9, 14), 33.0, Vec3(1, 2, 3), Voxel(40)), false, true}};
  const World world = buildWorld(tests::unitFrame(Voxel(40)), meshes, 0);
  const std::vector<double> thickness(2, 0.2);
  const auto found = [&] { return meshOccupancy(world, world.occupied(), meshes, thickness).values; };
  const std::vector<Occupancy> first = found();
  for (const int threads : {1, 2, 5}) {
    onThreads(threads, [&] { EXPECT_EQ(found(), first); });
  }
}

TEST(Occupancy, BadThicknessesAreErrors) {
  const std::vector<TiledMesh> meshes{{tests::boxMesh({2, 2, 2}, {4, 4, 4}), true}};
  const World world = buildWorld(tests::unitFrame(Voxel(6)), meshes, 0);
  EXPECT_THROW(meshOccupancy(world, world.occupied(), meshes, {}), InputError);
  for (const double wrong : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    const std::vector<double> thickness{wrong};
    EXPECT_THROW(meshOccupancy(world, world.occupied(), meshes, thickness), InputError);
  }
}

}  // namespace
}  // namespace espalier::sim
