// The folder that a run writes into: one run at a time, known to be writable before the work, and never what
// the run reads.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string>

#include "tests/cli/plot.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

class Folder : public tests::Plot {
 protected:
  static void expectSays(const tests::Ran& ran, const std::string& text) {
    EXPECT_EQ(ran.status, 2) << ran.output;
    EXPECT_NE(ran.output.find(text), std::string::npos) << ran.output;
  }
};

TEST_F(Folder, ASecondRunIsRefusedAtOnceAndAKilledOneBarsNobody) {
  std::string scene = tests::kPlotScene;
  scene.replace(scene.find("voxel: 5 cm"), 11, "voxel: 6 mm");
  scene.replace(scene.find("iterations: 14"), 14, "iterations: 900");
  const std::string fine = scratch_.write("fine.yaml", scene).string();
  const std::string out = scratch_.path("out").string();
  const std::string first =
      "echo $$; exec " + std::string(ESPALIER_PROGRAM) + " grow " + fine + " -o " + out + " 2>&1";
  FILE* const running = ::popen(first.c_str(), "r");
  ASSERT_NE(running, nullptr);
  int number = 0;
  ASSERT_EQ(std::fscanf(running, "%d", &number), 1);
  std::string said;
  for (int c = 0; said.find("growing") == std::string::npos && (c = std::fgetc(running)) != EOF;)
    said += static_cast<char>(c);
  ASSERT_NE(said.find("growing"), std::string::npos) << said;
  const std::string refused = out + ": another run is writing into this folder";
  expectSays(grow(), refused);
  expectSays(tests::espalier("expose " + scratch_.path("scene.yaml").string() + " -o " + out), refused);
  EXPECT_EQ(::kill(number, SIGKILL), 0);  // it was still at it
  ::pclose(running);
  const tests::Ran next = grow();
  EXPECT_EQ(next.status, 0) << next.output;
}

TEST_F(Folder, NothingThatIsReadIsWrittenOver) {
  std::string scene = tests::kPlotScene;
  scene.replace(scene.find("rules: vine.yaml"), 16, "rules: report.json");
  scratch_.write("scene.yaml", scene);
  fs::rename(scratch_.path("vine.yaml"), scratch_.path("report.json"));
  const auto before = files(scratch_.path(""));
  for (const std::string command : {"grow", "expose"}) {
    expectSays(tests::espalier(command + " " + scratch_.path("scene.yaml").string() + " -o " +
                               scratch_.path("").string()),
               "report.json: this run reads the file and would write over it");
    EXPECT_EQ(files(scratch_.path("")), before);
  }
  EXPECT_EQ(grow().status, 0);  // elsewhere it may
}

TEST_F(Folder, WhatCannotBeWrittenIsFoundBeforeTheWork) {
  scratch_.write("plot.obj", "f 1 2 3\n");  // any work would begin with a complaint about it
  const std::string scene = scratch_.path("scene.yaml").string();
  for (const std::string command : {"grow", "expose"}) {
    const tests::Ran ran = tests::espalier(command + " " + scene + " -o /dev/null");
    expectSays(ran, "/dev/null: cannot make the folder");
    EXPECT_EQ(ran.output.find("plot.obj"), std::string::npos) << ran.output;
  }
  scratch_.write("file", "in the way");
  expectSays(grow("--no-pictures", "file"), scratch_.path("file").string() + ": cannot make the folder");
  fs::create_directories(scratch_.path("out/vines.png"));
  const tests::Ran ran = grow();
  expectSays(ran, "vines.png: this is no file");
  EXPECT_EQ(ran.output.find("plot.obj"), std::string::npos) << ran.output;
  fs::remove_all(scratch_.path("out"));
  EXPECT_NE(grow().output.find("plot.obj"), std::string::npos);
}

}  // namespace
}  // namespace espalier
