#include <gtest/gtest.h>

#include <string>

#include "scenes/job/run.h"
#include "scenes/read/read_scene.h"
#include "tests/support/scratch.h"

/// Plants that are formed once they have grown: what is kept is what grew, and what is written is what is
/// shown.
namespace espalier::scenes {
namespace {

class FormedPlants : public testing::Test {
 protected:
  Scene scene(const std::string& forks, int iterations) {
    const auto read = readScene(scratch_.write(
        "scene.yaml",
        "espalier: scene\nworld: {voxel: 5 cm, bounds: {min: [-2, 0, -2], max: [2, 4, 2]}}\nplants:\n"
        "  - {seeds: [[0, 0.1, 0]], rules: {propagate: colonization, colonization: {crown: {sphere: 1.4 m, "
        "trunk: 0.6 m, count: 150}}, stem: {radius: 4 mm, exponent: 3, forks: " +
            forks + "}}}\niterations: " + std::to_string(iterations) +
            "\ncameras: {main: {eye: [0, 2, 7], target: [0, 2, 0]}}\nimage: {width: 96, height: 96}\n"
            "images: [vines]\n"));
    EXPECT_TRUE(read) << format(read.problems());
    return *read;
  }
  Report run(const Scene& scene, const std::string& folder, bool resume = false) {
    RunOptions options;
    options.folder = scratch_.path(folder);
    return runScene(scene, options, {.resume = resume});
  }
  std::string text(const std::string& file) const { return tests::fileText(scratch_.path(file)); }

  tests::Scratch scratch_;
};

TEST_F(FormedPlants, GrowAsOthersDo) {
  const Report grown = run(scene("grown", 200), "grown"), murray = run(scene("murray", 200), "murray");
  EXPECT_EQ(grown.growth->state_hash, murray.growth->state_hash);
  EXPECT_GT(grown.growth->plants.at(0).segments, 60u);
  EXPECT_NE(text("grown/skeleton.json"), text("murray/skeleton.json"));
  EXPECT_NE(text("grown/vines.png"), text("murray/vines.png"));
}

TEST_F(FormedPlants, GoOnFromWhatGrew) {
  run(scene("murray", 200), "whole");
  run(scene("murray", 12), "parts");
  run(scene("murray", 200), "parts", true);
  for (const char* file : {"skeleton.json", "plant.glb", "world.vdb", "vines.png", "growth.state"})
    EXPECT_EQ(text(std::string("whole/") + file), text(std::string("parts/") + file)) << file;
}

TEST_F(FormedPlants, AreDrawnAgainInTheirForm) {
  const Scene whole = scene("murray", 200);
  run(whole, "whole");
  RunOptions options;
  options.folder = scratch_.path("again");
  renderScene(whole, scratch_.path("whole"), options);
  EXPECT_EQ(text("whole/vines.png"), text("again/vines.png"));
}

}  // namespace
}  // namespace espalier::scenes
