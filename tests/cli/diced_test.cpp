// Diced models, as a user asks for them.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "tests/cli/plot.h"

namespace espalier {
namespace {

using tests::Plot;

/// Of an OBJ file's statements with this keyword.
std::size_t count(const std::string& obj, const std::string& keyword) {
  std::size_t number = 0;
  for (auto at = obj.find("\n" + keyword + " "); at != obj.npos; at = obj.find("\n" + keyword + " ", at + 1))
    ++number;
  return number;
}

TEST_F(Plot, DicedModelsAreTheSameBytesOnAnyNumberOfThreads) {
  for (const int threads : {1, 2, 5}) {
    const auto ran = grow("--no-pictures --diced first_pass --obj --threads " + std::to_string(threads),
                          "out" + std::to_string(threads));
    ASSERT_EQ(ran.status, 0) << ran.output;
    EXPECT_NE(ran.output.find("diced.glb"), std::string::npos) << ran.output;
    EXPECT_NE(ran.output.find("diced.obj"), std::string::npos) << ran.output;
  }
  const std::string glb = tests::fileText(scratch_.path("out1/diced.glb"));
  const std::string obj = tests::fileText(scratch_.path("out1/diced.obj"));
  for (const char* folder : {"out2", "out5"}) {
    EXPECT_TRUE(glb == tests::fileText(scratch_.path(folder) / "diced.glb")) << folder;
    EXPECT_TRUE(obj == tests::fileText(scratch_.path(folder) / "diced.obj")) << folder;
  }
  EXPECT_NE(glb.find("KHR_materials_unlit"), std::string::npos);
  // The mesh, and of each of two vines stems and leaves: far more triangles than were drawn.
  EXPECT_GE(count(obj, "o"), 5u);
  EXPECT_GT(count(obj, "f"), 5000u);
}

TEST_F(Plot, DicedModelsMayHaveColoursWithoutLight) {
  ASSERT_EQ(grow("--no-pictures --diced surface_colour", "plain").status, 0);
  ASSERT_EQ(grow("--no-pictures --diced first_pass", "lit").status, 0);
  EXPECT_FALSE(std::filesystem::exists(scratch_.path("plain/diced.obj"))) << "nobody asked for OBJ";
  const std::string plain = tests::fileText(scratch_.path("plain/diced.glb"));
  EXPECT_EQ(plain.find("KHR_materials_unlit"), std::string::npos);
  EXPECT_NE(plain, tests::fileText(scratch_.path("lit/diced.glb")));
  EXPECT_EQ(report("plain")["growth"]["state_hash"], report("lit")["growth"]["state_hash"]);
  const auto wrong = grow("--diced shadow_matte", "none");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.output.find("--diced is 'shadow_matte'; expected one of first_pass, surface_colour"),
            std::string::npos)
      << wrong.output;
}

TEST_F(Plot, ADicedModelThatDoesNotFitIsRefusedBeforeAnythingGrows) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers map terabytes";
#endif
  // A floor that lies there many times is no larger a world, but as many fragments.
  std::string mesh = tests::kPlotMesh;
  for (int i = 0; i < 30; ++i) mesh += "f 1 4 3 2\n";
  scratch_.write("plot.obj", mesh);
  std::string scene = tests::kPlotScene;
  scene.replace(scene.find("voxel: 5 cm"), 11, "voxel: 6 mm");
  scratch_.write("scene.yaml", scene);
  const auto ran = tests::run(std::string("ulimit -v 2000000; ") + ESPALIER_PROGRAM + " grow " +
                              scratch_.path("scene.yaml").string() +
                              " --no-pictures --quiet --diced first_pass --obj --threads 2 -o " +
                              scratch_.path("out").string());
  EXPECT_EQ(ran.status, 2);
  EXPECT_NE(ran.output.find("scene.yaml:6:10: mesh 'plot': cut to the grid of voxels it has "),
            std::string::npos)
      << ran.output;
  EXPECT_NE(ran.output.find("expected larger voxels"), std::string::npos) << ran.output;
  EXPECT_FALSE(std::filesystem::exists(scratch_.path("out/diced.glb")));
}

}  // namespace
}  // namespace espalier
