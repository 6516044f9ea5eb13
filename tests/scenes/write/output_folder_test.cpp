#include "scenes/write/output_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <ostream>

#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;

class OutputFolders : public testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  /// What an output folder says against these names; empty if nothing.
  std::string refusal(const fs::path& folder, const std::vector<std::string>& names = {},
                      const std::vector<fs::path>& read = {}) const {
    try {
      const OutputFolder output(folder, names, read);
    } catch (const sim::InputError& error) {
      return error.what();
    }
    return "";
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("espalier.output." + std::to_string(::getpid()));
};

TEST_F(OutputFolders, HoldAllFilesOrNone) {
  std::vector<OutputFile> files;
  for (int i = 0; i < 12; ++i) files.push_back(fileOf(std::to_string(i), [i] { return std::to_string(i); }));
  files.push_back({"last", [](std::ostream&) { throw sim::InputError("no"); }});
  EXPECT_THROW(OutputFolder(folder_, {}, {}).write(files), sim::InputError);
  EXPECT_FALSE(fs::exists(folder_));
  fs::create_directories(folder_);
  EXPECT_THROW(OutputFolder(folder_, {}, {}).write(files), sim::InputError);
  EXPECT_TRUE(fs::is_empty(folder_));
  files.pop_back();
  OutputFolder(folder_, {}, {}).write(files);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 12);
  std::string text;
  EXPECT_TRUE(std::ifstream(folder_ / "11") >> text);
  EXPECT_EQ(text, "11");
}

TEST_F(OutputFolders, LeaveNoNewFolderWithoutAFile) {
  { const OutputFolder output(folder_ / "a/b", {}, {}); }
  EXPECT_FALSE(fs::exists(folder_));
  fs::create_directories(folder_ / "a");
  { const OutputFolder output(folder_ / "a/b/c", {}, {}); }
  EXPECT_TRUE(fs::exists(folder_ / "a"));
  EXPECT_FALSE(fs::exists(folder_ / "a/b"));
  OutputFolder(folder_ / "a/b/c", {}, {}).write({fileOf("file", [] { return "x"; })});
  EXPECT_TRUE(fs::exists(folder_ / "a/b/c/file"));
}

TEST_F(OutputFolders, BelongToOneRunAtATime) {
  {
    const OutputFolder mine(folder_, {}, {});
    EXPECT_NE(refusal(folder_).find("another run is writing into this folder"), std::string::npos);
    EXPECT_NE(refusal(folder_ / "../" / folder_.filename()).find("another run"), std::string::npos);
    EXPECT_EQ(refusal(folder_ / "inner"), "");
    EXPECT_TRUE(fs::exists(folder_));
  }
  EXPECT_EQ(refusal(folder_), "");
}

TEST_F(OutputFolders, AreRefusedBeforeTheWorkWhereNothingCanBeWritten) {
  EXPECT_NE(refusal("/dev/null").find("/dev/null: cannot make the folder"), std::string::npos);
  EXPECT_NE(refusal("/dev/null/x").find("/dev/null/x: cannot make the folder"), std::string::npos);
  EXPECT_NE(refusal("/proc/self").find("cannot create the file"), std::string::npos);
  fs::create_directories(folder_ / "plant.glb");
  EXPECT_NE(refusal(folder_, {"plant.glb"}).find("plant.glb: this is no file"), std::string::npos);
  EXPECT_EQ(refusal(folder_, {"world.vdb"}), "");
}

TEST_F(OutputFolders, NeverWriteOverWhatWasRead) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "plant.glb") << "mesh";
  fs::create_symlink(folder_ / "plant.glb", folder_ / "world.vdb");
  const std::vector<fs::path> read = {folder_ / "none.yaml", folder_ / "." / "plant.glb"};
  EXPECT_NE(refusal(folder_, {"plant.glb"}, read).find("would write over it"), std::string::npos);
  EXPECT_NE(refusal(folder_, {"world.vdb"}, read).find("would write over it"), std::string::npos);
  EXPECT_EQ(refusal(folder_, {"report.json"}, read), "");
  EXPECT_EQ(refusal(folder_, {"plant.glb"}), "");
  OutputFolder output(folder_, {"plant.glb"}, {});
  EXPECT_THROW(output.protect(read), sim::InputError);
  EXPECT_THROW(output.write({fileOf("plant.glb", [] { return "plant"; })}), sim::InputError);
  std::string text;
  EXPECT_TRUE(std::ifstream(folder_ / "plant.glb") >> text);
  EXPECT_EQ(text, "mesh");
}

}  // namespace
}  // namespace espalier::scenes
