#include "scenes/show/pictures.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "scenes/show/expose_pictures.h"
#include "sim/base/error.h"
#include "sim/light/sky.h"
#include "tests/support/meshes.h"

namespace espalier::scenes {
namespace {

PlantSpec plantThatNeeds(const std::string& name, double sun, double sky, double least) {
  auto rules = std::make_shared<rules::RuleSet>();
  rules->light.sun = sun;
  rules->light.sky = sky;
  rules->require.exposure_min = least;
  PlantSpec plant;
  plant.name = name;
  plant.rules = rules;
  return plant;
}

TEST(Pictures, ThresholdPanelsCanShowEachPlant) {
  Scene scene;
  EXPECT_TRUE(picturesOf(scene).plants.empty());
  scene.plants = {plantThatNeeds("fern", 1.0, 3.0, 0.2), plantThatNeeds("rose", 1.0, 0.0, 0.7)};
  const auto plants = picturesOf(scene).plants;
  ASSERT_EQ(plants.size(), 2u);
  EXPECT_EQ(plants[0].name, "fern");
  EXPECT_EQ(plants[0].needs, (render::LightNeeds{0.25f, 0.75f, 0.2f}));
  EXPECT_EQ(plants[1].name, "rose");
  EXPECT_EQ(plants[1].needs, (render::LightNeeds{1.0f, 0.0f, 0.7f}));
}

TEST(Pictures, OfExposureHaveAThresholdForEachLightThatPlantsAskFor) {
  Scene scene;
  const auto thresholds = [&](std::vector<NamedCamera> cameras) {
    std::vector<std::pair<std::string, std::string>> found;
    for (const ImageSpec& image : exposureImages(scene, cameras, true)) {
      if (image.kind == ImageKind::threshold) found.emplace_back(image.name, image.plant);
    }
    return found;
  };
  using Found = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(thresholds({{"main", {}}}), Found());
  scene.plants = {plantThatNeeds("fern", 1, 3, 0.2), plantThatNeeds("moss", 1, 3, 0.2)};
  EXPECT_EQ(thresholds({{"main", {}}}), (Found{{"threshold", ""}}));
  scene.plants.push_back(plantThatNeeds("rose", 1, 0, 0.7));
  EXPECT_EQ(thresholds({{"main", {}}}), (Found{{"threshold_fern", "fern"}, {"threshold_rose", "rose"}}));
}

TEST(Pictures, OfCamerasWithAnyNamesLieInTheFolder) {
  Scene scene;
  std::set<std::string> names;
  std::size_t images = 0;
  for (const ImageSpec& image : exposureImages(scene, {{"../up", {}}, {".._up", {}}, {"c\n/d", {}}}, true)) {
    EXPECT_EQ(image.name.find_first_of("/\n"), std::string::npos) << image.name;
    names.insert(image.name);
    ++images;
  }
  EXPECT_EQ(names.size(), images);
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
    const std::vector<render::PlantModel> no_models;
    std::map<std::string, std::string> files;
    for (const OutputFile& file :
         drawPictures(wanted_, {no_meshes, world_, bare_, growth_, light_, no_models})) {
      std::stringstream out;
      file.write(out);
      files[file.name] = std::move(out).str();
    }
    return files;
  }

  sim::World world_ = world();
  sim::BitVolume bare_ = world_.occupied();
  sim::Growth growth_;
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
  const auto none = draw();
  wanted_.plants = {{"fern", {0.0f, 1.0f, 0.1f}}};
  const auto fern = draw(), again = draw();
  EXPECT_EQ(fern, again);
  EXPECT_NE(fern, none);
  wanted_.plants.push_back({"rose", {0.0f, 1.0f, 0.9f}});
  wanted_.images[0].plant = "rose";
  const auto rose = draw();
  wanted_.plants[0].needs.least = 0.5f;
  EXPECT_EQ(draw(), rose) << "the first plant is another's concern";
  wanted_.images[0].plant = "fern";
  EXPECT_NE(draw(), rose);
}

TEST_F(Ground, ACameraAroundWhichAPlantHasGrownLooksOutOfIt) {
  wanted_.images = {image("a", ImageKind::surface_colour)};
  wanted_.cameras = {{"main", {{8, 5, 11.5}, {8, 0, 6}, 40}}};
  const auto before = draw();
  const sim::PartId stem = world_.addPart({"vine", "stem", sim::PartKind::stem, 0});
  const sim::Voxel eye = sim::voxelAt(sim::voxelFromWorld(world_.frame(), wanted_.cameras[0].camera.eye_m));
  world_.occupy(std::vector<sim::TiledVoxel>{{eye, {stem, sim::Colour(1.0f), 1.0f}}});
  EXPECT_EQ(draw(), before);
  world_.occupy(std::vector<sim::TiledVoxel>{{eye + sim::Voxel(0, -1, 0), {stem, sim::Colour(1.0f), 1.0f}}});
  EXPECT_NE(draw(), before);                    // what stands beside it is seen
  wanted_.cameras[0].camera.eye_m = {4, 3, 4};  // in the block
  EXPECT_THROW(draw(), sim::InputError);
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
