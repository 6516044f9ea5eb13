// Growth without limits ends with a sentence before memory does.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/plot.h"

namespace espalier {
namespace {

/// An open world, and a bush that fills it as fast as it can.
class Unlimited : public tests::Plot {
 protected:
  void SetUp() override {
    tests::Plot::SetUp();
    scratch_.write("bush.yaml", R"(espalier: rules
name: bush
propagate: random_tree
random_tree: {length: 3.4, branch_age_range: [1, 2], branch_angle: [40, 70], trials: {min: 1, max: 12}}
require: {clear: true}
elements: []
)");
    scratch_.write("scene.yaml", R"(espalier: scene
name: open
meshes:
  - file: plot.obj
world:
  voxel: 2 cm
  bounds: {min: [-3, -0.1, -3], max: [3, 4, 3]}
plants:
  - name: bush
    rules: bush.yaml
    seeds: [[-0.6, 0.1, 0.4], [0.5, 0.1, 0.5]]
iterations: 100000
)");
  }

  tests::Ran growIn(int kilobytes, const std::string& more) {
    return tests::run("ulimit -v " + std::to_string(kilobytes) + "; " + ESPALIER_PROGRAM + " grow " +
                      scratch_.path("scene.yaml").string() + " --threads 2 -o " +
                      scratch_.path("out").string() + " " + more);
  }
};

TEST_F(Unlimited, GrowthEndsWhereTheNextIterationDoesNotFit) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers map terabytes";
#endif
  const auto ran = growIn(1'000'000, "");
  ASSERT_EQ(ran.status, 0) << ran.output;
  const std::string sentence = "growth stopped after ";
  EXPECT_NE(ran.output.find("note: " + sentence), std::string::npos) << ran.output;
  const nlohmann::json r = report();
  ASSERT_EQ(r["warnings"].size(), 1u);
  EXPECT_EQ(r["warnings"][0].get<std::string>().find(sentence), 0u);
  const int iterations = r["growth"]["iterations"].get<int>();
  EXPECT_GT(iterations, 5);
  EXPECT_LT(iterations, 100000);
  EXPECT_TRUE(files(scratch_.path("out")).contains("world.vdb"));

  const auto more =
      growIn(4'000'000, "--resume --no-pictures --iterations " + std::to_string(iterations + 1));
  EXPECT_EQ(more.status, 0) << more.output;
  EXPECT_EQ(report()["growth"]["iterations"], iterations + 1);

  const auto strict = growIn(1'000'000, "--strict --quiet");
  EXPECT_EQ(strict.status, 2);
  EXPECT_NE(strict.output.find("scene.yaml: " + sentence), std::string::npos) << strict.output;
  EXPECT_EQ(report()["warnings"].size(), 1u) << "all is written first";
}

/// What nobody counted still ends in words. (With less, the system cannot even load the libraries.)
TEST_F(Unlimited, RunningOutOfMemoryElsewhereIsAnErrorThatLeavesNothing) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers map terabytes";
#endif
  for (const int kilobytes : {540'000, 600'000, 700'000, 800'000}) {
    const auto ran = growIn(kilobytes, "--quiet");
    EXPECT_LT(ran.status, 3) << kilobytes << ": " << ran.output;  // no signal
    if (ran.status == 0) continue;
    EXPECT_FALSE(std::filesystem::exists(scratch_.path("out"))) << kilobytes;
    EXPECT_FALSE(ran.output.empty());
  }
}

}  // namespace
}  // namespace espalier
