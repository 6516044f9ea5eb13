// Bad input, and what is only a warning: what is said, where it points, and that nothing is written.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/plot.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using tests::Plot;

TEST_F(Plot, BadInputIsNamedWithItsPlaceAndNothingIsWritten) {
  std::string scene = tests::kPlotScene;
  scene.replace(scene.find("iterations: 14"), 14, "iteratons: 14");
  scene.replace(scene.find("voxel: 5 cm"), 11, "voxel: -5 cm");
  scratch_.write("scene.yaml", scene);
  const auto ran = grow();
  EXPECT_EQ(ran.status, 2);
  EXPECT_NE(ran.output.find("scene.yaml:6:"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("scene.yaml:14:1:"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("did you mean 'iterations'"), std::string::npos) << ran.output;
  EXPECT_FALSE(fs::exists(scratch_.path("out")));
}

TEST_F(Plot, WhatOnlyShowsInTheWorldIsNamedToo) {
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string scene = tests::kPlotScene;
    scene.replace(scene.find(from), from.size(), to);
    scratch_.write("scene.yaml", scene);
    const auto ran = grow();
    EXPECT_EQ(ran.status, 2) << to;
    EXPECT_NE(ran.output.find("scene.yaml"), std::string::npos) << ran.output;
    EXPECT_FALSE(fs::exists(scratch_.path("out")));
    return ran.output;
  };
  EXPECT_NE(with("[-0.4, 0.1, 0.1]", "[-0.4, 0.5, 0.0]").find("(wall)"), std::string::npos);
  EXPECT_NE(with("plot.obj", "missing.obj").find("missing.obj"), std::string::npos);
  const std::string large = with("voxel: 5 cm", "voxel: 0.02 mm");
  EXPECT_NE(large.find("voxel"), std::string::npos) << large;
}

TEST_F(Plot, ARegionThatTheSceneLacksIsAWarningAndWithStrictAnError) {
  scratch_.write("vine.yaml",
                 tests::fileText(scratch_.path("vine.yaml")) + "\nregions: {wal: forbid, wall: {}}\n");
  const auto warned = grow("--no-pictures");
  EXPECT_EQ(warned.status, 0) << warned.output;
  const auto at = warned.output.find(
      ": warning: no mesh of the scene has a region 'wal'; expected one of ground, "
      "wall; did you mean 'wall'?\n");
  ASSERT_NE(at, std::string::npos) << warned.output;
  EXPECT_LT(at, warned.output.find("growing")) << "told before anything grows";
  EXPECT_EQ(warned.output.find("warning", at + 10), std::string::npos) << "told once";
  const auto told = report()["warnings"];
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(told[0].get<std::string>().starts_with("vine.yaml:")) << told[0];
  const auto strict = grow("--no-pictures --strict", "strict");
  EXPECT_EQ(strict.status, 2);
  EXPECT_NE(strict.output.find(":11: no mesh of the scene has a region 'wal'"), std::string::npos)
      << strict.output;
  EXPECT_FALSE(fs::exists(scratch_.path("strict")));
  EXPECT_EQ(grow("--no-pictures --quiet", "quiet").output, "");
  EXPECT_EQ(report("quiet")["warnings"], told);
}

TEST_F(Plot, AStemThatHasNoEffectIsAWarningWithItsPlace) {
  const std::string vine = tests::fileText(scratch_.path("vine.yaml"));
  scratch_.write("vine.yaml",
                 vine + "\notherwise:\n  stem: {radius: 0.2}\nregions: {wall: {stem: {radius: 0.3}}}\n");
  const auto ran = grow("--no-pictures", "told");
  EXPECT_EQ(ran.status, 0);
  EXPECT_NE(ran.output.find(":3: warning: otherwise.stem has no effect"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("warning: regions.wall.stem has no effect"), std::string::npos) << ran.output;
  EXPECT_EQ(report("told")["warnings"].size(), 2u);
  EXPECT_EQ(grow("--no-pictures --strict", "strict").status, 2);
}

TEST_F(Plot, KeysOfAFrontThatHaveNoEffectAreWarnings) {
  scratch_.write("vine.yaml",
                 "espalier: rules\npropagate: colonization\ncolonization:\n  crown: {sphere: 20 cm, trunk: 5 "
                 "cm, count: 9}\n"
                 "branches: {colonization: {onto: true, step: 2, trials: 9}}\n"
                 "regions: {wall: {colonization: {step: 3, avoid: 20}}}\n");
  const auto ran = grow("--no-pictures", "told");
  EXPECT_EQ(ran.status, 0) << ran.output;
  EXPECT_NE(ran.output.find(":5:27: warning: branches.colonization.onto has no effect: a plant has one"),
            std::string::npos)
      << ran.output;
  EXPECT_NE(ran.output.find(":6:33: warning: regions.wall.colonization.step has no effect: limbs have it"),
            std::string::npos)
      << ran.output;
  EXPECT_EQ(report("told")["warnings"].size(), 2u) << report("told")["warnings"];
}

TEST_F(Plot, KeysOfDiffusionThatHaveNoEffectAreWarnings) {
  scratch_.write(
      "vine.yaml",
      "espalier: rules\npropagate: diffusion\ndiffusion: {fill: 0.2, rounds: 3}\n"
      "elements: [{pose: surface, polygons: [[[-1, -1, 0], [1, -1, 0], [0, 1, 0]]]}]\n"
      "regions: {wall: {diffusion: {fill: 0.9, gap: 0.5}}}\notherwise: {diffusion: {rounds: 9}}\n");
  const auto ran = grow("--no-pictures", "told");
  EXPECT_EQ(ran.status, 0) << ran.output;
  for (const char* said : {":5:30: warning: regions.wall.diffusion.fill has no effect: a plant has one",
                           ":6:25: warning: otherwise.diffusion.rounds has no effect: a plant has one"})
    EXPECT_NE(ran.output.find(said), std::string::npos) << ran.output;
  EXPECT_EQ(report("told")["warnings"].size(), 2u) << report("told")["warnings"];
}

TEST_F(Plot, AWarningInTheReportIsTheSameHoweverTheFilesAreNamed) {
  scratch_.write("vine.yaml", tests::fileText(scratch_.path("vine.yaml")) + "\nregions: {wal: forbid}\n");
  const std::string folder = scratch_.path("").string();
  for (const std::string& rules :
       {std::string("vine.yaml"), folder + "vine.yaml",
        "../" + scratch_.path("").parent_path().filename().string() + "/vine.yaml"}) {
    std::string scene = tests::kPlotScene;
    scratch_.write("scene.yaml", scene.replace(scene.find("vine.yaml"), 9, rules));
    for (const std::string& started : {std::string("/"), folder}) {
      const std::string named = started == "/" ? folder + "scene.yaml" : "scene.yaml";
      const auto ran = tests::run("cd " + started + " && " + ESPALIER_PROGRAM + " grow " + named + " -o " +
                                  folder + "out --no-pictures --quiet");
      ASSERT_EQ(ran.status, 0) << ran.output;
      EXPECT_TRUE(report()["warnings"][0].get<std::string>().starts_with("vine.yaml:"))
          << report()["warnings"] << " of " << rules << " from " << started;
    }
  }
}

TEST_F(Plot, StrictMindsNothingWhereAllIsWell) {
  const auto ran = grow("--no-pictures --strict");
  EXPECT_EQ(ran.status, 0) << ran.output;
  EXPECT_EQ(report()["warnings"], json::array());
}

}  // namespace
}  // namespace espalier
