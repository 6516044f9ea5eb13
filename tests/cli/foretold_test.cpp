// What the program says of a job before most of it is done.
#include <gtest/gtest.h>

#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/plot.h"

namespace espalier {
namespace {

using tests::Ran;

const std::regex kForetold(
    "[0-9]+ x [0-9]+ x [0-9]+ voxels of [0-9.]+ m; (about [0-9]+ s|less than a second) and "
    "[0-9.]+ (MB|GB) of memory");

std::string firstLine(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

class Foretold : public tests::Plot {
 protected:
  std::string path(const std::string& name) const { return scratch_.path(name).string(); }
  /// What comes to standard error.
  Ran said(const std::string& arguments) const {
    return tests::run("( " ESPALIER_PROGRAM " " + arguments + " 2>&1 >/dev/null )");
  }
};

TEST_F(Foretold, TheFirstLineOfAJobIs) {
  for (const std::string& command : {"grow " + path("scene.yaml") + " -o " + path("out"),
                                     "grow " + path("scene.yaml") + " --no-pictures -o " + path("out2"),
                                     "expose " + path("scene.yaml") + " -o " + path("light"),
                                     "render " + path("scene.yaml") + " --from " + path("out")}) {
    const Ran ran = said(command);
    ASSERT_EQ(ran.status, 0) << ran.output;
    EXPECT_TRUE(std::regex_match(firstLine(ran.output), kForetold)) << command << "\n" << ran.output;
    EXPECT_TRUE(ran.output.starts_with("44 x 32 x 44 voxels of 0.05 m")) << ran.output;
  }
  const auto run = report()["run"];
  EXPECT_GT(run["foretold"]["total_s"], 0.0);
  EXPECT_EQ(run["foretold"]["stages_s"].size(), 5u) << run;  // all but tiling, which was done
  // Little grows here, and it is known when it is told; the rest is what libraries hold.
  const double told = run["foretold"]["peak_memory_bytes"], held = run["peak_memory_bytes"];
  EXPECT_LT(told, 1.5 * held);
  EXPECT_GT(told, held / 1.5);
}

TEST_F(Foretold, AfterItStandOnlyStagesThatStillCome) {
  using Stages = std::vector<std::string>;
  const auto after = [&](const std::string& arguments) {
    const Ran ran = said(arguments);
    EXPECT_EQ(ran.status, 0) << ran.output;
    std::istringstream lines(ran.output);
    Stages stages;
    for (std::string line; std::getline(lines, line);) {
      if (line.find(' ') == line.npos) stages.push_back(line);
    }
    return stages;
  };
  EXPECT_EQ(after("grow " + path("scene.yaml") + " -o " + path("out")),
            (Stages{"growing", "lighting", "modelling", "drawing", "writing"}));
  EXPECT_EQ(after("expose " + path("scene.yaml") + " -o " + path("light")),
            (Stages{"lighting", "certifying", "counting", "drawing", "writing"}));
  EXPECT_EQ(after("render " + path("scene.yaml") + " --from " + path("out")),
            (Stages{"lighting", "modelling", "drawing", "writing"}));
}

TEST_F(Foretold, NobodyIsToldWhoDoesNotListen) {
  for (const char* quiet : {"--quiet", "--json"}) {
    const Ran ran = said("grow " + path("scene.yaml") + " -o " + path("out") + " " + quiet);
    EXPECT_EQ(ran.status, 0);
    EXPECT_EQ(ran.output, "");
    EXPECT_FALSE(report()["run"].contains("foretold"));
  }
}

TEST_F(Foretold, IsTheSameWorkWhetherToldOrNot) {
  ASSERT_EQ(grow("", "told").status, 0);
  ASSERT_EQ(grow("--quiet", "untold").status, 0);
  auto told = files(scratch_.path("told")), untold = files(scratch_.path("untold"));
  told.erase("report.json");
  untold.erase("report.json");
  EXPECT_EQ(told, untold);
}

TEST_F(Foretold, CheckTellsOfScenesAndIsSilentAboutRulesThatAreWell) {
  EXPECT_EQ(tests::espalier("check " + path("vine.yaml")).output, "");
  std::string scene = tests::kPlotScene;
  scene.replace(scene.find("plants:"), scene.find("iterations:") - scene.find("plants:"), "");
  scratch_.write("bare.yaml", scene.substr(0, scene.find("images:")));
  const Ran ran =
      tests::espalier("check " + path("scene.yaml") + " " + path("vine.yaml") + " " + path("bare.yaml"));
  EXPECT_EQ(ran.status, 0) << ran.output;
  std::istringstream lines(ran.output);
  for (const std::string name : {"scene.yaml", "bare.yaml"}) {
    std::string line;
    ASSERT_TRUE(std::getline(lines, line)) << ran.output;
    ASSERT_TRUE(line.starts_with(path(name) + ": ")) << line;
    EXPECT_TRUE(std::regex_match(line.substr(path(name).size() + 2), kForetold)) << line;
  }
}

TEST_F(Foretold, EveryFileOfTheLibraryIsWell) {
  std::string all;
  for (const auto& file : tests::libraryFiles()) all += " " + file.string();
  const Ran ran = tests::espalier("check" + all);
  EXPECT_EQ(ran.status, 0);
  EXPECT_EQ(ran.output.find("error"), std::string::npos) << ran.output;
}

TEST_F(Foretold, CheckNamesWhatOnlyTheSiteShowsAndGoesOn) {
  std::string scene = tests::kPlotScene;
  scene.replace(scene.find("[-0.4, 0.1, 0.1]"), 16, "[-0.4, 0.3, 0.0]");
  scratch_.write("in_wall.yaml", scene);
  const Ran ran = tests::espalier("check " + path("in_wall.yaml") + " " + path("scene.yaml"));
  EXPECT_EQ(ran.status, 2);
  EXPECT_NE(ran.output.find("in_wall.yaml"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find(path("scene.yaml") + ": 44 x 32 x 44"), std::string::npos) << ran.output;
}

}  // namespace
}  // namespace espalier
