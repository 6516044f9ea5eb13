#include "scenes/show/voxel_colours.h"

#include <gtest/gtest.h>

#include "render/image/tone.h"
#include "render/voxels/panels.h"
#include "sim/tile/build_world.h"
#include "tests/support/meshes.h"
#include "tests/support/worlds.h"

namespace espalier::scenes {
namespace {

using sim::Voxel;

const sim::Colour kGreen(0.1f, 0.5f, 0.05f), kBrown(0.3f, 0.15f, 0.05f);
const sim::Vec3 kToSun = glm::normalize(sim::Vec3(0, 1, 1));

/// Ground, a stem on it, leaves about the stem, and a leaf by itself.
class Coloured : public testing::Test {
 protected:
  static sim::World world() {
    sim::Mesh ground = tests::emptyMesh("ground");
    ground.vertices_m = {{0, 0.5, 0}, {24, 0.5, 0}, {24, 0.5, 24}, {0, 0.5, 24}};
    tests::addTriangle(ground, 0, 2, 1);
    tests::addTriangle(ground, 0, 3, 2);
    sim::World made = sim::buildWorld({sim::Vec3(0.5), 1.0, {24, 16, 24}}, {{ground, false}}, 1);
    const sim::PartId stem = made.addPart(tests::stemPart("vine")),
                      leaf = made.addPart(tests::elementPart("vine"));
    std::vector<sim::TiledVoxel> stems, leaves;
    for (int y = 1; y < 8; ++y)
      stems.push_back({{8, y, 8}, {.part = stem, .colour = kBrown, .coverage = 1.0f}});
    for (int y = 5; y < 8; ++y) {
      for (int x = 7; x < 10; ++x) {
        for (int z = 7; z < 10; ++z) {
          leaves.push_back(
              {{x, y, z}, {.part = leaf, .colour = kGreen, .coverage = 0.5f, .normal = {0, 1, 0}}});
        }
      }
    }
    leaves.push_back({{18, 9, 18}, {.part = leaf, .colour = kGreen, .coverage = 0.5f, .normal = {0, 1, 0}}});
    made.occupy(stems);
    made.occupy(leaves);
    return made;
  }
  Coloured() {
    sim::LightWanted wanted;
    wanted.to_sun = kToSun;
    light_ = sim::lightOf(world_, sim::makeSky({sim::Weighting::cosine, 0.005, 96}), {}, wanted);
  }
  VoxelColours colours(ImageKind kind) const { return {world_, bare_, light_, lit_, kind, kToSun}; }
  static sim::BitVolume bareOf(const sim::World& world) {
    sim::BitVolume bare(world.frame().size);
    for (int z = 0; z < 24; ++z)
      for (int x = 0; x < 24; ++x) bare.set({x, 0, z});
    return bare;
  }

  sim::World world_ = world();
  sim::BitVolume bare_ = bareOf(world_);
  sim::Lighting light_;
  PictureLight lit_;
};

TEST_F(Coloured, AVoxelsColourIsThatOfTheNearestPartOfItsKind) {
  const VoxelColours plain = colours(ImageKind::surface_colour);
  const sim::Colour ground = world_.surfaceAt({3, 0, 3})->colour;
  EXPECT_EQ(plain.at({3, 0, 3}, sim::PartKind::scene), ground);
  EXPECT_EQ(plain.at({8, 6, 8}, sim::PartKind::stem), kBrown);
  EXPECT_EQ(plain.at({7, 6, 8}, sim::PartKind::element), kGreen);
  // Where it is not, or something else is.
  EXPECT_EQ(plain.at({3, 4, 3}, sim::PartKind::scene), ground);
  EXPECT_EQ(plain.at({7, 6, 8}, sim::PartKind::stem), kBrown) << "bark among leaves";
  EXPECT_EQ(plain.at({8, 6, 8}, sim::PartKind::element), kGreen) << "a leaf in the stem's voxel";
  EXPECT_EQ(plain.at({20, 2, 20}, sim::PartKind::element), kGreen) << "the ground is nearer";
}

TEST_F(Coloured, TheFirstPassIsThatOfThePicture) {
  const VoxelColours lit = colours(ImageKind::first_pass);
  const sim::Colour ground = world_.surfaceAt({3, 0, 20})->colour;
  const std::size_t number = light_.where->number({3, 0, 20});
  const sim::Colour wanted =
      render::firstPass(ground, light_.sky.values[number], static_cast<float>(kToSun.y));
  const render::ToneCurve tone;
  const sim::Colour found = lit.at({3, 0, 20}, sim::PartKind::scene);
  EXPECT_NEAR(found.r, tone(wanted.r), 1e-6f);
  EXPECT_NEAR(found.b, tone(wanted.b), 1e-6f);
  // Behind the stem, where the sun does not come.
  const sim::Colour shadow = lit.at({8, 0, 4}, sim::PartKind::scene);
  EXPECT_LT(shadow.r, 0.7f * found.r);
  EXPECT_GT(shadow.r, 0.0f);
}

TEST_F(Coloured, PlantsAreLitByTheirOpenFacesAndNoneIsBlack) {
  const VoxelColours lit = colours(ImageKind::first_pass);
  const sim::Colour alone = lit.at({18, 9, 18}, sim::PartKind::element);
  EXPECT_GT(alone.g, 0.2f);
  EXPECT_GT(alone.g, 3.0f * alone.b) << "green";
  EXPECT_GT(lit.at({8, 6, 9}, sim::PartKind::element).g, 0.1f);
  EXPECT_GT(lit.at({8, 6, 8}, sim::PartKind::element).g, 0.05f);
  ASSERT_FALSE(light_.where->has({8, 6, 8}) || light_.gaps->has({8, 6, 8})) << "no face of it is open";
  const sim::Colour inside = lit.at({8, 6, 8}, sim::PartKind::stem);
  EXPECT_GT(inside.r, 0.01f);
  EXPECT_EQ(inside, lit.at({8, 7, 8}, sim::PartKind::stem)) << "lit as the nearest that has one";
}

}  // namespace
}  // namespace espalier::scenes
