#include "sim/base/whole_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "sim/base/error.h"

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

/// A program in a container has the number of the one before it.
TEST(WholeFile, LeftoversOfADeadProcessOfOurNumberGoAndOurOwnFilesStay) {
  const fs::path folder = fs::path(testing::TempDir()) / ("espalier.own." + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / (".espalier-part-plant.glb-4000000000-" + std::to_string(::getpid()))) << "half";
  NewFile(folder / "plant.glb", [&](std::ostream& out) {
    out << "whole";
    const NewFile beside(folder / "world.vdb", [](std::ostream&) {});
    removeLeftovers(folder);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2);
  }).putInPlace();
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
  fs::remove_all(folder);
}

class NewFiles : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  static std::string in(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(folder_), {}); }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("espalier.new_file." + std::to_string(::getpid()));
  const fs::path path_ = folder_ / "world.vdb";
};

TEST_F(NewFiles, AreThereOnceTheyArePutInTheirPlace) {
  std::ofstream(path_) << "old";
  {
    const NewFile file(path_, [](std::ostream& out) { out << "new"; });
    EXPECT_EQ(files(), 2);
    EXPECT_EQ(in(path_), "old");
  }
  EXPECT_EQ(files(), 1);
  EXPECT_EQ(in(path_), "old");
  NewFile(path_, [](std::ostream& out) { out << "new"; }).putInPlace();
  EXPECT_EQ(files(), 1);
  EXPECT_EQ(in(path_), "new");
}

/// Pieces smaller and larger than what the stream keeps, and changes to what was written.
TEST_F(NewFiles, CanBeSoughtInWhileTheyAreWritten) {
  std::string wanted;
  NewFile file(path_, [&](std::ostream& out) {
    for (int i = 0; i < 3000; ++i) {
      const std::string piece(static_cast<std::size_t>(i % 997 == 0 ? 100'000 : i % 50),
                              static_cast<char>(i));
      wanted += piece;
      out << piece;
      if (i % 100 != 7) continue;
      const std::size_t at = wanted.size() / 3;
      ASSERT_EQ(out.tellp(), static_cast<std::streamoff>(wanted.size()));
      out.seekp(static_cast<std::streamoff>(at));
      out << "here";
      wanted.replace(at, 4, "here");
      out.seekp(static_cast<std::streamoff>(wanted.size()));
    }
    EXPECT_TRUE(out.good());
  });
  file.putInPlace();
  EXPECT_TRUE(in(path_) == wanted);
}

/// Two jobs of a process: the last one counts, and its bytes are not mixed with those of the other.
TEST_F(NewFiles, OfTheSameNameAreWrittenBesideEachOther) {
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < 6; ++thread) {
      threads.emplace_back([&, letter = static_cast<char>('a' + thread)] {
        for (int round = 0; round < 20; ++round) writeWhole(path_, std::string(50'000, letter));
      });
    }
  }
  const std::string last = in(path_);
  ASSERT_EQ(last.size(), 50'000u);
  EXPECT_EQ(last, std::string(50'000, last[0]));
  EXPECT_EQ(files(), 1);
}

/// As who learns only in the end what stands in front does: everything is moved on by what that takes.
TEST_F(NewFiles, CanBeReadBackWhileTheyAreWritten) {
  NewFile file(path_, [](std::iostream& out) {
    const std::string first(100'000, 'a');
    out << first << "bc";
    std::string block(first.size() + 2, ' ');
    out.seekg(0);
    EXPECT_TRUE(out.read(block.data(), static_cast<std::streamsize>(block.size())));
    EXPECT_TRUE(block == first + "bc");
    EXPECT_EQ(out.tellp(), 100'002);
    out.seekp(3);
    out << block;
    out.seekp(0);
    out << "in front";
    out.seekg(100'001);
    EXPECT_FALSE(out.read(block.data(), 5)) << "four are left";
    EXPECT_EQ(out.gcount(), 4);
    EXPECT_EQ(block.substr(0, 4), "aabc");
    out.clear();
  });
  file.putInPlace();
  EXPECT_TRUE(in(path_) == "in front" + std::string(99'995, 'a') + "bc");
}

TEST_F(NewFiles, ThatCannotBeMadeLeaveNothing) {
  EXPECT_THROW(NewFile(path_, [](std::ostream&) { throw std::runtime_error("no"); }), std::runtime_error);
  EXPECT_EQ(files(), 0);
  EXPECT_THROW(NewFile(path_,
                       [](std::ostream& out) {
                         out.exceptions(std::ios::failbit);
                         out.setstate(std::ios::failbit);
                       }),
               InputError);
  EXPECT_EQ(files(), 0);
  EXPECT_THROW(NewFile(folder_ / "nowhere" / "a", [](std::ostream&) {}), InputError);
  fs::create_directories(path_ / "full");  // a file cannot take a folder's place
  NewFile file(path_, [](std::ostream&) {});
  EXPECT_THROW(file.putInPlace(), InputError);
}

}  // namespace
}  // namespace espalier::sim
