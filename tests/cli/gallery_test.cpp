// `espalier gallery` as a user runs it. What the page says and shows: tests/scenes/gallery/gallery_test.cpp.
#include <gtest/gtest.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "cli/commands.h"
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
  EXPECT_TRUE(ran.output.starts_with("espalier: no figure is called 'figur_5'; expected one of figure_5, "))
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
  EXPECT_EQ(ran.output, file + "/out: cannot make the folder: Not a directory\n");
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

/// As EveryFlag has it for the other commands: a new flag fails here until somebody says what it changes.
TEST(Gallery, EachOfItsFlagsChangesWhatComesOut) {
  CLI::App app;
  int status = 0;
  cli::addGallery(app, status);
  std::set<std::string> flags;
  for (const CLI::Option* const option : app.get_subcommand("gallery")->get_options())
    flags.insert(option->get_single_name());
  EXPECT_EQ(flags, (std::set<std::string>{"help", "name", "output", "threads", "quiet", "json", "library"}));

  const tests::Scratch scratch;
  const auto made = [&](const std::string& more, const std::string& folder) {
    return espalier("gallery figure_1 " + more + " -o " + scratch.path(folder).string()).output;
  };
  EXPECT_EQ(made("--quiet --threads 1", "one"), "");
  EXPECT_NE(made("", "plain"), "");
  EXPECT_TRUE(fs::exists(scratch.path("plain/index.html"))) << "where --output says";
  made("--quiet --threads 3", "three");
  EXPECT_NE(tests::fileText(scratch.path("one/index.html")).find(" on 1 thread."), std::string::npos);
  EXPECT_NE(tests::fileText(scratch.path("three/index.html")).find(" on 3 threads."), std::string::npos);
  EXPECT_EQ(tests::fileText(scratch.path("one/gallery.png")),
            tests::fileText(scratch.path("three/gallery.png")));
  // Another library's scenes: the names of its files are what counts.
  fs::copy(tests::sourceFolder() / "scenes/meshes", scratch.path("meshes"));
  std::string scene = tests::fileText(tests::sourceFolder() / "scenes/library/figure_1.yaml");
  scene.replace(scene.find("name: figure 1"), 14, "name: changed");
  scratch.write("library/figure_1.yaml", scene);
  EXPECT_NE(made("--library " + scratch.path("library").string(), "other").find("1/1 changed"),
            std::string::npos);
}

TEST(Gallery, ItsHelpListsTheFigures) {
  const std::string help = espalier("gallery --help").output;
  for (int i = 1; i <= 9; ++i)
    EXPECT_NE(help.find("figure_" + std::to_string(i) + "  "), std::string::npos) << i;
}

}  // namespace
}  // namespace espalier
