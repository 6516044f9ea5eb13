#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/finish/clear_surface.h"
#include "render/finish/finished_picture.h"
#include "render/finish/ray_scene.h"
#include "sim/base/parallel.h"
#include "sim/light/sky.h"
#include "sim/sweep/sweep.h"
#include "tests/support/meshes.h"
#include "tests/support/small_vine.h"

/// Panes before a board, seen straight on, and what stands under them.
namespace espalier {
namespace {

using render::Image;
using sim::Colour;
using sim::Vec3;
using sim::Vec3f;

/// A board square to z, with its back to the world's floor.
sim::Mesh board(double z_m, double half_m, const Colour& colour, double opacity = 1.0) {
  sim::Mesh mesh;
  mesh.name = "board";
  mesh.vertices_m = {
      {-half_m, -half_m, z_m}, {half_m, -half_m, z_m}, {half_m, half_m, z_m}, {-half_m, half_m, z_m}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.region = mesh.material = {0, 0};
  mesh.regions = {"board"};
  mesh.materials = {{"board", colour}};
  sim::setOpacity(mesh.materials[0], opacity);
  return mesh;
}

class Translucent : public testing::Test {
 protected:
  /// Of the middle, where rays meet everything square on.
  Colour seen(const std::vector<sim::Mesh>& meshes, const render::PlantModel* plant = nullptr) const {
    const Image image = drawn(meshes, plant);
    Colour sum(0.0f);
    for (int y = 7; y <= 8; ++y)
      for (int x = 7; x <= 8; ++x) sum += Colour(image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]);
    return sum / 4.0f;
  }
  Image drawn(const std::vector<sim::Mesh>& meshes, const render::PlantModel* plant = nullptr) const {
    render::FinishedScene scene;
    for (const sim::Mesh& mesh : meshes) scene.model.meshes.push_back(&mesh);
    if (plant != nullptr) scene.model.plants.push_back(plant);
    scene.frame = {Vec3(-2.0, -2.0, -2.0), 0.1, {40, 40, 40}};
    scene.occupied = &free_;
    scene.sky = &sky_;
    scene.to_sun = to_sun_;
    return render::finishedPicture(scene, {{0, 0, 1.8}, {0, 0, 0}, 2}, 16, 16);
  }

  sim::BitVolume free_{sim::Voxel(40)};
  sim::ExposureField sky_ = sim::sweepExposure(free_, sim::makeSky({.directions = 32}).directions);
  Vec3 to_sun_{0.3, 0.2, 1.0};
};

TEST_F(Translucent, WhatIsBehindIsSeenByWhatIsLeft) {
  const sim::Mesh behind = board(-1.0, 3.0, {0.7f, 0.1f, 0.1f});
  to_sun_ = {0.0, -1.0, 0.0};  // without a sun a pane casts no shadow on the board
  const Colour alone = seen({behind});
  const float passes = 1.0f - render::filmMirror(1.0f);
  const Colour clear = seen({board(0.0, 1.0, Colour(0.0f), 0.0), behind});
  const Colour mirrored = clear - passes * alone;
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(mirrored[c], 0.0f) << "a pane mirrors";
    EXPECT_LT(mirrored[c], 0.05f);
  }
  for (const float alpha : {0.25f, 0.5f, 0.75f}) {
    const Colour black = seen({board(0.0, 1.0, Colour(0.0f), static_cast<double>(alpha)), behind});
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(black[c], passes * (1.0f - alpha) * alone[c] + mirrored[c], 2e-3f) << alpha;
  }
}

TEST_F(Translucent, PanesOneBehindAnotherEachTakeTheirShare) {
  to_sun_ = {0.0, -1.0, 0.0};
  std::vector<sim::Mesh> meshes{board(-1.0, 3.0, {0.9f, 0.9f, 0.9f})};
  std::vector<float> light;  // behind so many panes
  for (int panes = 0; panes <= 5; ++panes) {
    light.push_back(seen(meshes).r);
    meshes.push_back(board(0.1 * panes, 1.0, Colour(0.0f), 0.4));
  }
  const float passes = 0.6f * (1.0f - render::filmMirror(1.0f));
  const float mirrored = light[1] - passes * light[0];
  for (std::size_t n = 2; n < light.size(); ++n)
    EXPECT_NEAR(light[n], passes * light[n - 1] + mirrored, 1e-4f) << n;
  EXPECT_LT(light[5], 0.5f * light[0]);
  // As many as there may be, each nearly clear, and more.
  while (meshes.size() < 80)
    meshes.push_back(board(0.01 * static_cast<double>(meshes.size()), 1.0, Colour(0.5f), 0.001));
  EXPECT_TRUE(std::isfinite(seen(meshes).r));
}

TEST_F(Translucent, WhatHidesAllIsDrawnAsEver) {
  const sim::Mesh behind = board(-1.0, 3.0, {0.7f, 0.1f, 0.1f});
  sim::Mesh opaque = board(0.0, 0.03, {0.2f, 0.4f, 0.8f}), plain = opaque;
  sim::setOpacity(opaque.materials[0], 0.5);
  sim::setOpacity(opaque.materials[0], 1.0);
  EXPECT_EQ(opaque.materials[0].alpha_mode, sim::Material::Alpha::opaque);
  EXPECT_EQ(drawn({opaque, behind}).pixels, drawn({plain, behind}).pixels);
}

TEST_F(Translucent, IsTheSameOnAnyNumberOfThreads) {
  const std::vector<sim::Mesh> meshes{board(0.0, 0.04, {0.2f, 0.4f, 0.8f}, 0.3),
                                      board(0.2, 0.02, {0.9f, 0.9f, 0.9f}, 0.6),
                                      board(-1.0, 3.0, Colour(0.5f))};
  std::vector<Image> pictures;
  for (const int threads : {1, 3}) sim::onThreads(threads, [&] { pictures.push_back(drawn(meshes)); });
  EXPECT_EQ(pictures[0].pixels, pictures[1].pixels);
}

TEST_F(Translucent, CastsAShadowThatIsAsMuchLighter) {
  const sim::Mesh behind = board(-1.0, 3.0, {0.5f, 0.5f, 0.5f});
  to_sun_ = {1.0, 0.1, 1.0};
  // Beside the line of sight, between the middle of the board and the sun.
  const auto under = [&](double opacity) {
    sim::Mesh pane = board(0.0, 0.3, Colour(0.5f), opacity);
    for (Vec3& corner : pane.vertices_m) corner.x += 1.0;
    return seen({pane, behind}).g;
  };
  const float open = seen({behind}).g, dark = under(1.0);
  EXPECT_LT(dark, 0.7f * open);
  for (const float alpha : {0.0f, 0.3f, 0.8f})
    EXPECT_NEAR(under(static_cast<double>(alpha)), alpha * dark + (1.0f - alpha) * open, 1e-3f) << alpha;
}

TEST_F(Translucent, AStemHidesOnceAndNotAtItsBackToo) {
  sim::Plant plant;
  tests::addNode(plant.skeleton, sim::kNoNode, {20, 12, 20});
  tests::addNode(plant.skeleton, 0, {20, 28, 20});
  plant.girth.twig_vx = 2.0;
  plant.stem_alpha = 0.4f;
  const sim::Frame frame{Vec3(-2.0, -2.0, -2.0), 0.1, {40, 40, 40}};
  const render::PlantModel pole = render::modelPlant(plant, frame);
  EXPECT_EQ(pole.stems.alpha, 0.4f);
  const render::RayScene rays(render::ModelScene{{}, {&pole}});
  EXPECT_TRUE(rays.translucent());
  render::RayScene::ShadowRays through;
  through.origins_m.fill({0.05f, 0.02f, 3.0f});
  through.directions.fill({0, 0, -1});
  through.wanted = {true, true, true, false};
  through.directions[1] = {0, 0, 1};
  const auto light = rays.lightThrough(through);
  EXPECT_NEAR(light[0], 0.6f, 1e-6f);
  EXPECT_EQ(light[1], 1.0f);
  EXPECT_EQ(light[3], 0.0f);
  EXPECT_FALSE(rays.clear(through)[0]) << "it stands in the way all the same";
  const auto first = rays.firstHits({0.05f, 0.02f, 3.0f}, through.directions);
  ASSERT_TRUE(first[0].any());
  const auto next = rays.nextHits({0.05f, 0.02f, 3.0f}, through.directions,
                                  {first[0].distance_m * 1.0001f, 0, 0, 0}, {true, false, false, false});
  EXPECT_FALSE(next[0].any()) << "it is met from outside alone";
}

TEST(ClearSurface, MirrorsMoreTheMoreItIsSeenFromTheSide) {
  EXPECT_NEAR(render::filmMirror(1.0f), 2.0f * 0.02f / 1.02f, 1e-6f);
  EXPECT_NEAR(render::filmMirror(0.0f), 1.0f, 1e-6f);
  for (float facing = 0.1f; facing <= 1.0f; facing += 0.1f)
    EXPECT_LT(render::filmMirror(facing), render::filmMirror(facing - 0.1f));
}

}  // namespace
}  // namespace espalier
