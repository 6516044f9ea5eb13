// Growth that is kept, gone on with, and drawn again.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "tests/cli/plot.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Kept : public tests::Plot {
 protected:
  /// Every file but the report's account of the run itself.
  std::map<std::string, std::string> result(const std::string& folder) {
    auto all = files(scratch_.path(folder));
    json r = report(folder);
    r.erase("run");
    all["report.json"] = r.dump();
    return all;
  }
  void expectSame(const std::string& a, const std::string& b) {
    const auto all_a = result(a), all_b = result(b);
    ASSERT_EQ(all_a.size(), all_b.size());
    for (const auto& [name, bytes] : all_a)
      EXPECT_TRUE(all_b.at(name) == bytes) << a << " and " << b << ": " << name;
  }
  tests::Ran render(const std::string& scene, const std::string& from, const std::string& more = "") {
    return tests::espalier("render " + scratch_.path(scene).string() + " --from " +
                           scratch_.path(from).string() + " " + more);
  }
  /// The scene with a text in place of another.
  void writeScene(const std::string& name, const std::string& old_text, const std::string& new_text) {
    std::string text = tests::kPlotScene;
    const auto at = text.find(old_text);
    ASSERT_NE(at, std::string::npos);
    scratch_.write(name, text.replace(at, old_text.size(), new_text));
  }
};

TEST_F(Kept, GoesOnToTheBytesOfARunThatWasNeverInterrupted) {
  ASSERT_EQ(grow("", "whole").status, 0);
  const auto proposals = [&](const std::string& folder) {
    return report(folder)["run"]["proposals"].get<int>();
  };
  for (const int before : {0, 6, 14}) {
    const std::string folder = "part" + std::to_string(before);
    ASSERT_EQ(grow("--no-pictures --threads 2 --iterations " + std::to_string(before), folder).status, 0);
    const int first = proposals(folder);
    const auto ran = grow("--resume --threads 5", folder);
    ASSERT_EQ(ran.status, 0) << ran.output;
    expectSame("whole", folder);
    EXPECT_EQ(report(folder)["run"]["went_on_from"], before);
    EXPECT_EQ(first + proposals(folder), proposals("whole"));  // none is made twice
  }
  EXPECT_TRUE(report("whole")["run"]["went_on_from"].is_null());
  // Whatever of a result would be another one is told.
  ASSERT_EQ(grow("--iterations 13", "shorter").status, 0);
  const auto whole = result("whole"), shorter = result("shorter");
  for (const char* name : {"report.json", "growth.state", "plant.glb", "world.vdb", "vines.png"})
    EXPECT_FALSE(whole.at(name) == shorter.at(name)) << name;
  // Further than the scene says, and not back again.
  ASSERT_EQ(grow("--iterations 18", "far").status, 0);
  ASSERT_EQ(grow("--resume --iterations 18", "whole").status, 0);
  expectSame("far", "whole");
  const auto back = grow("--resume", "far");
  EXPECT_EQ(back.status, 2);
  EXPECT_NE(back.output.find("18 iterations"), std::string::npos) << back.output;
}

TEST_F(Kept, IsWrittenAsOftenAsAskedAndLeftUnlessToldNotTo) {
  ASSERT_EQ(grow("--no-pictures", "left").status, 0);
  EXPECT_TRUE(fs::exists(scratch_.path("left") / "growth.state"));
  ASSERT_EQ(grow("--no-pictures --no-state --save-every 5", "left").status, 0);
  EXPECT_FALSE(fs::exists(scratch_.path("left") / "growth.state"));
  // Resuming where there is nothing to resume begins.
  const auto ran = grow("--no-pictures --resume --save-every 3", "fresh");
  ASSERT_EQ(ran.status, 0) << ran.output;
  EXPECT_TRUE(report("fresh")["run"]["went_on_from"].is_null());
  EXPECT_EQ(grow("--save-every 0").status, 2);
  EXPECT_EQ(grow("--iterations -1").status, 2);
}

/// Starts the program without a shell between, so that a signal reaches it.
pid_t start(const std::vector<std::string>& arguments) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, 1);
  ::dup2(nowhere, 2);
  std::vector<char*> argv;
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

TEST_F(Kept, SurvivesBeingKilledAtAnyMoment) {
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  ASSERT_EQ(grow("--no-pictures --save-every 2", "whole").status, 0);
  auto longest_us = std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - began).count();
  std::mt19937 random(7);
  int killed = 0, went_on = 0;
  for (int i = 0; i < 20; ++i) {
    const std::string folder = "killed" + std::to_string(i);
    const pid_t child = start({ESPALIER_PROGRAM, "grow", scratch_.path("scene.yaml").string(), "-o",
                               scratch_.path(folder).string(), "--no-pictures", "--save-every", "2"});
    ASSERT_GT(child, 0);
    if (i % 4 == 3) {  // at once after a state was kept, whenever that may be
      const auto kept = scratch_.path(folder) / "growth.state";
      for (int waits = 0; waits < 50'000 && !std::filesystem::exists(kept); ++waits)
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    } else {
      std::this_thread::sleep_for(
          std::chrono::microseconds(random() % static_cast<std::uint64_t>(longest_us)));
    }
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) {
      ++killed;
    } else {
      longest_us = longest_us * 3 / 4;  // it was faster than the first one
    }
    const auto ran = grow("--no-pictures --resume --save-every 2", folder);
    ASSERT_EQ(ran.status, 0) << ran.output;
    if (!report(folder)["run"]["went_on_from"].is_null()) ++went_on;
    expectSame("whole", folder);
  }
  EXPECT_GT(killed, 5);
  EXPECT_GT(went_on, 0);
}

TEST_F(Kept, ADamagedOrForeignStateIsAnErrorThatSaysWhatIsWrong) {
  ASSERT_EQ(grow("--no-pictures --iterations 3", "out").status, 0);
  const auto before = tests::fileText(scratch_.path("out") / "report.json");
  const auto expectError = [&](const tests::Ran& ran, const std::string& what) {
    EXPECT_EQ(ran.status, 2);
    EXPECT_NE(ran.output.find(what), std::string::npos) << ran.output;
    EXPECT_NE(ran.output.find("growth.state"), std::string::npos) << ran.output;
    EXPECT_EQ(tests::fileText(scratch_.path("out") / "report.json"), before);
  };
  expectError(grow("--resume --seed 9"), "seed is '9', was '5'");
  writeScene("scene.yaml", "voxel: 5 cm", "voxel: 4 cm");
  expectError(grow("--resume"), "world.voxel is ");
  scratch_.write("scene.yaml", tests::kPlotScene);
  scratch_.write("plot.obj", std::string(tests::kPlotMesh) + "g more\nf 5 6 7\n");
  expectError(grow("--resume"), "meshes[0].contents");
  scratch_.write("plot.obj", tests::kPlotMesh);
  const std::string vine = tests::fileText(scratch_.path("vine.yaml"));
  scratch_.write("vine.yaml", std::string(vine).replace(vine.find("up: 0.08"), 8, "up: 0.09"));
  expectError(grow("--resume"), "plants[0].rules.bias.up is '0.09', was '0.08'");
  scratch_.write("vine.yaml", vine);
  // What may change: iterations, images, cameras, names, where a mesh lies.
  scratch_.write("elsewhere.obj", tests::kPlotMesh);
  writeScene("scene.yaml", "- file: plot.obj", "- {file: elsewhere.obj, name: plot}");
  EXPECT_EQ(grow("--no-pictures --resume --iterations 4").status, 0);
  writeScene("scene.yaml", "iterations: 14", "iterations: 5\nsun: {shadow_hour: 9}");
  EXPECT_EQ(grow("--no-pictures --resume").status, 0);
  scratch_.write("scene.yaml", tests::kPlotScene);

  std::string bytes = tests::fileText(scratch_.path("out") / "growth.state");
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(scratch_.path("out") / "growth.state", std::ios::binary) << bytes;
  const auto damaged = grow("--resume");
  EXPECT_EQ(damaged.status, 2);
  EXPECT_NE(damaged.output.find("damaged"), std::string::npos) << damaged.output;
}

TEST_F(Kept, AFolderInItsPlaceIsAnError) {
  fs::create_directories(scratch_.path("out/growth.state/inner"));
  const auto expectError = [&](const tests::Ran& ran, const std::string& what) {
    EXPECT_EQ(ran.status, 2);
    EXPECT_EQ(ran.output.find(scratch_.path("out/growth.state").string() + ": " + what), 0u) << ran.output;
  };
  expectError(grow("--quiet --no-pictures --resume"), "this is no file");
  expectError(render("scene.yaml", "out", "--quiet"), "is no file");
  expectError(grow("--quiet --no-pictures --save-every 2"), "this is no file");
  expectError(grow("--quiet --no-pictures --no-state"), "cannot be removed");
}

TEST_F(Kept, TrialsThatTheSceneNoLongerShowsAreNotKept) {
  writeScene("shown.yaml", "  - vines\n", "  - attempts\n");
  ASSERT_EQ(grow("--no-pictures", "whole").status, 0);
  ASSERT_EQ(tests::espalier("grow " + scratch_.path("shown.yaml").string() + " -o " +
                            scratch_.path("part").string() + " --no-pictures --iterations 6")
                .status,
            0);
  ASSERT_EQ(grow("--no-pictures --resume", "part").status, 0);
  expectSame("whole", "part");
}

TEST_F(Kept, IsDrawnAgainWithOtherCamerasAndSuns) {
  ASSERT_EQ(grow("", "grown").status, 0);
  const auto grown = files(scratch_.path("grown"));
  const auto again = render("scene.yaml", "grown", "-o " + scratch_.path("again").string());
  ASSERT_EQ(again.status, 0) << again.output;
  for (const auto& [name, bytes] : files(scratch_.path("again")))
    EXPECT_TRUE(grown.at(name) == bytes) << name;
  EXPECT_FALSE(fs::exists(scratch_.path("again") / "report.json"));
  EXPECT_FALSE(fs::exists(scratch_.path("again") / "plant.glb"));

  writeScene("other.yaml", "eye: [2.2, 1.6, 3.2]", "eye: [-2.2, 1.6, 3.2]");
  ASSERT_EQ(render("other.yaml", "grown", "--images vines").status, 0);  // into the same folder
  for (const auto& [name, bytes] : files(scratch_.path("grown")))
    EXPECT_EQ(grown.at(name) == bytes, name != "vines.png") << name;

  writeScene("sun.yaml", "iterations: 14", "iterations: 3\nsun: {toward: 90}");
  ASSERT_EQ(
      render("sun.yaml", "grown", "--images shadow_matte --quiet -o " + scratch_.path("sun").string()).status,
      0);
  const auto sun = files(scratch_.path("sun"));
  EXPECT_EQ(sun.size(), 2u);  // .png and .exr
  EXPECT_FALSE(sun.at("shadow_matte.png") == grown.at("shadow_matte.png"));
}

TEST_F(Kept, StrictIsStrictAboutDrawingToo) {
  scratch_.write("vine.yaml", tests::fileText(scratch_.path("vine.yaml")) + "\nregions: {wal: forbid}\n");
  ASSERT_EQ(grow("--no-pictures", "grown").status, 0);
  const auto strict = render("scene.yaml", "grown", "--images vines --strict");
  EXPECT_EQ(strict.status, 2);
  EXPECT_NE(strict.output.find("region 'wal'"), std::string::npos) << strict.output;
  EXPECT_FALSE(fs::exists(scratch_.path("grown") / "vines.png"));
  EXPECT_EQ(render("scene.yaml", "grown", "--images vines").status, 0);
}

TEST_F(Kept, IsDrawnWithTheSeedThatItGrewWith) {
  writeScene("strewn.yaml", "    seeds:\n      - [-0.4, 0.1, 0.1]\n      - [0.3, 0.1, 0.1]\n",
             "    scatter: {region: ground, count: 3}\nsky: {sampling: random, rays: 20}\n");
  const auto run = [&](const std::string& command) {
    const auto ran = tests::espalier(command);
    EXPECT_EQ(ran.status, 0) << ran.output;
  };
  const std::string scene = scratch_.path("strewn.yaml").string(), grown = scratch_.path("grown").string(),
                    again = scratch_.path("again").string();
  run("grow " + scene + " --seed 77 -o " + grown);
  run("render " + scene + " --from " + grown + " -o " + again);
  const auto first = files(grown);
  for (const auto& [name, bytes] : files(again)) EXPECT_TRUE(first.at(name) == bytes) << name;
}

TEST_F(Kept, IsNotDrawnOnAnotherWorldOrWithOtherPlants) {
  ASSERT_EQ(grow("--no-pictures", "grown").status, 0);
  const auto expectError = [&](const tests::Ran& ran, const std::string& what) {
    EXPECT_EQ(ran.status, 2);
    EXPECT_NE(ran.output.find(what), std::string::npos) << ran.output;
    EXPECT_FALSE(fs::exists(scratch_.path("grown") / "vines.png"));
  };
  writeScene("voxel.yaml", "voxel: 5 cm", "voxel: 4 cm");
  expectError(render("voxel.yaml", "grown"), "world.voxel is ");
  writeScene("seeds.yaml", "- [0.3, 0.1, 0.1]", "- [0.35, 0.1, 0.1]");
  expectError(render("seeds.yaml", "grown"), "plants[0].seeds[1].at is ");
  writeScene("kinds.yaml", "  - vines\n", "  - attempts\n");
  expectError(render("kinds.yaml", "grown", "--images attempts"), "no record of trials");
  expectError(render("scene.yaml", "grown", "--images vine"), "did you mean 'vines'?");
  expectError(render("scene.yaml", "nowhere"), "there is no growth.state");
  const std::string scene = tests::kPlotScene;
  scratch_.write("none.yaml", scene.substr(0, scene.find("images:")));
  expectError(render("none.yaml", "grown"), "none.yaml: it has no images to draw");
}

}  // namespace
}  // namespace espalier
