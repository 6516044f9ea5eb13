#include "scenes/write/folder_claim.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "scenes/write/output_folder.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"
#include "tests/support/messages.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;

class FolderClaims : public testing::Test {
 protected:
  std::string refusal(const fs::path& folder) {
    return tests::messageOf([&] { const FolderClaim claim(folder); });
  }
  tests::Scratch scratch_;
  const fs::path folder_ = scratch_.path("a/b");
};

TEST_F(FolderClaims, WhoComesTooLateLeavesTheFolderAsItIs) {
  {
    const FolderClaim mine(folder_);
    EXPECT_TRUE(mine.certain());
    EXPECT_NE(refusal(folder_).find("another run is writing"), std::string::npos);
    EXPECT_TRUE(fs::exists(folder_)) << "though it is empty";
  }
  EXPECT_FALSE(fs::exists(scratch_.path("a")));
}

/// A child that has not executed its program yet, or never will, has the descriptor too.
TEST_F(FolderClaims, EndWithTheirObjectWhateverChildrenHave) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  auto mine = std::make_unique<FolderClaim>(folder_);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[1]);
    char none = 0;
    ::_exit(static_cast<int>(::read(ends[0], &none, 1)));
  }
  mine.reset();
  EXPECT_EQ(refusal(folder_), "no error");
  ::close(ends[0]);
  ::close(ends[1]);
  ::waitpid(child, nullptr, 0);
}

/// Threads and processes that make, claim, fill and leave one folder again and again: who has it never loses
/// it, nor what it writes there.
TEST_F(FolderClaims, TheLivingNeverLoseTheirFolder) {
  // Until it had the folder so many times, and was refused in between.
  const auto runs = [&](int times) {
    for (int had = 0; had < times;) {
      try {
        const OutputFolder output(folder_, {"plant.glb"}, {});
        if (had++ % 2 == 0) continue;  // nothing is written: it goes
        for (const char* name : {"plant.glb", "world.vdb"}) {
          sim::writeWhole(folder_ / name, "all");  // not by write(): a forked child has no pool
          if (!fs::exists(folder_ / name)) throw std::runtime_error("it is lost");
        }
        for (const char* name : {"plant.glb", "world.vdb"}) fs::remove(folder_ / name);
      } catch (const sim::InputError& error) {
        if (std::string(error.what()).find("another run is writing") == std::string::npos) throw;
        std::this_thread::sleep_for(std::chrono::microseconds(100));
      }
    }
  };
  constexpr int kTimes = 25;
  std::vector<pid_t> children;
  for (int i = 0; i < 3; ++i) {
    children.push_back(::fork());
    if (children.back() != 0) continue;
    int status = 1;
    try {
      runs(kTimes);
      status = 0;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    ::_exit(status);
  }
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 3; ++i) threads.emplace_back([&] { EXPECT_NO_THROW(runs(kTimes)); });
  }
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(refusal(folder_), "no error");
}

}  // namespace
}  // namespace espalier::scenes
