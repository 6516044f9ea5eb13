// A run that is cut off: by a full disk, by a signal. It leaves no half files.
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

#include "tests/cli/plot.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using tests::Plot;

TEST_F(Plot, AFullDiskIsAnErrorAndLeavesNoHalfFiles) {
  ASSERT_EQ(grow("--no-pictures").status, 0);
  const auto before = files(scratch_.path("out"));
  const auto ran = tests::run("ulimit -f 20; " + std::string(ESPALIER_PROGRAM) + " grow " +
                              scratch_.path("scene.yaml").string() + " --seed 9 --no-pictures -o " +
                              scratch_.path("out").string());
  EXPECT_EQ(ran.status, 2) << ran.output;
  EXPECT_NE(ran.output.find("cannot write"), std::string::npos) << ran.output;
  const auto kept = tests::run(
      "ulimit -f 20; " + std::string(ESPALIER_PROGRAM) + " grow " + scratch_.path("scene.yaml").string() +
      " --seed 9 --no-pictures --quiet --save-every 1 -o " + scratch_.path("out").string());
  EXPECT_EQ(kept.status, 2);
  EXPECT_EQ(kept.output.find((scratch_.path("out") / "growth.state").string()), 0u) << kept.output;
  EXPECT_EQ(files(scratch_.path("out")).at("world.vdb"), before.at("world.vdb"));
  EXPECT_EQ(files(scratch_.path("out")).size(), before.size());
}

/// Starts the program, and sends it a signal after a while.
int growAndSignal(const std::string& scene, const std::string& folder, int signal, int after_ms) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl(ESPALIER_PROGRAM, ESPALIER_PROGRAM, "grow", scene.c_str(), "-o", folder.c_str(), "--quiet",
            nullptr);
    ::_exit(127);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
  ::kill(child, signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST_F(Plot, KilledAtAnyMomentNoFileIsHalf) {
  ASSERT_EQ(grow("", "whole").status, 0);
  auto whole = files(scratch_.path("whole"));
  const auto out = scratch_.path("out");
  for (int after_ms = 40; after_ms < 1000; after_ms += 120) {
    growAndSignal(scratch_.path("scene.yaml"), out, SIGKILL, after_ms);
    if (!fs::exists(out)) continue;
    for (const auto& [name, bytes] : files(out)) {
      if (name.starts_with(".espalier-part-") || name == "report.json") continue;
      EXPECT_TRUE(bytes == whole[name]) << name << " after " << after_ms << " ms";
    }
  }
  ASSERT_EQ(grow().status, 0);
  for (const auto& [name, bytes] : files(out)) EXPECT_FALSE(name.starts_with(".espalier-part-")) << name;
}

TEST_F(Plot, CtrlCEndsCleanly) {
  std::string scene = tests::kPlotScene;
  scene.replace(scene.find("iterations: 14"), 14, "iterations: 100000");
  scene.replace(scene.find("voxel: 5 cm"), 11, "voxel: 1 cm");
  scratch_.write("scene.yaml", scene);
  EXPECT_EQ(growAndSignal(scratch_.path("scene.yaml"), scratch_.path("out"), SIGINT, 600), 130);
  EXPECT_FALSE(fs::exists(scratch_.path("out")));
}

}  // namespace
}  // namespace espalier
