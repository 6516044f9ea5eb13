#include "scenes/show/light_fields.h"

#include <gtest/gtest.h>

#include "sim/tile/build_world.h"
#include "sim/world/band.h"
#include "tests/support/meshes.h"
#include "tests/support/vdb.h"

namespace espalier::scenes {
namespace {

using sim::Voxel;

/// Open ground with a block on it.
class LightFields : public testing::Test {
 protected:
  LightFields() {
    wanted_.brightest = true;
    wanted_.space_hours = true;
    wanted_.space = std::make_shared<const sim::VoxelSet>(sim::freeBand(world_, world_.occupied(), 2));
    light_ = sim::lightOf(world_, sim::makeSky({sim::Weighting::cosine, 0.005, 96}),
                          sim::makeSun(sim::SunArc{}), wanted_);
  }
  static sim::World world() {
    sim::Mesh ground = tests::emptyMesh("ground");
    ground.vertices_m = {{0, 0.5, 0}, {20, 0.5, 0}, {20, 0.5, 14}, {0, 0.5, 14}};
    tests::addTriangle(ground, 0, 2, 1);
    tests::addTriangle(ground, 0, 3, 2);
    return sim::buildWorld(
        {sim::Vec3(0.5), 1.0, {20, 10, 14}},
        {{ground, false}, {tests::boxMesh({6.2, 0.6, 5.2}, {12.8, 5.8, 9.8}, "block"), true}}, 2);
  }

  sim::World world_ = world();
  sim::LightWanted wanted_;
  sim::Lighting light_;
};

TEST_F(LightFields, SurfacesHaveTheirOwnValuesAndNothingElseIsActive) {
  const auto file = tests::readBack(render::fieldVdbBytes(world_, exposureFields(light_, nullptr)));
  EXPECT_EQ(file.grids.size(), 6u);
  for (const auto& [name, grid] : file.grids) {
    EXPECT_EQ(grid->activeVoxelCount(), light_.surfaces.size()) << name;
    EXPECT_EQ(grid->metaValue<std::string>("weighting"), "cosine") << name;
    EXPECT_EQ(grid->metaValue<std::string>("directions"), "96") << name;
    EXPECT_FALSE(grid->metaValue<std::string>("unit").empty()) << name;
    EXPECT_GT(std::stod(grid->metaValue<std::string>("standard_error")), 0.0) << name;
  }
  const auto sky = file.grid<openvdb::FloatGrid>("sky_exposure"),
             hours = file.grid<openvdb::FloatGrid>("sun_hours");
  const auto part = file.grid<openvdb::FloatGrid>("part");
  const auto normal = file.grid<openvdb::Vec3SGrid>("normal"),
             brightest = file.grid<openvdb::Vec3SGrid>("brightest");
  ASSERT_TRUE(sky && hours && part && normal && brightest);
  for (std::size_t i = 0; i < light_.surfaces.size(); ++i) {
    const auto& [voxel, surface] = light_.surfaces[i];
    const openvdb::Coord at(voxel.x, voxel.y, voxel.z);
    ASSERT_EQ(sky->tree().getValue(at), light_.sky.values[i]);
    ASSERT_EQ(hours->tree().getValue(at), light_.sun_hours.values[i]);
    ASSERT_EQ(part->tree().getValue(at), surface.part);
    ASSERT_EQ(normal->tree().getValue(at).y(), surface.normal.y);
    ASSERT_EQ(brightest->tree().getValue(at).y(), light_.brightest[i].y);
  }
}

TEST_F(LightFields, FreeSpaceHasGridsOfItsOwn) {
  const auto file =
      tests::readBack(render::fieldVdbBytes(world_, exposureFields(light_, wanted_.space.get())));
  EXPECT_EQ(file.grids.size(), 9u);
  const auto sky = file.grid<openvdb::FloatGrid>("space_sky_exposure"),
             hours = file.grid<openvdb::FloatGrid>("space_sun_hours");
  ASSERT_TRUE(sky && hours);
  EXPECT_EQ(sky->activeVoxelCount(), wanted_.space->count());
  for (const Voxel v : wanted_.space->voxels()) {
    const openvdb::Coord at(v.x, v.y, v.z);
    ASSERT_TRUE(sky->tree().isValueOn(at));
    ASSERT_EQ(sky->tree().getValue(at), light_.space_sky->at(v));
    ASSERT_NEAR(hours->tree().getValue(at), 12.0f * light_.space_sun->at(v), 1e-4f);
  }
}

TEST_F(LightFields, WithoutASunThereAreNoGridsOfOne) {
  sim::LightWanted wanted;
  wanted.brightest = true;
  const sim::Lighting dark =
      sim::lightOf(world_, sim::makeSky({sim::Weighting::uniform, 0.005, 32}), {}, wanted);
  const auto file = tests::readBack(render::fieldVdbBytes(world_, exposureFields(dark, nullptr)));
  EXPECT_EQ(file.grids.size(), 4u);
  EXPECT_FALSE(file.grids.contains("sun_exposure"));
}

TEST_F(LightFields, TheWorldsFileHoldsSurfacesGapsAndTheSpaceAround) {
  const auto file = tests::readBack(render::vdbBytes(world_, worldFields(light_, *wanted_.space)));
  const auto sky = file.grid<openvdb::FloatGrid>("sky_exposure");
  ASSERT_TRUE(sky && file.grid<openvdb::FloatGrid>("sun_exposure") &&
              file.grid<openvdb::FloatGrid>("density"));
  EXPECT_EQ(sky->activeVoxelCount(), light_.surfaces.size() + light_.gaps->count() + wanted_.space->count());
}

}  // namespace
}  // namespace espalier::scenes
