#include "sim/base/whole_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace espalier::sim {
namespace {

namespace fs = std::filesystem;

/// The number of a process that has ended.
pid_t ended() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

TEST(WholeFile, LeftoversOfTheDeadGoAndWhatTheLivingWriteStays) {
  const fs::path folder = fs::path(testing::TempDir()) / ("espalier.leftovers." + std::to_string(::getpid()));
  fs::create_directories(folder);
  const auto part = [&](const std::string& writer) {
    const fs::path path = folder / (".espalier-part-growth.state-" + writer);
    std::ofstream(path) << "half";
    return path;
  };
  const fs::path living = part(std::to_string(::getppid())), dead = part(std::to_string(ended()));
  const fs::path nobodys = part("");
  std::ofstream(folder / "plant.glb") << "whole";
  removeLeftovers(folder);
  EXPECT_TRUE(fs::exists(living));
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_FALSE(fs::exists(nobodys));
  EXPECT_TRUE(fs::exists(folder / "plant.glb"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace espalier::sim
