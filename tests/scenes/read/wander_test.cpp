#include <gtest/gtest.h>

#include "scenes/read/read_rules.h"
#include "tests/scenes/read/bad_file.h"
#include "tests/support/scratch.h"

/// random_tree.wander: a number, or a mapping with a distribution of the angle.
namespace espalier::scenes {
namespace {

using rules::AngleDistribution;
using rules::Value;
using tests::BadFile;
using tests::BadRules;
using tests::Scratch;

rules::RandomTree treeOf(const Scratch& scratch, const std::string& wander, const std::string& header = "") {
  const auto rules = readRules(
      scratch.write("r.yaml", "espalier: rules\n" + header + "random_tree: {wander: " + wander + "}\n"));
  EXPECT_TRUE(rules) << scratch.shown(rules.problems());
  return rules ? (*rules)->random_tree : rules::RandomTree{};
}

TEST(Wander, TakesANumberForItsAngle) {
  const Scratch scratch;
  EXPECT_EQ(treeOf(scratch, "35").wander_deg, Value(35.0));
  EXPECT_EQ(treeOf(scratch, "[5, 9]").wander_deg.kind, Value::Kind::range);
  EXPECT_EQ(treeOf(scratch, "{over: age, points: [[0, 9], [9, 1]]}").wander_deg.kind, Value::Kind::curve);
  EXPECT_EQ(treeOf(scratch, "{angle: 35}").wander_deg, Value(35.0));
  EXPECT_EQ(treeOf(scratch, "{angle: [5, 9]}").wander_deg.kind, Value::Kind::range);
  EXPECT_EQ(treeOf(scratch, "{angle: 35}").distribution(), AngleDistribution::cone);
}

TEST(Wander, TakesADistributionOrATable) {
  const Scratch scratch;
  EXPECT_EQ(treeOf(scratch, "{distribution: gaussian}").distribution(), AngleDistribution::gaussian);
  EXPECT_EQ(treeOf(scratch, "{distribution: gaussian}").wander_deg, Value(20.0));
  const auto tabled = treeOf(scratch, "{angle: 30, table: [[0, 0], [0.5, 1], [2, 0]]}");
  EXPECT_EQ(tabled.distribution(), AngleDistribution::table);
  EXPECT_EQ(tabled.wander_table, (std::vector<glm::dvec2>{{0.0, 0.0}, {0.5, 1.0}, {2.0, 0.0}}));
  EXPECT_EQ(treeOf(scratch, "{table: [[0, 1], [1, 0]], distribution: table}").distribution(),
            AngleDistribution::table);
}

/// What a base says, or the rule set around an `otherwise`, is replaced by either key.
TEST(Wander, TheLastWordHolds) {
  const Scratch scratch;
  const auto over = [&](const std::string& base, const std::string& wander) {
    scratch.write("base.yaml", "espalier: rules\nrandom_tree: {wander: {angle: 30, " + base + "}}\n");
    const auto built = treeOf(scratch, wander, "base: base.yaml\n");
    for (const char* const within : {"otherwise", "branches"}) {
      const auto whole = readRules(
          scratch.write("w.yaml", "espalier: rules\nrandom_tree: {wander: {angle: 30, " + base + "}}\n" +
                                      within + ": {random_tree: {wander: " + wander + "}}\n"));
      EXPECT_TRUE(whole) << scratch.shown(whole.problems());
      if (!whole) continue;
      const auto& inner = (*whole)->otherwise ? (*whole)->otherwise : (*whole)->branches;
      EXPECT_EQ(inner->random_tree.distribution(), built.distribution());
      EXPECT_EQ(inner->random_tree.wander_deg, built.wander_deg);
    }
    return built;
  };
  const std::string gaussian = "distribution: gaussian", table = "table: [[0, 1], [1, 0]]";
  EXPECT_EQ(over(gaussian, "40").distribution(), AngleDistribution::gaussian);
  EXPECT_EQ(over(gaussian, "40").wander_deg, Value(40.0));
  EXPECT_EQ(over(gaussian, "{" + table + "}").distribution(), AngleDistribution::table);
  EXPECT_EQ(over(gaussian, "{" + table + "}").wander_deg, Value(30.0));
  EXPECT_EQ(over(gaussian, "{distribution: table, " + table + "}").distribution(), AngleDistribution::table);
  EXPECT_EQ(over(table, "{" + gaussian + "}").distribution(), AngleDistribution::gaussian);
  EXPECT_EQ(over(table, "{distribution: cone}").distribution(), AngleDistribution::cone);
  EXPECT_EQ(over(table, "{distribution: table}").wander_table.size(), 2u);
  EXPECT_EQ(over(table, "{table: [[0, 1], [1, 1], [2, 0]]}").wander_table.size(), 3u);
}

// Rule files begin with "espalier: rules" on line 1.
const std::vector<BadFile> kBadWander = {
    {"too wide, in short and at length",
     "random_tree: {wander: 181}\notherwise: {random_tree: {wander: {angle: -1}}}\n",
     {"2:23: random_tree.wander.angle is '181', which is out of range; expected a number from 0 to 180",
      "3:43: random_tree.wander.angle is '-1', which is out of range"}},
    {"no distribution",
     "random_tree: {wander: {distribution: gausian}}\n",
     {"2:38: random_tree.wander.distribution is 'gausian'; expected one of cone, gaussian, table; did you "
      "mean 'gaussian'?"}},
    {"two distributions",
     "random_tree: {wander: {distribution: gaussian, table: [[0, 1], [1, 0]]}}\n",
     {"2:48: a table beside another distribution; expected one of them, or distribution: table"}},
    {"two distributions, the table first",
     "random_tree:\n  wander:\n    table: [[0, 1], [1, 0]]\n    distribution: cone\n",
     {"4:5: a table beside another distribution; expected one of them"}},
    {"a table that is not there",
     "random_tree:\n  wander: {distribution: table}\n",
     {"3:26: a table that is not there; expected table: [[share of the angle, weight], ...]"}},
    {"a table that is not there, told once",
     "random_tree:\n  wander: {distribution: table}\notherwise: {bias: {up: 0.1}}\n",
     {"3:26: a table that is not there"}},
    {"one point",
     "random_tree: {wander: {table: [[1, 1]]}}\n",
     {"2:24: a table of one point; expected two or more, such as [[0, 1], [1, 0]]"}},
    {"no weight",
     "random_tree: {wander: {table: [[0, 0], [1, 0]]}}\n",
     {"2:24: a table of weights 0, by which no angle is drawn; expected one above 0 somewhere"}},
    {"shares that do not rise",
     "random_tree: {wander: {table: [[0, 1], [0.5, 2], [0.5, 1]]}}\n",
     {"2:24: a table with the share 0.5 after 0.5; expected shares that rise"}},
    {"a share below 0",
     "random_tree: {wander: {table: [[-0.1, 1], [0.5, 2]]}}\n",
     {"2:24: a table with the share -0.1 of the angle; expected shares from 0 to 1000"}},
    {"a weight below 0",
     "random_tree: {wander: {table: [[0, 1], [0.5, -2]]}}\n",
     {"2:46: random_tree.wander.table is '-2', which is out of range; expected a list of 1 to 64 pairs"}},
};

INSTANTIATE_TEST_SUITE_P(Wander, BadRules, testing::ValuesIn(kBadWander), tests::testName);

}  // namespace
}  // namespace espalier::scenes
