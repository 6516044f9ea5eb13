#include "render/finish/finished_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/finish/daylight.h"
#include "render/finish/ground.h"
#include "render/finish/ray_scene.h"
#include "render/image/tone.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/random.h"
#include "sim/light/sky.h"
#include "sim/sweep/sweep.h"
#include "tests/support/golden.h"
#include "tests/support/small_vine.h"

namespace espalier {
namespace {

using render::Image;
using sim::Colour;
using sim::Vec3;
using sim::Vec3f;

class FinishedPicture : public testing::Test {
 protected:
  FinishedPicture() {
    scene_.model = {{&wall_}, {&vine_}};
    scene_.frame = tests::kVineFrame;
    scene_.occupied = &voxels_;
    scene_.sky = &sky_;
    scene_.to_sun = {-0.5, 0.7, 0.7};
  }
  Image draw(int width = 160, int height = 120) const {
    return render::finishedPicture(scene_, camera_, width, height);
  }

  sim::Mesh wall_ = tests::wallMesh();
  render::PlantModel vine_ = render::modelPlant(tests::smallVine(), tests::kVineFrame);
  sim::BitVolume voxels_ = tests::wallVoxels();
  sim::ExposureField sky_ = sim::sweepExposure(voxels_, sim::makeSky({.directions = 64}).directions);
  render::FinishedScene scene_;
  render::Camera camera_{{0.9, 0.9, 2.1}, {0.0, 0.48, 0.0}, 36};
};

Image shown(const Image& linear) {
  const render::ToneCurve tone;
  Image display = linear;
  for (std::size_t i = 0; i < display.pixels.size(); i += 3) {
    const Colour c = tone(Colour(linear.pixels[i], linear.pixels[i + 1], linear.pixels[i + 2]));
    std::copy_n(&c.r, 3, &display.pixels[i]);
  }
  return display;
}

TEST_F(FinishedPicture, IsTheSameOnAnyNumberOfThreads) {
  std::vector<Image> pictures;
  for (const int threads : {1, 2, 5}) sim::onThreads(threads, [&] { pictures.push_back(draw()); });
  EXPECT_EQ(pictures[0].pixels, pictures[1].pixels);
  EXPECT_EQ(pictures[0].pixels, pictures[2].pixels);
  scene_.to_sun = {-0.5, 0.7, 0.71};  // a little later it is another picture
  EXPECT_NE(pictures[0].pixels, draw().pixels);
}

TEST_F(FinishedPicture, ShowsGreenLeavesOnARedWallUnderABlueSky) {
  const Image display = shown(draw());
  double sum = 0.0;
  int green = 0, red = 0, blue = 0, black = 0, blown = 0;
  for (std::size_t i = 0; i < display.pixels.size(); i += 3) {
    const float r = display.pixels[i], g = display.pixels[i + 1], b = display.pixels[i + 2];
    ASSERT_TRUE(std::isfinite(r + g + b));
    sum += static_cast<double>(r + g + b) / 3.0;
    green += g > 1.15f * r && g > 1.3f * b;
    red += r > 1.4f * g && g > b;
    blue += b > 1.02f * r && b > 0.5f;
    black += std::max({r, g, b}) < 0.02f;
    blown += std::min({r, g, b}) > 0.995f;
  }
  const auto pixels = static_cast<double>(display.pixels.size()) / 3.0;
  EXPECT_GT(green / pixels, 0.05);
  EXPECT_GT(red / pixels, 0.05);
  EXPECT_GT(blue / pixels, 0.02);
  EXPECT_LT(black / pixels, 0.005);
  EXPECT_LT(blown / pixels, 0.005);
  EXPECT_GT(sum / pixels, 0.35);
  EXPECT_LT(sum / pixels, 0.75);
}

TEST_F(FinishedPicture, TheSunCastsShadowsAndSetsAtTheHorizon) {
  const auto brightness = [](const Image& image) {
    double sum = 0.0;  // of the middle, where the wall stands
    for (int y = 40; y < 90; ++y) {
      for (int x = 55; x < 105; ++x) sum += static_cast<double>(image.at(x, y)[0]);
    }
    return sum;
  };
  const double front = brightness(draw());
  scene_.to_sun = {-0.5, 0.7, -0.7};  // behind the wall, which now stands in its own shadow
  const double behind = brightness(draw());
  scene_.to_sun = {-0.5, -0.1, 0.7};
  const double night = brightness(draw());
  EXPECT_LT(behind, 0.8 * front);
  EXPECT_LT(night, behind);
  EXPECT_GT(night, 0.0);
}

/// Light adds up: a picture is as dark as the sky and the sun that are left, in each channel.
TEST_F(FinishedPicture, IsAsBrightAsTheSkyAndTheSunAre) {
  const Image day = draw(80, 60);
  scene_.daylight = {Colour(0.25f, 0.5f, 1.0f), Colour(0.25f, 0.5f, 1.0f)};
  const Image evening = draw(80, 60);
  const std::array shares{0.25f, 0.5f, 1.0f};
  for (std::size_t i = 0; i < day.pixels.size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_NEAR(evening.pixels[i + c], shares[c] * day.pixels[i + c], 0.05f) << i;
  }
  scene_.daylight = {Colour(1.0f), Colour(0.0f)};
  const Image clouded = draw(80, 60);
  scene_.to_sun = -scene_.to_sun;
  scene_.daylight = {};
  EXPECT_NE(clouded.pixels, day.pixels);
  EXPECT_EQ(clouded.at(40, 32)[0], draw(80, 60).at(40, 32)[0]) << "no sun, or one that has set";
  const render::OutdoorLight all = render::outdoorLight({&wall_}, 0.04, {0, 1, 0}),
                             half = render::outdoorLight({&wall_}, 0.04, {0, 1, 0},
                                                         {Colour(0.5f), Colour(0.5f)});
  for (const auto part :
       {&render::OutdoorLight::sky, &render::OutdoorLight::ground, &render::OutdoorLight::sun})
    EXPECT_EQ(half.*part, 0.5f * all.*part);
}

/// A trunk has few sides: where it turns away from the sun, light fades over them and does not end at an
/// edge.
TEST_F(FinishedPicture, TrunksAreRoundInTheSun) {
  sim::Plant plant;
  tests::addNode(plant.skeleton, sim::kNoNode, {0, 0, 0});
  tests::addNode(plant.skeleton, 0, {0, 12, 0});
  plant.girth.twig_vx = 1.5;
  const sim::Frame frame{Vec3(0.0), 0.1, tests::kVineFrame.size};
  const render::PlantModel pole = render::modelPlant(plant, frame);
  scene_.model = {{}, {&pole}};
  camera_ = {{0.0, 0.6, 3.0}, {0.0, 0.6, 0.0}, 12};
  double steepest = 0.0, contrast = 0.0;
  for (const double turn : {-0.1, -0.05, 0.0, 0.05, 0.1}) {
    const glm::dvec2 circle = sim::unitCircle(turn);
    scene_.to_sun = {circle.x, 0.5, circle.y};
    const Image display = shown(draw(200, 120));
    std::vector<double> across;  // the mean over rows, for bark is not even
    for (int x = 80; x < 120; ++x) {
      double sum = 0.0;
      for (int y = 30; y < 90; ++y) sum += static_cast<double>(display.at(x, y)[0]);
      across.push_back(sum / 60.0);
    }
    contrast = std::max(contrast, across.back() - across.front());
    for (std::size_t x = 1; x < across.size(); ++x)
      steepest = std::max(steepest, std::abs(across[x] - across[x - 1]));
  }
  EXPECT_GT(contrast, 0.2);
  EXPECT_LT(steepest, 0.05);
}

/// A roof of two slopes whose normals turn from the one to the other is a vault: light has no edge at its
/// ridge.
TEST_F(FinishedPicture, ScenesAreAsSmoothAsTheirNormals) {
  sim::Mesh roof;
  roof.vertices_m = {{-1, 0, -2}, {-1, 0, 2}, {0, 0.5, -2}, {0, 0.5, 2}, {1, 0, -2}, {1, 0, 2}};
  roof.triangles = {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}};
  roof.materials = {{.name = "clay", .colour = Colour(0.5f)}};
  roof.regions = {"roof"};
  roof.material.assign(4, 0);
  roof.region.assign(4, 0);
  scene_.model = {{&roof}, {}};
  scene_.to_sun = {-0.9, 0.5, 0.0};
  camera_ = {{0.0, 4.0, 0.1}, {0.0, 0.4, 0.0}, 20};
  // How much brighter it is just to the sunny side of the ridge than to the other, of the light there.
  const auto edge = [&] {
    const Image linear = draw(80, 60);
    double left = 0.0, right = 0.0;
    for (int y = 10; y < 50; ++y) {
      left += static_cast<double>(linear.at(37, y)[1]);
      right += static_cast<double>(linear.at(42, y)[1]);
    }
    return (left - right) / left;
  };
  EXPECT_GT(edge(), 0.4);
  const auto leaning = [](float x) { return glm::normalize(Vec3f(x, 2.0f, 0.0f)); };
  roof.normals = {leaning(-1), leaning(-1), leaning(0), leaning(0), leaning(1), leaning(1)};
  EXPECT_LT(edge(), 0.15);
  roof.normals[2] = Vec3f(0.0f);  // of no direction: not known
  roof.normals[3] = Vec3f(0.0f);
  EXPECT_GT(edge(), 0.4);
}

TEST_F(FinishedPicture, FragmentsAreLitByTheirVoxels) {
  const double open = [&] {
    scene_.to_sun = {0, -1, 0};
    return static_cast<double>(draw(40, 30).at(20, 16)[0]);
  }();
  std::fill(sky_.values.begin(), sky_.values.end(), std::uint16_t{0});
  EXPECT_LT(static_cast<double>(draw(40, 30).at(20, 16)[0]), 0.6 * open);
}

/// A texture multiplies the colour of its material: one of magenta leaves no green.
TEST_F(FinishedPicture, ShowsTexturesThatAreKnown) {
  scene_.model.plants.clear();
  const auto brickAt = [&] {
    return Colour(draw(160, 120).at(80, 50)[0], draw(160, 120).at(80, 50)[1], 0.0f);
  };
  auto texture = std::make_shared<sim::Texture>();
  wall_.materials[1].texture = texture;
  wall_.uvs.assign(wall_.vertices_m.size(), glm::vec2(0.5f));
  const Colour bare = brickAt();
  auto picture = std::make_shared<sim::Picture>();
  picture->width = picture->height = 4;
  picture->texels.assign(16, {255, 0, 255, 255});
  scene_.pictures[texture.get()] = picture;
  const Colour painted = brickAt();
  EXPECT_NEAR(painted.r / bare.r, 1.0, 0.25);  // not weathered
  EXPECT_LT(painted.g, 0.05f * bare.g);
  wall_.uvs.clear();
  EXPECT_EQ(brickAt(), bare);
}

TEST_F(FinishedPicture, MissingOrMismatchedFieldsAreRefused) {
  scene_.sky = nullptr;
  EXPECT_THROW(draw(), sim::InputError);
  sim::ExposureField small{{sim::Voxel(2), std::vector<std::uint16_t>(8)}};
  scene_.sky = &small;
  EXPECT_THROW(draw(), sim::InputError);
}

TEST_F(FinishedPicture, AnEmptySceneIsGroundAndSky) {
  scene_.model = {};
  for (const float v : draw(32, 24).pixels) EXPECT_TRUE(std::isfinite(v) && v > 0.0f);
}

TEST_F(FinishedPicture, LooksAsItDid) {
  tests::expectLikeGolden(shown(draw(320, 240)), "finished_picture");
}

TEST(SkyView, AveragesFreeVoxelsInFrontOnly) {
  sim::BitVolume wall({8, 8, 8});
  sim::ExposureField sky{{wall.size(), std::vector<std::uint16_t>(512, sim::ExposureField::kWhole / 2)}};
  for (int y = 0; y < 8; ++y) {
    for (int z = 0; z < 8; ++z) {
      wall.set({2, y, z});
      sky.values[sky.index({2, y, z})] = 0;  // what is inside the wall must not leak out
    }
  }
  const sim::Frame frame{Vec3(0.0), 1.0, wall.size()};
  const render::SkyView view(frame, wall, sky);
  EXPECT_NEAR(view.at({2.5, 3.3, 4.7}, {1, 0, 0}), 0.5f, 1e-4f);
  EXPECT_NEAR(view.at({1.5, 3.3, 4.7}, {-1, 0, 0}), 0.5f, 1e-4f);
  EXPECT_GT(view.at({200, 3, 3}, {0, 1, 0}), 0.99f);  // far outside
}

TEST(Ground, IsTheTopOfAThinSlabButNotOfAPlinth) {
  sim::Mesh slab;
  tests::addBox(slab, {-4, -0.2, -4}, {4, 0, 4}, {"paving", {0.5f, 0.4f, 0.3f}});
  tests::addBox(slab, {-1, 0, -1}, {1, 3, 1}, {"wall", {0.1f, 0.1f, 0.1f}});
  const auto ground = render::groundOf({&slab}, 0.04);
  EXPECT_DOUBLE_EQ(ground.height_m, 0.0);
  EXPECT_NEAR(ground.colour.r, 0.5f, 0.05f);
  sim::Mesh plinth;
  tests::addBox(plinth, {-0.5, 0, -0.5}, {0.5, 0.2, 0.5}, {"stone", {0.5f, 0.5f, 0.5f}});
  tests::addBox(plinth, {-0.3, 0.2, -0.3}, {0.3, 3, 0.3}, {"stone", {0.5f, 0.5f, 0.5f}});
  EXPECT_DOUBLE_EQ(render::groundOf({&plinth}, 0.04).height_m, 0.0);
}

TEST(RayScene, HitsAndShadowsAgreeWithGeometry) {
  const sim::Mesh wall = tests::wallMesh();
  const render::RayScene scene(render::ModelScene{{&wall}, {}});
  const std::array<Vec3f, 4> ways{Vec3f(0, 0, -1), Vec3f(0, -1, 0), Vec3f(0, 0, 1),
                                  glm::normalize(Vec3f(3, 0, -1))};
  const auto hits = scene.firstHits({0.1f, 0.5f, 1.0f}, ways);
  EXPECT_NEAR(hits[0].distance_m, 0.95f, 1e-5f);
  EXPECT_NEAR(std::abs(hits[0].normal.z), 1.0f, 1e-5f);
  EXPECT_FALSE(hits[1].any() || hits[2].any() || hits[3].any());  // beyond the floor's edge
  render::RayScene::ShadowRays rays;
  rays.origins_m.fill({0.1f, 0.5f, 1.0f});
  rays.directions = ways;
  rays.wanted = {true, true, true, false};
  EXPECT_EQ(scene.clear(rays), (std::array<bool, 4>{false, true, true, false}));
}

}  // namespace
}  // namespace espalier
