#include "scenes/show/pictures.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "sim/base/error.h"
#include "sim/light/sky.h"
#include "tests/support/meshes.h"

namespace espalier::scenes {
namespace {

PlantSpec plantThatNeeds(double sun, double sky, double least) {
  auto rules = std::make_shared<rules::RuleSet>();
  rules->light.sun = sun;
  rules->light.sky = sky;
  rules->require.exposure_min = least;
  PlantSpec plant;
  plant.rules = rules;
  return plant;
}

TEST(Pictures, ThresholdPanelsSpeakOfTheFirstPlant) {
  Scene scene;
  EXPECT_FALSE(picturesOf(scene).plant_light);
  scene.plants = {plantThatNeeds(1.0, 3.0, 0.2), plantThatNeeds(1.0, 0.0, 0.7)};
  const auto light = picturesOf(scene).plant_light;
  ASSERT_TRUE(light);
  EXPECT_EQ(light->sun, 0.25f);
  EXPECT_EQ(light->sky, 0.75f);
  EXPECT_EQ(light->least, 0.2f);
}

ImageSpec image(const std::string& name, ImageKind kind) {
  ImageSpec spec;
  spec.name = name;
  spec.kind = kind;
  return spec;
}

/// Half-shaded ground, to be drawn with any cameras and images.
class Ground : public testing::Test {
 protected:
  Ground() {
    wanted_.title = "ground";
    wanted_.width_px = 80;
    wanted_.height_px = 60;
    wanted_.cameras.push_back({"main", {{8, 12, 18}, {8, 0, 6}, 40}});
  }
  static sim::World world() {
    sim::Mesh ground = tests::emptyMesh("ground");
    ground.vertices_m = {{0, 0.5, 0}, {16, 0.5, 0}, {16, 0.5, 12}, {0, 0.5, 12}};
    tests::addTriangle(ground, 0, 2, 1);
    tests::addTriangle(ground, 0, 3, 2);
    return sim::buildWorld(
        {sim::Vec3(0.5), 1.0, {16, 8, 12}},
        {{ground, false}, {tests::boxMesh({2.2, 0.6, 2.2}, {5.8, 5.8, 8.8}, "block"), true}}, 0);
  }
  std::map<std::string, std::string> draw() const {
    const std::vector<sim::TiledMesh> no_meshes;
    const std::vector<sim::Attempt> no_attempts;
    const std::vector<render::PlantModel> no_models;
    std::map<std::string, std::string> files;
    for (const OutputFile& file :
         drawPictures(wanted_, {no_meshes, world_, no_attempts, light_, no_models})) {
      std::ostringstream out;
      file.write(out);
      files[file.name] = std::move(out).str();
    }
    return files;
  }

  const sim::World world_ = world();
  const sim::Lighting light_ = sim::lightOf(world_, sim::makeSky({.directions = 64}));
  PicturesWanted wanted_;
};

TEST_F(Ground, TheImagesAskedForAreDrawnAndNoOthers) {
  wanted_.images = {image("a", ImageKind::surface_colour), image("b", ImageKind::threshold)};
  const auto files = draw();
  ASSERT_EQ(files.size(), 4u);
  for (const char* name : {"a.png", "a.exr", "b.png", "b.exr"}) EXPECT_TRUE(files.contains(name)) << name;
}

TEST_F(Ground, ThresholdPanelsShowThePlantsOwnNeeds) {
  wanted_.images = {image("b", ImageKind::threshold)};
  wanted_.plant_light = PlantLight{0.0f, 1.0f, 0.1f};
  const auto fern = draw(), again = draw();
  wanted_.plant_light->least = 0.9f;
  EXPECT_EQ(fern, again);
  EXPECT_NE(fern, draw());
}

TEST_F(Ground, AnImageWithoutItsCameraIsNamed) {
  wanted_.images = {image("a", ImageKind::surface_colour)};
  wanted_.images[0].camera = "side";
  try {
    draw();
    FAIL() << "drew without a camera";
  } catch (const sim::InputError& error) {
    EXPECT_STREQ(error.what(), "image 'a' needs a camera");
  }
}

}  // namespace
}  // namespace espalier::scenes
