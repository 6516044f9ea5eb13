// Ctrl-C, whatever the program is at: it ends soon, says so, and leaves no half files.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <thread>

#include "tests/cli/plot.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Ten times what is promised: test machines are busy.
constexpr double kSoon_s = 2.0;

struct Ended {
  bool early = false;  ///< before the signal was sent
  int status = -1;     ///< exit status; 128 + signal if it was killed
  double took_s = 0.0;
  std::string said;
};

/// Starts the program in a shell's words, waits until it has said `stage` on stderr and so long, and signals.
Ended signalled(const std::string& arguments, const std::string& stage, int after_ms, int signal = SIGINT) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return {};
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(ends[1], STDERR_FILENO);
    ::close(ends[0]);
    const std::string command = "exec " + std::string(ESPALIER_PROGRAM) + " " + arguments;
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  ::close(ends[1]);
  Ended ended;
  std::array<char, 4096> buffer{};
  const auto read = [&] {
    const ssize_t n = ::read(ends[0], buffer.data(), buffer.size());
    if (n > 0) ended.said.append(buffer.data(), static_cast<std::size_t>(n));
    return n > 0;
  };
  while (ended.said.find(stage) == std::string::npos && read()) {
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
  int status = 0;
  ended.early = ::waitpid(child, &status, WNOHANG) == child;
  const auto asked = Clock::now();
  if (!ended.early) {
    ::kill(child, signal);
    ::waitpid(child, &status, 0);
  }
  ended.took_s = std::chrono::duration<double>(Clock::now() - asked).count();
  while (read()) {
  }
  ::close(ends[0]);
  ended.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return ended;
}

class Stop : public tests::Plot {
 protected:
  void SetUp() override {
    tests::Plot::SetUp();
    std::string scene = tests::kPlotScene;
    const auto replace = [&](const std::string& old, const std::string& now) {
      scene.replace(scene.find(old), old.size(), now);
    };
    replace("voxel: 5 cm", "voxel: 6 mm");
    replace("iterations: 14", "iterations: 100");
    replace("width: 160, height: 120", "width: 2400, height: 1800");
    scratch_.write("fine.yaml", scene);
    out_ = scratch_.path("out").string();
    fine_ = scratch_.path("fine.yaml").string() + " -o " + out_;
  }

  void stops(const std::string& arguments, const std::string& stage, int after_ms, int signal = SIGINT) {
    const Ended ended = signalled(arguments, stage, after_ms, signal);
    const std::string moment =
        fmt::format("{}, {} ms after '{}'", arguments.substr(0, arguments.find(' ')), after_ms, stage);
    fmt::print("{}: status {} after {:.3f} s{}\n", moment, ended.status, ended.took_s,
               ended.early ? ", done before" : "");
    if (fs::exists(out_)) {
      for (const auto& [name, bytes] : files(out_))
        EXPECT_EQ(name.find(".espalier-part-"), name.npos) << moment;
    }
    if (ended.early) return;
    if (stage == "writing" && ended.status == 0) return;  // all files were in their places: it was done
    EXPECT_EQ(ended.status, 130) << moment << ": " << ended.said;
    // On a busy machine a signal at no stage may come before the program listens: the system ends it.
    const bool too_soon = stage.empty() && ended.said.empty();
    EXPECT_TRUE(too_soon || ended.said.ends_with("espalier: stopped\n")) << moment << ": " << ended.said;
    EXPECT_LT(ended.took_s, kSoon_s) << moment;
    ++stopped_;
  }

  std::string out_, fine_;
  int stopped_ = 0;
};

TEST_F(Stop, IsHeardInEveryStageOfGrowth) {
  for (const int after_ms : {0, 150}) {
    stops("grow " + fine_, "", 200 + after_ms);  // it tiles
    stops("grow " + fine_, "growing", after_ms);
    stops("grow " + fine_, "lighting", after_ms);
    stops("grow " + fine_, "drawing", after_ms, SIGTERM);
  }
  EXPECT_GE(stopped_, 7);
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(Stop, WhileFilesAreWrittenLeavesThemWholeOrAsTheyWere) {
  ASSERT_EQ(grow().status, 0);  // of larger voxels
  const auto before = files(out_);
  for (const int after_ms : {0, 100, 300, 600})
    stops("grow " + fine_ + " --no-pictures", "writing", after_ms);
  EXPECT_GE(stopped_, 1);
  for (const auto& [name, bytes] : files(out_)) EXPECT_TRUE(before.contains(name)) << name;
  const auto again = grow();  // nothing is in the way of the next run
  EXPECT_EQ(again.status, 0) << again.output;
  for (const auto& [name, bytes] : files(out_)) {
    if (name == "report.json") continue;
    EXPECT_TRUE(bytes == before.at(name)) << name;
  }
}

TEST_F(Stop, IsHeardInEveryStageOfExposureAndByCertify) {
  for (const int after_ms : {0, 200}) {
    stops("expose " + fine_, "lighting", after_ms);
    stops("expose " + fine_, "certifying", after_ms);
    stops("expose " + fine_, "drawing", after_ms);
    stops("certify " + scratch_.path("fine.yaml").string(), "", 400 + 2 * after_ms);
    stops("certify", "", 400 + after_ms);
  }
  EXPECT_GE(stopped_, 8);
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(Stop, IsHeardByAGalleryWhichHasNoPageThen) {
  for (const int after_ms : {0, 400, 1500})
    stops("gallery figure_5 figure_9 -o " + out_, "courtyard", after_ms);
  stops("gallery figure_9 -o " + out_, "gable", 900, SIGTERM);
  EXPECT_GE(stopped_, 3);
  EXPECT_FALSE(fs::exists(fs::path(out_) / "index.html"));
}

TEST_F(Stop, IsHeardWhileKeptPlantsAreDrawn) {
  ASSERT_EQ(grow("--no-pictures").status, 0);
  std::string scene = tests::kPlotScene;
  scene.replace(scene.find("width: 160, height: 120"), 23, "width: 6000, height: 4500");
  const std::string drawn = scratch_.write("large.yaml", scene).string() + " --from " + out_;
  stops("render " + drawn + " --images vines", "drawing", 0);
  stops("render " + drawn + " --images vines", "drawing", 500);
  stops("render " + drawn + " --images sky_exposure", "writing", 100);
  EXPECT_GE(stopped_, 2);
}

/// Whether a process runs this program, by the path that it was started with.
bool runs(const fs::path& program) {
  for (const auto& entry : fs::directory_iterator("/proc")) {
    if (tests::fileText(entry.path() / "cmdline").find(program.string()) != std::string::npos) return true;
  }
  return false;
}

/// Nor does what turns it into a video live on, not even where nobody could end it.
TEST_F(Stop, IsHeardWhileAFilmIsDrawn) {
  const auto fake = scratch_.write("bin/ffmpeg", "#!/bin/sh\nwhile :; do sleep 0.02; done\n");
  fs::permissions(fake, fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (fake.parent_path().string() + ":" + path).c_str(), 1);
  const std::string film =
      scratch_.write("film.yaml", std::string(tests::kPlotScene) + "film: {width: 1280, height: 960}\n")
          .string() +
      " -o " + out_;
  stops("grow " + film, "filming", 0);
  stops("grow " + film, "filming", 400, SIGTERM);
  EXPECT_EQ(stopped_, 2);
  EXPECT_FALSE(fs::exists(out_));
  const Ended killed = signalled("grow " + film, "filming", 400, SIGKILL);
  EXPECT_EQ(killed.status, 128 + SIGKILL);
  ::setenv("PATH", path.c_str(), 1);
  for (int i = 0; i < 100 && runs(fake); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(runs(fake));
}

TEST_F(Stop, EndsTheImportOfALargeMesh) {
  std::string mesh = "g ground\n";
  constexpr int kSide = 700;
  for (int z = 0; z <= kSide; ++z) {
    for (int x = 0; x <= kSide; ++x)
      mesh += fmt::format("v {} {} {}\n", 0.003 * x - 1.0, 0.0, 0.003 * z - 1.0);
  }
  for (int z = 0; z < kSide; ++z) {
    for (int x = 1; x <= kSide; ++x) {
      const int at = z * (kSide + 1) + x;
      mesh += fmt::format("f {} {} {} {}\n", at, at + kSide + 1, at + kSide + 2, at + 1);
    }
  }
  scratch_.write("plot.obj", mesh);
  stops("grow " + fine_, "", 300);
  stops("grow " + fine_, "", 900);
  stops("certify " + scratch_.path("fine.yaml").string(), "", 500);
  EXPECT_EQ(stopped_, 3);
}

}  // namespace
}  // namespace espalier
