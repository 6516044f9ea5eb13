#include "scenes/write/output_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <ostream>

#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;

TEST(OutputFiles, AreAllThereOrNone) {
  const fs::path folder = fs::path(testing::TempDir()) / ("espalier.output." + std::to_string(::getpid()));
  fs::remove_all(folder);
  std::vector<OutputFile> files;
  for (int i = 0; i < 12; ++i) files.push_back(fileOf(std::to_string(i), [i] { return std::to_string(i); }));
  files.push_back({"last", [](std::ostream&) { throw sim::InputError("no"); }});
  EXPECT_THROW(writeAll(folder, files), sim::InputError);
  EXPECT_FALSE(fs::exists(folder));
  fs::create_directories(folder);
  EXPECT_THROW(writeAll(folder, files), sim::InputError);
  EXPECT_TRUE(fs::is_empty(folder));
  files.pop_back();
  writeAll(folder, files);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 12);
  std::string text;
  EXPECT_TRUE(std::ifstream(folder / "11") >> text);
  EXPECT_EQ(text, "11");
  fs::remove_all(folder);
}

}  // namespace
}  // namespace espalier::scenes
