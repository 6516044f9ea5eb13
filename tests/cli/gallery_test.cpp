// `espalier gallery` as a user runs it. What the page says and shows: tests/scenes/job/gallery_test.cpp.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/process.h"
#include "tests/support/scratch.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using tests::espalier;

TEST(Gallery, MakesTheFiguresThatAreNamed) {
  const tests::Scratch scratch;
  const std::string out = scratch.path("out").string();
  const tests::Ran ran = espalier("gallery figure_2 figure_1 -o " + out);
  EXPECT_EQ(ran.status, 0) << ran.output;
  EXPECT_NE(ran.output.find("1/2 figure 1\n"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("2 figures from 2 scenes in "), std::string::npos) << ran.output;
  for (const char* file : {"index.html", "gallery.png", "figure_1/figure_1.png", "figure_1/report.json",
                           "figure_2/figure_2.png", "figure_2/plant.glb"})
    EXPECT_TRUE(fs::exists(scratch.path("out") / file)) << file;
  EXPECT_FALSE(fs::exists(scratch.path("out/figure_1/growth.state"))) << "nobody goes on with a figure";
}

TEST(Gallery, AnUnknownFigureIsNamedBesideTheNearestAndNothingIsWritten) {
  const tests::Scratch scratch;
  const tests::Ran ran = espalier("gallery figure_1 figur_5 -o " + scratch.path("out").string());
  EXPECT_EQ(ran.status, 2);
  EXPECT_TRUE(ran.output.starts_with("espalier: no figure is called 'figur_5'; expected one of figure_1, "))
      << ran.output;
  EXPECT_TRUE(ran.output.ends_with("; did you mean 'figure_5'?\n")) << ran.output;
  EXPECT_FALSE(fs::exists(scratch.path("out")));
}

TEST(Gallery, AFolderWithoutTheLibrarysScenesIsNamed) {
  const tests::Scratch scratch;
  const tests::Ran ran = espalier("gallery figure_1 figure_2 --library " + scratch.path("empty").string() +
                                  " -o " + scratch.path("out").string());
  EXPECT_EQ(ran.status, 2);
  EXPECT_NE(ran.output.find("empty/figure_1.yaml"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("empty/figure_2.yaml"), std::string::npos) << "both at once: " << ran.output;
  EXPECT_FALSE(fs::exists(scratch.path("out")));
}

TEST(Gallery, AFolderThatCannotBeMadeIsKnownBeforeTheWork) {
  const tests::Scratch scratch;
  const std::string file = scratch.write("file", "").string();
  const tests::Ran ran = espalier("gallery -o " + file + "/out");
  EXPECT_EQ(ran.status, 2);
  EXPECT_EQ(ran.output.find("1/"), std::string::npos) << ran.output;
}

TEST(Gallery, ItsJsonHasEachFigureAndEachRun) {
  const tests::Scratch scratch;
  const tests::Ran ran = espalier("gallery figure_1 --json -o " + scratch.path("out").string());
  ASSERT_EQ(ran.status, 0) << ran.output;
  const auto json = nlohmann::json::parse(ran.output);
  EXPECT_EQ(json["figures"][0]["name"], "figure_1");
  EXPECT_EQ(json["figures"][0]["pictures"], nlohmann::json({"figure_1/figure_1.png"}));
  EXPECT_EQ(json["figures"][0]["numbers"][0]["ours"], "8 x 8 x 8");
  EXPECT_EQ(json["runs"][0]["scene"], "figure 1");
  EXPECT_EQ(json["files"], nlohmann::json({"gallery.png", "index.html"}));
}

TEST(Gallery, ItsHelpListsTheFigures) {
  const std::string help = espalier("gallery --help").output;
  for (int i = 1; i <= 9; ++i)
    EXPECT_NE(help.find("figure_" + std::to_string(i) + "  "), std::string::npos) << i;
}

}  // namespace
}  // namespace espalier
