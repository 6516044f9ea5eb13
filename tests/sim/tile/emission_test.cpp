#include "sim/tile/emission.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/worlds.h"

namespace espalier::sim {
namespace {

std::vector<EmittingVoxel> emission(const Mesh& mesh, bool guide = false) {
  std::vector<TiledMesh> meshes{{mesh, false}};
  meshes.front().guide = guide;
  const World world = buildWorld(tests::unitFrame({16, 16, 16}), meshes, 0);
  return emissionOf(world.frame(), meshes, [&](Voxel v) {
    const auto surface = world.surfaceAt(v);
    return surface ? surface->coverage : 0.0f;
  });
}

TEST(Emission, OfALampIsItsLightInEachOfItsVoxels) {
  Mesh lamp = tests::boxMesh({3.2, 3.2, 3.2}, {9.3, 7.1, 8.4});
  EXPECT_TRUE(emission(lamp).empty());
  lamp.materials[0].emissive = Colour(2.0f, 1.0f, 0.5f);
  const auto voxels = emission(lamp);
  // The shell of a box of 7 x 5 x 6 voxels.
  EXPECT_EQ(voxels.size(), 7u * 5 * 6 - 5u * 3 * 4);
  for (const EmittingVoxel& v : voxels) {
    EXPECT_NEAR(v.light.r, 2.0f, 1e-3f);
    EXPECT_NEAR(v.light.b, 0.5f, 1e-3f);
  }
  for (std::size_t i = 1; i < voxels.size(); ++i)
    EXPECT_TRUE(beforeInRows(voxels[i - 1].voxel, voxels[i].voxel));
  EXPECT_TRUE(emission(lamp, true).empty());
}

TEST(Emission, OfAPartOfWhatLiesInAVoxelIsLess) {
  // A floor of which a stripe shines, three quarters of a voxel wide.
  Mesh floor = tests::emptyMesh("floor");
  floor.materials.push_back({"lamp"});
  floor.materials[1].emissive = Colour(4.0f);
  floor.regions.emplace_back("lamp");
  floor.vertices_m = {{0, 4, 0},  {6.5, 4, 0},  {7.25, 4, 0},  {15, 4, 0},
                      {0, 4, 15}, {6.5, 4, 15}, {7.25, 4, 15}, {15, 4, 15}};
  for (std::uint32_t i = 0; i < 3; ++i) {
    tests::addTriangle(floor, i, i + 4, i + 5, i == 1);
    tests::addTriangle(floor, i, i + 5, i + 1, i == 1);
  }
  const auto voxels = emission(floor);
  ASSERT_FALSE(voxels.empty());
  for (const EmittingVoxel& v : voxels) {
    EXPECT_EQ(v.voxel.x, 7);
    if (v.voxel.z > 0 && v.voxel.z < 15) {
      EXPECT_NEAR(v.light.g, 3.0f, 1e-3f);
    }
  }
}

}  // namespace
}  // namespace espalier::sim
