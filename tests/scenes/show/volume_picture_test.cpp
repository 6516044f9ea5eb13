#include "scenes/show/volume_picture.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "render/voxels/visibility.h"
#include "sim/base/parallel.h"
#include "sim/light/sky.h"
#include "tests/support/meshes.h"
#include "tests/support/worlds.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;
using sim::Voxel;

const Vec3 kAfternoonSun = glm::normalize(Vec3(0.35, 0.8, 0.45));

/// Meshes in a world of a hundred and some voxels, to be drawn as cubes and as a volume.
struct DrawnMeshes {
  explicit DrawnMeshes(const std::vector<sim::TiledMesh>& of, Voxel size = Voxel(128))
      : meshes(of), world(sim::buildWorld(tests::unitFrame(size), meshes, 0)), bare(world.occupied()) {
    sim::LightWanted wanted;
    wanted.to_sun = kAfternoonSun;
    light = sim::lightOf(world, sim::makeSky({sim::Weighting::uniform, 0.005, 64}), {}, wanted);
  }
  WorldOccupancy occupancy() const { return {scene, meshes, world, bare, growth.plants}; }
  render::PanelPicture volume(const render::Camera& camera) const {
    const WorldOccupancy taken = occupancy();
    return volumePicture({meshes, world, bare, growth, light, models, {}, {}, {}, &taken}, kAfternoonSun,
                         camera, 200, 160);
  }
  render::PanelPicture cubes(const render::Camera& camera) const {
    const sim::Bricks bricks(world.occupied());
    const auto faces = [this](const sim::Received& received) {
      return [this, &received](Voxel v, std::uint8_t face) { return light.atFace(received, v, face); };
    };
    const render::PanelWorld shown{world.occupied(), bricks, {}, faces(light.sky), [this](Voxel v) {
                                     return world.surfaceAt(v)->colour;
                                   }};
    render::PanelLook look;
    look.to_sun = kAfternoonSun;
    const std::vector<render::Panel> panels{render::Panel::first_pass};
    const render::Visibility seen = render::see(world.frame(), world.occupied(), bricks, camera, 200, 160);
    return render::PanelPainter(seen, shown, look, panels).paint(render::Panel::first_pass);
  }

  Scene scene;
  std::vector<sim::TiledMesh> meshes;
  sim::World world;
  sim::BitVolume bare;
  sim::Growth growth;
  sim::Lighting light;
  std::vector<render::PlantModel> models;
};

/// Of what is no sky.
double brightness(const render::Image& measured) {
  double light = 0.0, opacity = 0.0;
  for (std::size_t i = 0; i < measured.pixels.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) light += static_cast<double>(measured.pixels[i + c]) / 3.0;
    opacity += static_cast<double>(measured.pixels[i + 3]);
  }
  return light / opacity;
}

sim::Mesh turnedBox(double turn_deg, Vec3 axis) {
  sim::Mesh box = tests::boxMesh({-38, -36, -34}, {38, 36, 34});
  const glm::dquat turned = glm::angleAxis(turn_deg * std::numbers::pi / 180.0, glm::normalize(axis));
  for (Vec3& p : box.vertices_m) p = turned * p + Vec3(64.2, 63.9, 64.1);
  return box;
}

TEST(VolumePicture, SolidsAreAsBrightAsTheirCubes) {
  const std::vector<std::pair<std::string, sim::Mesh>> solids{
      {"a box", turnedBox(0.0, {0, 1, 0})},
      {"a box that is turned a little", turnedBox(7.0, {0, 0, 1})},
      {"a box that is turned", turnedBox(30.0, {0, 1, 0})},
      {"a box that leans", turnedBox(25.0, {1, 2, 3})},
      {"a sphere", tests::sphereMesh(Vec3(64.0), 50.0, 64)}};
  for (const auto& [name, mesh] : solids) {
    const DrawnMeshes shown({{mesh, true}});
    // Cubes reach up to a voxel farther out: where the eye sees more dark than bright sides, they show more
    // of the bright ones.
    for (const auto& [eye_m, most] : {std::pair(Vec3(230, 180, 300), 0.02), {Vec3(-80, 150, 310), 0.04}}) {
      const render::Camera camera{eye_m, Vec3(64.0), 32};
      const double cubes = brightness(shown.cubes(camera).measured);
      EXPECT_NEAR(brightness(shown.volume(camera).measured), cubes, most * cubes)
          << name << " from " << eye_m.x;
    }
  }
}

TEST(VolumePicture, HasTheColoursOfItsVoxelsAndTheSkyBehind) {
  const DrawnMeshes shown({{turnedBox(0.0, {0, 1, 0}), true}});
  const render::PanelPicture picture = shown.volume({{64, 64, 400}, Vec3(64.0), 32});
  EXPECT_EQ(picture.channel_names, (std::vector<std::string>{"R", "G", "B", "A"}));
  const float* const middle = picture.measured.at(100, 80);
  EXPECT_EQ(middle[3], 1.0f);
  EXPECT_GT(middle[0], 0.1f);
  EXPECT_EQ(picture.measured.at(1, 1)[3], 0.0f);
  const render::PanelPicture cubes = shown.cubes({{64, 64, 400}, Vec3(64.0), 32});
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(picture.display.at(100, 80)[c], cubes.display.at(100, 80)[c], 0.01f);
    EXPECT_NEAR(picture.display.at(1, 1)[c], cubes.display.at(1, 1)[c], 0.01f);
  }
}

TEST(VolumePicture, LeavesAndStemsAreSeen) {
  DrawnMeshes shown({{tests::boxMesh({4, 2, 4}, {40, 6, 40}), true}}, Voxel(48));
  const sim::PartId leaf = shown.world.addPart(tests::elementPart("fern"));
  std::vector<sim::TiledVoxel> leaves;
  for (int x = 10; x < 34; ++x) {
    for (int z = 10; z < 34; ++z)
      leaves.push_back(
          {{x, 20, z}, {.part = leaf, .colour = sim::Colour(0.1f, 0.5f, 0.1f), .coverage = 0.6f}});
  }
  shown.world.occupy(leaves);
  const render::PanelPicture picture = shown.volume({{24, 20, 90}, {22, 20, 24}, 20});
  EXPECT_GT(picture.measured.at(100, 80)[3], 0.9f);
  const WorldOccupancy occupancy = shown.occupancy();
  EXPECT_FLOAT_EQ(occupancy.at({12, 20, 12}).alpha, 0.6f * static_cast<float>(WorldOccupancy::kLeaf_m));
  EXPECT_EQ(occupancy.at({12, 19, 12}), sim::Occupancy());
  EXPECT_EQ(occupancy.at({12, 4, 12}), (sim::Occupancy{1.0f, 1.0f}));
  EXPECT_FALSE(occupancy.full().at({12, 20, 12}));
  EXPECT_TRUE(occupancy.full().at({12, 4, 12}));
}

TEST(VolumePicture, TheSameOnAnyNumberOfThreads) {
  const DrawnMeshes shown({{turnedBox(25.0, {1, 2, 3}), true}});
  const render::Camera camera{{230, 180, 300}, Vec3(64.0), 32};
  const auto draw = [&] { return shown.volume(camera).display.pixels; };
  const auto first = draw();
  for (const int threads : {1, 2, 5}) sim::onThreads(threads, [&] { EXPECT_EQ(draw(), first); });
}

TEST(VolumePicture, SheetsAreAsThickAsTheSceneSays) {
  sim::Mesh sheet = tests::emptyMesh("fence");
  sheet.vertices_m = {{4, 4, 12.2}, {20, 4, 12.2}, {20, 20, 12.2}, {4, 20, 12.2}};
  tests::addTriangle(sheet, 0, 1, 2);
  tests::addTriangle(sheet, 0, 2, 3);
  DrawnMeshes shown({{sheet, false}}, Voxel(24));
  SceneMesh fence;
  fence.name = "fence";
  fence.thickness_m = 0.25;
  shown.scene.meshes = {fence};
  EXPECT_FLOAT_EQ(shown.occupancy().at({10, 10, 12}).alpha, 0.25f);
  EXPECT_FLOAT_EQ(shown.occupancy().at({10, 10, 12}).stops, 1.0f);
}

}  // namespace
}  // namespace espalier::scenes
