#include "scenes/read/rule_library.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "scenes/read/read_rules.h"
#include "scenes/read/read_scene.h"
#include "scenes/read/settings.h"
#include "sim/base/hasher.h"
#include "tests/support/scratch.h"

/// Rule sets that are known by name.
namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;

class RuleLibrary : public testing::Test {
 protected:
  /// A scene whose only plant has these rules.
  Scene scene(const std::string& rules) {
    auto read = readScene(scratch_.write(
        "scene.yaml",
        fmt::format("espalier: scene\nworld: {{voxel: 1, bounds: {{min: [0, 0, 0], max: [9, 9, 9]}}}}\n"
                    "plants: [{{rules: {}, seeds: [[1, 1, 1]]}}]\n",
                    rules)));
    EXPECT_TRUE(read) << format(read.problems());
    return *read;
  }

  const fs::path folder_ = tests::sourceFolder() / "rules/library";
  tests::Scratch scratch_;
};

TEST_F(RuleLibrary, HasEveryFileOfItsFolderByteForByte) {
  std::set<std::string> files, names;
  for (const auto& entry : fs::directory_iterator(folder_)) files.insert(entry.path().stem().string());
  for (const LibraryRules& rules : ruleLibrary()) {
    names.emplace(rules.name);
    EXPECT_EQ(rules.text, tests::fileText(folder_ / (std::string(rules.name) + ".yaml"))) << rules.name;
    EXPECT_FALSE(aboutOf(rules).empty()) << rules.name;
    EXPECT_LT(aboutOf(rules).size(), 200u) << rules.name;
    EXPECT_EQ(aboutOf(rules).find('\n'), std::string::npos) << rules.name;
  }
  EXPECT_EQ(names, files);
}

TEST_F(RuleLibrary, NamesMeanWhatItsFilesMean) {
  for (const std::string& name : libraryNames()) {
    const auto by_name = readRules(scratch_.write("r.yaml", "espalier: rules\nbase: " + name + "\n"));
    ASSERT_TRUE(by_name) << format(by_name.problems());
    const auto by_path = readRules(folder_ / (name + ".yaml"));
    EXPECT_EQ(format(settings(**by_name)), format(settings(**by_path))) << name;
  }
  EXPECT_EQ(format(settings(scene("ivy"))), format(settings(scene((folder_ / "ivy.yaml").string()))));
}

TEST_F(RuleLibrary, NamesTheNearestWhereItHasNone) {
  const auto read = readRules(scratch_.write("r.yaml", "espalier: rules\notherwise: hornbaem\n"));
  EXPECT_NE(format(read.problems()).find("did you mean 'hornbeam'?"), std::string::npos);
}

TEST_F(RuleLibrary, NamesStandWhereverRuleSetsDo) {
  scratch_.write("mine.yaml",
                 "espalier: rules\nbase: ivy\notherwise: courtyard_vine\nregions: {wall: flat_walk, others: "
                 "{base: ivy}}\n");
  const auto rules = scene("mine.yaml").plants[0].rules;
  EXPECT_EQ(rules->otherwise->name, "courtyard vine");
  EXPECT_EQ(rules->regions.at("wall").rules->name, "flat walk");
  EXPECT_EQ(rules->others->rules->name, "ivy");
}

TEST_F(RuleLibrary, IsAnInputLikeAnyOther) {
  const Scene read = scene("column_climber_near");
  ASSERT_EQ(read.read_files.size(), 3u);
  EXPECT_EQ(read.read_files[1].name, "library:column_climber_near");
  EXPECT_EQ(read.read_files[1].kind, "rules");
  EXPECT_EQ(read.read_files[1].hash, sim::hashOf(tests::fileText(folder_ / "column_climber_near.yaml")));
  EXPECT_EQ(read.read_files[2].name, "library:column_climber_up");
  EXPECT_EQ(read.read_paths.size(), 1u) << "what is no file cannot be written over";
}

TEST_F(RuleLibrary, AFileOfThatNameComesFirst) {
  scratch_.write("ivy", "espalier: rules\nname: mine\n");
  EXPECT_EQ(scene("ivy").plants[0].rules->name, "mine");
  EXPECT_EQ(scene("./ivy").plants[0].rules->name, "mine");
  EXPECT_EQ(scene("courtyard_vine").plants[0].rules->name, "courtyard vine");
}

}  // namespace
}  // namespace espalier::scenes
