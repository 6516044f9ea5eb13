#include "scenes/import/reading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "render/image/image_io.h"
#include "scenes/import/guarded_file.h"
#include "scenes/import/mesh_import.h"
#include "scenes/import/mesh_wire.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "tests/support/messages.h"
#include "tests/support/scratch.h"
#include "tests/support/volumes.h"

namespace espalier::scenes {
namespace {

/// While it lives, readings are done by the program.
class ByProgram {
 public:
  ByProgram() { readInProgram(ESPALIER_PROGRAM); }
  ByProgram(const ByProgram&) = delete;
  ByProgram& operator=(const ByProgram&) = delete;
  ~ByProgram() { readInProgram({}); }
};

std::string meshFile(const std::string& name) {
  return (tests::sourceFolder() / "scenes/meshes" / name).string();
}

class Readings : public testing::Test {
 protected:
  Readings() {
    render::Image sky(8, 4, 3);
    std::fill(sky.pixels.begin(), sky.pixels.end(), 0.5f);
    const std::string png = render::encodePng(sky), picture = scratch_.write("sky.png", png).string();
    const std::string volume = scratch_.path("wind.vdb").string();
    tests::writeVolume(volume,
                       {tests::vectorGrid("wind", 0.5, {0, 0, 0}, {4, 3, 2}, [](sim::Vec3 m) { return m; })});
    sound_ = {{"mesh", {meshFile("boulder.obj"), "group"}},
              {"mesh", {meshFile("ruin.obj"), "material"}},
              {"picture", {picture}},
              {"density", {picture}},
              {"sky", {picture}},
              {"texture", {"image/png", png}},
              {"skeleton", {(tests::sourceFolder() / "scenes/skeletons/lsystem_tree.json").string()}},
              {"volume", {volume, "wind"}}};
    const std::string broken = scratch_.write("broken", std::string(1000, '\x80')).string();
    broken_ = {{"picture", {broken}},
               {"density", {broken}},
               {"sky", {broken}},
               {"texture", {"image/jpeg", std::string(99, 'x')}},
               {"skeleton", {broken}},
               {"volume", {broken, ""}},
               {"volume", {volume, "winds"}},
               {"mesh", {broken, "group"}},
               {"mesh", {meshFile("none.obj"), "group"}}};
  }

  tests::Scratch scratch_;
  std::vector<FileReading> sound_, broken_;
};

TEST_F(Readings, AreTheSameInAForkedChildInAnExecutedOneAndHere) {
  for (const FileReading& reading : sound_) {
    const ChildResult forked = readBeside(reading, {});
    const ByProgram by_program;
    const ChildResult executed = readBeside(reading, {});
    ASSERT_EQ(forked.end, ChildEnd::finished) << reading.reader << ": " << forked.bytes;
    ASSERT_EQ(executed.end, ChildEnd::finished) << reading.reader << ": " << executed.bytes;
    EXPECT_FALSE(forked.bytes.empty());
    EXPECT_TRUE(forked.bytes == executed.bytes) << reading.reader;
    EXPECT_TRUE(forked.bytes == readHere(reading)) << reading.reader;
  }
}

TEST_F(Readings, FailInTheSameWords) {
  for (const FileReading& reading : broken_) {
    const ChildResult forked = readBeside(reading, {});
    const ByProgram by_program;
    const ChildResult executed = readBeside(reading, {});
    EXPECT_EQ(forked.end, ChildEnd::threw) << reading.reader;
    EXPECT_EQ(executed.end, ChildEnd::threw) << reading.reader;
    EXPECT_FALSE(forked.bytes.empty()) << reading.reader;
    EXPECT_EQ(forked.bytes, executed.bytes) << reading.reader;
  }
}

TEST_F(Readings, OfNoReaderAreRefused) {
  EXPECT_THROW(readHere({"fortune", {"tea leaves"}}), std::logic_error);
  EXPECT_THROW(readHere({"mesh", {}}), std::logic_error);
  const ByProgram by_program;
  EXPECT_EQ(readBeside({"fortune", {}}, {}).bytes, "there is no reader 'fortune'");
}

/// What is too much for a child is said in the same words.
TEST_F(Readings, HaveTheirLimitsInAnExecutedChild) {
  const auto said = [&](const ChildLimits& limits) {
    return tests::messageOf([&] { importMesh(meshFile("boulder.obj"), RegionsFrom::group, limits); });
  };
  ChildLimits hasty, little;
  hasty.wall = std::chrono::milliseconds(1);
  little.memory_bytes = 1 << 20;
  little.result_bytes = 1000;
  const std::string late = said(hasty), fat = said(little);
  EXPECT_NE(late.find("was not done with it in 20 s"), std::string::npos) << late;
  EXPECT_NE(fat.find("took more than 1 MB"), std::string::npos) << fat;
  const ByProgram by_program;
  EXPECT_EQ(said(hasty), late);
  EXPECT_EQ(said(little), fat);
}

/// Threads that read, while others keep all that a child might need locked: memory, streams, the pool.
TEST_F(Readings, AreSafeBesideThreads) {
  const std::vector<std::string> names{"boulder.obj", "ruin.obj", "garden_wall.obj", "maze_walls.obj"};
  std::vector<std::string> expected;
  for (const std::string& name : names)
    expected.push_back(packMesh(importMesh(meshFile(name), RegionsFrom::group)));
  const ByProgram by_program;
  std::atomic<bool> done = false;
  std::vector<std::jthread> busy;
  for (int i = 0; i < 2; ++i) {
    busy.emplace_back([&] {
      while (!done) {
        sim::parallelForEach(64, [](std::size_t n) {
          std::vector<std::string> held;
          for (std::size_t k = 0; k < 20; ++k) held.emplace_back(100 * n + k, 'x');
        });
      }
    });
  }
  {
    std::vector<std::jthread> readers;
    for (std::size_t thread = 0; thread < 8; ++thread) {
      readers.emplace_back([&, thread] {
        for (std::size_t round = 0; round < 3; ++round) {
          const std::size_t which = (thread + round) % names.size();
          const std::string read = packMesh(importMesh(meshFile(names[which]), RegionsFrom::group));
          EXPECT_TRUE(read == expected[which]) << names[which];
        }
      });
    }
  }
  done = true;
}

}  // namespace
}  // namespace espalier::scenes
