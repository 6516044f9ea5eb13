#include "scenes/show/cube_pictures.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "render/image/image_io.h"
#include "scenes/job/run.h"
#include "scenes/read/read_scene.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

/// A world of five voxels of 10 cm a side with a floor of two triangles, and what stands on it.
class CubePicture : public testing::Test {
 protected:
  void SetUp() override {
    scratch_.write("floor.obj",
                   "v 0 0.02 0\nv 0.5 0.02 0\nv 0.5 0.02 0.5\nv 0 0.02 0.5\ng floor\nf 1 4 3\nf 1 3 2\n");
    scratch_.write("twig.yaml",
                   "espalier: rules\nrandom_tree: {length: 1.4, trials: {min: 1, max: 40}}\nbias: {up: 0.5}\n"
                   "elements: [{size: 0.8, polygons: [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]}]\n");
  }
  std::string scene(const std::string& more, const std::string& world = "voxel: 10 cm") {
    return "espalier: scene\nmeshes: [floor.obj]\nworld: {" + world +
           ", bounds: {min: [0, 0, 0], max: [0.5, 0.5, 0.5]}}\niterations: 3\n"
           "image: {width: 120, height: 90}\ncameras: {main: {eye: [1.6, 1.3, 2], target: [0.25, 0.2, "
           "0.25]}}\n" +
           more;
  }
  Report run(const std::string& text) {
    auto read = readScene(scratch_.write("scene.yaml", text));
    EXPECT_TRUE(read) << format(read.problems());
    RunOptions options;
    options.folder = scratch_.path("out");
    return runScene(*read, options);
  }
  std::string picture() { return tests::fileText(scratch_.path("out/voxels.png")); }

  tests::Scratch scratch_;
};

TEST_F(CubePicture, ShowsMeshesLinesAndPlants) {
  const std::string image = "images: [voxels]\n";
  run(scene(image));
  const std::string bare = picture();
  ASSERT_FALSE(bare.empty());
  std::string lined = scene(image);
  lined.replace(lined.find("[floor.obj]"), 11,
                "[floor.obj, {lines: [[[0.25, 0.15, 0.25], [0.45, 0.45, 0.05]]], name: rod}]");
  run(lined);
  EXPECT_NE(picture(), bare);
  run(scene(image + "plants: [{name: twig, rules: twig.yaml, seeds: [[0.25, 0.15, 0.25]]}]\n"));
  EXPECT_NE(picture(), bare);
}

TEST_F(CubePicture, AWorldOfTooManyVoxelsIsRefusedBeforeAnythingGrowsWithTheVoxelThatWouldDo) {
  try {
    run(scene("images: [{kind: voxels, name: figure}]\n", "voxel: 7 mm"));
    FAIL() << "72 voxels a side were drawn";
  } catch (const sim::InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("image 'figure': 72 x 72 x 72 voxels are too many to be seen one by one; expected at "
                        "most 64 along each side, as with a voxel of 0.008 m"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("scene.yaml:"), std::string::npos) << text;
  }
  EXPECT_FALSE(std::filesystem::exists(scratch_.path("out")));
  run(scene("images: [{kind: voxels, name: figure}]\n", "voxel: 8 mm"));
  EXPECT_TRUE(std::filesystem::exists(scratch_.path("out/figure.png")));
}

}  // namespace
}  // namespace espalier::scenes
