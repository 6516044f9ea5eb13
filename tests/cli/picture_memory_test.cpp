// Pictures take memory that is counted before anything is tiled.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "scenes/read/read_scene.h"
#include "scenes/show/picture_memory.h"
#include "sim/base/parallel.h"
#include "tests/cli/plot.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using tests::Plot;

TEST_F(Plot, PicturesThatTakeTooMuchMemoryAreRefusedBeforeAnythingIsTiled) {
  std::string scene = tests::kPlotScene;
  scene.replace(scene.find("width: 160, height: 120"), 23, "width: 16000, height: 16000");
  scratch_.write("scene.yaml", scene);
  scratch_.write("plot.obj", "f 1 2 3\n");  // tiling would begin with a complaint about it
  for (const char* command : {"grow", "expose"}) {
    const auto ran =
        tests::run("ulimit -v 8000000; " + std::string(ESPALIER_PROGRAM) + " " + command + " " +
                   scratch_.path("scene.yaml").string() + " -o " + scratch_.path("out").string());
    EXPECT_EQ(ran.status, 2);
    EXPECT_NE(ran.output.find("scene.yaml:16:1: "), std::string::npos) << ran.output;
    EXPECT_NE(ran.output.find("5.7 GB are free for it here; expected at most "), std::string::npos)
        << ran.output;
    EXPECT_EQ(ran.output.find("plot.obj"), std::string::npos) << ran.output;
    EXPECT_FALSE(fs::exists(scratch_.path("out")));
  }
}

TEST_F(Plot, PicturesTakeNoMoreMemoryThanIsCounted) {
  std::string scene = tests::kPlotScene;
  scene.replace(scene.find("width: 160, height: 120"), 23, "width: 1600, height: 1200");
  scratch_.write("scene.yaml", scene);
  ASSERT_EQ(grow("--threads 2", "with").status, 0);
  ASSERT_EQ(grow("--threads 2 --no-pictures", "without").status, 0);
  const auto peak = [&](const char* folder) {
    return report(folder)["run"]["peak_memory_bytes"].get<double>();
  };
  const auto read = scenes::readScene(scratch_.path("scene.yaml"));
  ASSERT_TRUE(read);
  double counted = 0.0;
  sim::onThreads(2, [&] { counted = scenes::pictureBytes(scenes::picturesOf(*read), 1.0); });
  EXPECT_LT(peak("with") - peak("without"), counted);
  EXPECT_GT(peak("with") - peak("without"), 0.25 * counted);
}

}  // namespace
}  // namespace espalier
