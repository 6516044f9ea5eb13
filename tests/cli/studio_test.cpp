// The studio as a process: it says where it is, and Ctrl-C closes it whatever it is at.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include "cli/commands.h"
#include "tests/cli/plot.h"

namespace espalier::tests {
namespace {

using Clock = std::chrono::steady_clock;

/// Ten times what is promised: test machines are busy.
constexpr double kSoon_s = 3.0;

struct Studio {
  pid_t child = -1;
  int out = -1;
  std::string said;

  /// `programs`: a folder that is looked into first for programs; with it the page is opened as on a desktop.
  explicit Studio(const std::string& scene, const std::string& programs = "") {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return;
    child = ::fork();
    if (child == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::close(ends[0]);
      if (!programs.empty()) {
        ::setenv("PATH", (programs + ":" + std::getenv("PATH")).c_str(), 1);
        ::setenv("DISPLAY", ":0", 1);
        ::execl(ESPALIER_PROGRAM, "espalier", "studio", scene.c_str(), "--threads", "1", nullptr);
      }
      ::execl(ESPALIER_PROGRAM, "espalier", "studio", scene.c_str(), "--no-open", nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);
    out = ends[0];
    for (char c = 0; ::read(out, &c, 1) == 1 && c != '\n';) said += c;
  }
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;
  ~Studio() {
    if (out >= 0) ::close(out);
    if (child > 0) ::kill(child, SIGKILL);
  }

  /// The exit status, or 128 + signal.
  int endedBy(int signal, double& seconds) {
    const auto began = Clock::now();
    ::kill(child, signal);
    int status = 0;
    ::waitpid(child, &status, 0);
    child = -1;
    seconds = std::chrono::duration<double>(Clock::now() - began).count();
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
};

class StudioCommand : public Plot {};

TEST_F(StudioCommand, HasNoOtherOptionsThanAreTriedHere) {
  CLI::App app;
  int status = 0;
  cli::addStudio(app, status);
  std::set<std::string> names;
  for (const CLI::Option* const option : app.get_subcommand("studio")->get_options())
    names.insert(option->get_single_name());
  EXPECT_EQ(names, (std::set<std::string>{"help", "scene", "port", "threads", "no-open"}));
}

TEST_F(StudioCommand, SaysWhereItIsAndEndsByCtrlC) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Studio studio(scratch_.path("scene.yaml").string());
    EXPECT_NE(studio.said.find("http://127.0.0.1:"), std::string::npos) << studio.said;
    EXPECT_NE(studio.said.find("/?token="), std::string::npos) << studio.said;
    double seconds = 0.0;
    EXPECT_EQ(studio.endedBy(signal, seconds), 0);
    EXPECT_LT(seconds, kSoon_s);
  }
}

TEST_F(StudioCommand, OpensItsPageWhereThereIsADesktop) {
  const auto opener = scratch_.write("xdg-open", "#!/bin/sh\necho \"$1\" > \"$(dirname \"$0\")/opened\"\n");
  std::filesystem::permissions(opener, std::filesystem::perms::owner_all);
  const Studio studio(scratch_.path("scene.yaml").string(), opener.parent_path().string());
  const auto opened = scratch_.path("opened");
  for (int i = 0; i < 100 && (!std::filesystem::exists(opened) || std::filesystem::file_size(opened) == 0);
       ++i)
    ::usleep(50'000);
  ASSERT_TRUE(std::filesystem::exists(opened));
  const std::string address = fileText(opened);
  EXPECT_NE(studio.said.find(address.substr(0, address.find('\n'))), std::string::npos) << address;
}

TEST_F(StudioCommand, EndsWhileItGrows) {
  // A wall of millions of voxels, which takes longer to tile than anybody waits here.
  std::string scene = fileText(scratch_.path("scene.yaml"));
  scene.replace(scene.find("5 cm"), 4, "4 mm");
  scratch_.write("scene.yaml", scene);
  Studio studio(scratch_.path("scene.yaml").string());
  ::usleep(300'000);
  double seconds = 0.0;
  studio.endedBy(SIGINT, seconds);
  EXPECT_LT(seconds, kSoon_s);
}

TEST_F(StudioCommand, RefusesWhatIsNoScene) {
  const Ran none = espalier("studio " + scratch_.path("none.yaml").string() + " --no-open");
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.output.find("none.yaml"), std::string::npos) << none.output;
  const Ran port = espalier("studio " + scratch_.path("scene.yaml").string() + " --no-open --port 70000");
  EXPECT_EQ(port.status, 2);
}

TEST_F(StudioCommand, SaysThatAPortIsTaken) {
  Studio first(scratch_.path("scene.yaml").string());
  const auto at = first.said.find("127.0.0.1:") + 10;
  const std::string port = first.said.substr(at, first.said.find('/', at) - at);
  const Ran second = espalier("studio " + scratch_.path("scene.yaml").string() + " --no-open --port " + port);
  EXPECT_EQ(second.status, 2);
  EXPECT_NE(second.output.find(port), std::string::npos) << second.output;
}

}  // namespace
}  // namespace espalier::tests
