#include "render/finish/picture_texture.h"

#include <gtest/gtest.h>

#include "render/finish/looks.h"
#include "render/finish/ray_scene.h"
#include "sim/base/srgb.h"

namespace espalier::render {
namespace {

using sim::Vec3f;

/// Left half red and solid, right half black and clear; the upper quarter green and solid.
LeafPicture flag() {
  LeafPicture picture{"flag", 32, 32, {}, {}};
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      if (y < 8)
        picture.texels.push_back({0, 255, 0, 255});
      else if (x < 16)
        picture.texels.push_back({255, 0, 0, 255});
      else
        picture.texels.push_back({0, 0, 0, 0});
    }
  }
  return picture;
}

TEST(PictureTexture, CoversWhereItsAlphaDoes) {
  const PictureTexture texture(flag());
  EXPECT_TRUE(texture.covers({0.2f, 0.3f}));
  EXPECT_FALSE(texture.covers({0.8f, 0.3f}));
  EXPECT_TRUE(texture.covers({0.8f, 0.9f})) << "v goes upwards";
  EXPECT_TRUE(texture.covers({-1.0f, 0.3f})) << "its rim goes on";
}

TEST(PictureTexture, IsLinearAndOfWhatCoversAlone) {
  const PictureTexture texture(flag());
  EXPECT_EQ(texture.colour({0.2f, 0.3f}, 0.0f), sim::Colour(1, 0, 0));
  EXPECT_EQ(texture.colour({0.5f, 0.95f}, 0.0f), sim::Colour(0, 1, 0));
  // From far away it is the mean of what covers, in which the clear half's black has no part.
  const sim::Colour far = texture.colour({0.5f, 0.5f}, 1.0f);
  EXPECT_NEAR(far.r + far.g, 1.0f, 0.02f);
  EXPECT_GT(far.r, 0.2f);
  EXPECT_GT(far.g, 0.2f);
  LeafPicture grey{"grey", 4, 4, std::vector<std::array<std::uint8_t, 4>>(16, {128, 128, 128, 255}), {}};
  EXPECT_NEAR(PictureTexture(grey).colour({0.5f, 0.5f}, 0.0f).r, sim::linearFromSrgb(128.0f / 255.0f), 1e-6f);
}

TEST(PictureTexture, BeyondItsRimsItTilesOrGoesBackOrGoesOn) {
  using Wrap = sim::Texture::Wrap;
  const auto left = sim::Colour(1, 0, 0);
  const auto at = [](Wrap wrap, float u) {
    return PictureTexture(flag(), {wrap, Wrap::clamp}, 32).colour({u, 0.3f}, 0.0f);
  };
  for (const float u : {0.25f, 1.25f, -0.75f, 6.25f}) EXPECT_EQ(at(Wrap::repeat, u), left) << u;
  for (const float u : {0.25f, -0.25f, 1.75f, 2.25f, -1.75f}) EXPECT_EQ(at(Wrap::mirror, u), left) << u;
  for (const float u : {0.25f, -0.25f, -7.0f}) EXPECT_EQ(at(Wrap::clamp, u), left) << u;
  EXPECT_NE(at(Wrap::mirror, 1.25f), left);
  EXPECT_NE(at(Wrap::clamp, 1.25f), left);
  // Along v as well.
  const PictureTexture upright(flag(), {Wrap::clamp, Wrap::mirror}, 32);
  EXPECT_EQ(upright.colour({0.2f, 1.1f}, 0.0f), sim::Colour(0, 1, 0));
  EXPECT_EQ(upright.colour({0.2f, -0.1f}, 0.0f), left);
}

TEST(PictureTexture, LargerOnesAreHalved) {
  using Wrap = sim::Texture::Wrap;
  LeafPicture stripes{"stripes", 64, 64, {}, {}};  // of one texel each: a texel of half the size is grey
  for (int i = 0; i < 64 * 64; ++i) {
    const auto value = static_cast<std::uint8_t>(i % 2 == 0 ? 255 : 0);
    stripes.texels.push_back({value, value, value, 255});
  }
  const PictureTexture fine(stripes, {Wrap::repeat, Wrap::repeat}, 64);
  const PictureTexture coarse(stripes, {Wrap::repeat, Wrap::repeat}, 32);
  EXPECT_EQ(fine.colour({0.5f / 64.0f, 0.5f}, 0.0f), sim::Colour(1.0f));
  EXPECT_NEAR(coarse.colour({0.5f + 0.5f / 32.0f, 0.5f}, 0.0f).r, 0.5f, 0.02f);
}

/// A card of 1 x 1 m in the plane z = 0 that shows the flag.
class CutOut : public testing::Test {
 protected:
  CutOut() {
    ModelMesh card;
    card.picture = std::make_shared<const LeafPicture>(flag());
    card.positions_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    card.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    card.normals.assign(4, {0, 0, 1});
    card.tints.assign(4, sim::Colour(0.5f, 1.0f, 1.0f));
    card.exposures = card.youths = {0, 0, 0, 0};
    card.pieces = {0, 0, 0, 0};
    card.triangles = {{0, 1, 2}, {0, 2, 3}};
    plant_.elements = {card};
    scene_.plants = {&plant_};
  }

  PlantModel plant_;
  ModelScene scene_;
};

TEST_F(CutOut, RaysGoThroughItsHoles) {
  const RayScene rays(scene_);
  const std::array<Vec3f, kRays> ways{Vec3f(-0.3f, -0.2f, -1.0f), Vec3f(0.3f, -0.2f, -1.0f),
                                      Vec3f(0.3f, 0.4f, -1.0f), Vec3f(2.0f, 0.0f, -1.0f)};
  const auto hits = rays.firstHits({0.5f, 0.5f, 1.0f}, ways);
  EXPECT_TRUE(hits[0].any()) << "red";
  EXPECT_FALSE(hits[1].any()) << "clear";
  EXPECT_TRUE(hits[2].any()) << "green";
  EXPECT_FALSE(hits[3].any()) << "beside the card";
  RayScene::ShadowRays shadows;
  shadows.origins_m.fill({0.5f, 0.5f, 1.0f});
  shadows.directions = ways;
  shadows.wanted.fill(true);
  const auto clear = rays.clear(shadows);
  EXPECT_EQ(clear, (std::array<bool, kRays>{false, true, false, true}));
  plant_.elements[0].picture = nullptr;  // a card without a picture is solid
  EXPECT_TRUE(RayScene(scene_).firstHits({0.5f, 0.5f, 1.0f}, ways)[1].any());
}

TEST_F(CutOut, IsSeenInItsPicturesColoursAndItsTint) {
  const RayScene rays(scene_);
  std::array<Vec3f, kRays> ways;
  ways.fill(Vec3f(-0.3f, -0.2f, -1.0f));
  const SurfaceHit hit = rays.firstHits({0.5f, 0.5f, 1.0f}, ways)[0];
  ASSERT_TRUE(hit.any());
  const Look look = bladeLook(rays.surfaces()[hit.surface], hit, 1e-4f);
  EXPECT_EQ(look.albedo, sim::Colour(0.5f, 0.0f, 0.0f));
  EXPECT_GT(look.through.r, 0.3f) << "light comes through from behind";
}

}  // namespace
}  // namespace espalier::render
