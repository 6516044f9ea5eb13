#include "scenes/import/world_of.h"

#include <map>
#include <optional>

#include "scenes/import/mesh_import.h"
#include "sim/light/surface.h"
#include "tests/scenes/import/mesh_files.h"
#include "tests/support/meshes.h"

namespace espalier::scenes {
namespace {

class WorldOf : public tests::MeshFiles {};

constexpr const char* kWall = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\n";

TEST_F(WorldOf, AWallWithoutThicknessHasRoomOnBothSides) {
  for (const char* const face : {"f 1 2 3 4\n", "f 4 3 2 1\n"}) {
    const auto wall = write("wall.obj", std::string(kWall) + face);
    for (const auto margin_m : {std::optional<double>(), std::optional(0.0)}) {
      const sim::World world = worldOf(wall, {.margin_m = margin_m});
      EXPECT_EQ(world.frame().size, margin_m ? sim::Voxel(26, 16, 6) : sim::Voxel(27, 14, 7));
      const sim::SurfaceSensors sensors = sim::surfaceSensors(world);
      EXPECT_EQ(sensors.surfaces.size(), world.occupied().count());
      EXPECT_GE(sensors.surfaces.size(), 200u);
    }
  }
}

TEST_F(WorldOf, SoHasABoxThatFillsItsWorld) {
  std::vector<sim::TiledMesh> meshes(1);
  meshes[0].mesh = importMesh(write("box.obj",
                                    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
                                    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"),
                              RegionsFrom::group);
  meshes[0].solid = true;
  std::vector<sim::FillReport> fills;
  const sim::World world = worldAround(
      meshes, 0.1, 0.0, [](const sim::Frame&) { return 0; }, &fills);
  EXPECT_TRUE(sim::anyCanBeLit(world));
  EXPECT_EQ(fills.size(), 1u);  // of the world that came of it
}

TEST_F(WorldOf, WithoutAMarginAllWallsAreLitAndTheUndersideIsNot) {
  const auto box = write("box.obj", tests::kCubeObj);
  const sim::World world = worldOf(box, {});
  EXPECT_EQ(world.frame().size, sim::Voxel(27, 24, 27));
  std::map<std::string, std::size_t> lit;
  for (const sim::TiledVoxel& tiled : sim::surfaceSensors(world).surfaces) {
    const sim::Vec3f n = tiled.surface.normal;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(n[axis]) > 0.99f) ++lit[(n[axis] < 0.0f ? "-" : "+") + std::string(1, "xyz"[axis])];
    }
  }
  EXPECT_EQ(lit.size(), 5u);
  EXPECT_FALSE(lit.contains("-y"));
  for (const auto& [way, voxels] : lit) EXPECT_GT(voxels, 300u) << way;
}

TEST_F(WorldOf, ABoxIsFilledUnlessItShallBeHollow) {
  const auto box = write("box.obj", tests::kCubeObj);
  const sim::Voxel middle(13, 10, 13);
  EXPECT_TRUE(worldOf(box, {}).occupied().at(middle));
  EXPECT_TRUE(worldOf(box, {.solid = true}).occupied().at(middle));
  EXPECT_FALSE(worldOf(box, {.solid = false}).occupied().at(middle));
}

TEST_F(WorldOf, AWorldInWhichSomethingIsLitKeepsItsSize) {
  const auto corner = write("corner.obj", std::string(kWall) + "v 0 0 1\nv 2 0 1\nf 1 2 3 4\nf 1 5 6 2\n");
  EXPECT_EQ(worldOf(corner, {.margin_m = 0.0}).frame().size, sim::Voxel(21, 11, 11));
  EXPECT_EQ(worldOf(corner, {.margin_m = 0.2}).frame().size, sim::Voxel(24, 14, 14));
  const auto wall = write("wall.obj", std::string(kWall) + "f 1 2 3 4\n");
  EXPECT_EQ(worldOf(wall, {.margin_m = 0.2}).frame().size.z, 4);  // two voxels of margin are room enough
}

}  // namespace
}  // namespace espalier::scenes
