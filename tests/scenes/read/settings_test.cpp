#include "scenes/read/settings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "rules/language/registry.h"
#include "scenes/read/read_rules.h"
#include "scenes/read/read_scene.h"
#include "scenes/read/read_table.h"
#include "scenes/read/registry.h"
#include "scenes/yaml/yaml_tree.h"
#include "scenes/yaml/yaml_value.h"
#include "tests/scenes/read/sample.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

using rules::Key;
using rules::Table;

/// The paths at which two listings differ.
std::set<std::string> differences(const Settings& a, const Settings& b) {
  const std::map<std::string, std::string> of_a(a.begin(), a.end()), of_b(b.begin(), b.end());
  EXPECT_EQ(of_a.size(), a.size()) << "a path stands there twice";
  EXPECT_EQ(of_b.size(), b.size()) << "a path stands there twice";
  std::set<std::string> all;
  for (const auto& [path, value] : of_a) {
    const auto other = of_b.find(path);
    if (other == of_b.end() || other->second != value) all.insert(path);
  }
  for (const auto& [path, value] : of_b) {
    if (!of_a.contains(path)) all.insert(path);
  }
  return all;
}

std::shared_ptr<void> read(const Table& table, const std::string& text) {
  Problems problems;
  Reading reading{problems};
  reading.special = [](const auto&...) {};
  auto object = table.make();
  const auto root = parseYaml(text, "f", problems);
  if (root) readTable(*root, table, object.get(), "", reading);
  EXPECT_TRUE(root && problems.empty()) << text << "\n" << format(problems.sorted());
  return object;
}

rules::Datum datum(const Key& key, const std::string& text) {
  Problems problems;
  const auto root = parseYaml(fmt::format("{{k: {}}}", text), "f", problems);
  return readDatum(root->entries[0].value, key, "k", problems).value_or(rules::Datum{});
}

class SettingsOf : public testing::TestWithParam<std::string> {};

TEST_P(SettingsOf, EveryKeyChangesAtItsPathAndNowhereElse) {
  const Table& table = GetParam() == "rules" ? rules::ruleTable() : sceneTable();
  int changed = 0, keys = 0;
  tests::forEachKeyInPlace(
      table, "", [](const std::string& root) { return root; },
      [&](std::string path, const Key& key, const auto& wrap) {
        if (!key.get || key.kind == rules::Kind::rules) return;
        ++keys;
        for (auto at = path.find("[]"); at != path.npos; at = path.find("[]")) path.replace(at, 2, "[0]");
        const auto texts = tests::goodTexts(key);
        bool moved = texts.size() < 2;
        for (const auto& a : texts) {
          const auto before = read(table, wrap(a));
          for (const auto& b : texts) {
            const auto after = read(table, wrap(b));
            const auto where = differences(settings(table, before.get()), settings(table, after.get()));
            if (datum(key, a) == datum(key, b)) {
              EXPECT_EQ(where, std::set<std::string>{}) << path << ": " << a << ", " << b;
            } else {
              EXPECT_EQ(where, std::set{path}) << a << ", " << b;
              moved = true;
              ++changed;
            }
          }
        }
        EXPECT_TRUE(moved) << path << " has no two values that differ";
      });
  EXPECT_GT(keys, 30);
  EXPECT_GT(changed, 2 * keys);
}

INSTANTIATE_TEST_SUITE_P(Registries, SettingsOf, testing::Values("rules", "scene"),
                         [](const auto& at) { return at.param; });

Settings ofRules(const tests::Scratch& scratch, const std::string& text) {
  const auto rules = readRules(scratch.write("r.yaml", "espalier: rules\n" + text));
  EXPECT_TRUE(rules) << format(rules.problems());
  return rules ? settings(**rules) : Settings{};
}

std::string at(const Settings& all, const std::string& path) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& line) { return line.first == path; });
  return found == all.end() ? "not there" : found->second;
}

TEST(Settings, SayTheDefaultsToo) {
  const tests::Scratch scratch;
  const auto all = ofRules(scratch, "");
  EXPECT_EQ(at(all, "random_tree.length"), "2.4");
  EXPECT_EQ(at(all, "require.proximity.max"), "");
  EXPECT_EQ(at(all, "elements"), "[]");
  EXPECT_EQ(at(all, "otherwise"), "");
  EXPECT_EQ(at(all, "regions"), "{}");
}

TEST(Settings, TellNumbersApartToTheLastBit) {
  const tests::Scratch scratch;
  EXPECT_EQ(
      differences(ofRules(scratch, "bias: {up: 0.3}"), ofRules(scratch, "bias: {up: 0.30000000000000004}")),
      std::set<std::string>{"bias.up"});
  EXPECT_EQ(differences(ofRules(scratch, "stem: {colour: [0.5, 0.5, 0.5]}"),
                        ofRules(scratch, "stem: {colour: [0.5, 0.5, 0.500001]}")),
            std::set<std::string>{"stem.colour"})
      << "colours that have one #rrggbb";
}

TEST(Settings, TellTextsApartThatHoldWhatPartsThem) {
  const tests::Scratch scratch;
  EXPECT_EQ(at(ofRules(scratch, "name: 'a \"b\"'"), "name"), "\"a \\\"b\\\"\"");
  EXPECT_EQ(at(ofRules(scratch, "regions: {'a.b': forbid}"), "regions.\"a.b\""), "forbid");
}

TEST(Settings, GoIntoRuleSetsWithin) {
  const tests::Scratch scratch;
  scratch.write("ivy.yaml", "espalier: rules\nbias: {up: 0.5}\nregions: {roof: forbid}\n");
  const std::string text =
      "otherwise: {bias: {up: 0.1}, otherwise: {bias: {up: 0.2}}}\n"
      "regions: {wall: {bias: {up: 0.3}}, others: {bias: {up: 0.4}}, bed: ivy.yaml, kerb: forbid}\n";
  const auto all = ofRules(scratch, text);
  EXPECT_EQ(at(all, "otherwise.bias.up"), "0.1");
  EXPECT_EQ(at(all, "otherwise.otherwise.bias.up"), "0.2");
  EXPECT_EQ(at(all, "otherwise.otherwise.otherwise"), "");
  EXPECT_EQ(at(all, "regions.wall.bias.up"), "0.3");
  EXPECT_EQ(at(all, "regions.others.bias.up"), "0.4");
  EXPECT_EQ(at(all, "regions.bed.regions.roof"), "forbid");
  EXPECT_EQ(at(all, "regions.kerb"), "forbid");
  EXPECT_EQ(at(all, "regions.wall.otherwise"), "as otherwise") << "it falls back as the whole does";
  for (const auto& [from, to, path] : {std::tuple{"up: 0.1", "up: 0.15", "otherwise.bias.up"},
                                       {"up: 0.2", "up: 0.25", "otherwise.otherwise.bias.up"},
                                       {"up: 0.3", "up: 0.35", "regions.wall.bias.up"},
                                       {"up: 0.4", "up: 0.45", "regions.others.bias.up"}}) {
    auto other = text;
    other.replace(other.find(from), std::string(from).size(), to);
    EXPECT_EQ(differences(all, ofRules(scratch, other)), std::set<std::string>{path});
  }
}

TEST(Settings, OfFilesThatShareFilesDoNotGrowWithoutBound) {
  const tests::Scratch scratch;
  for (int i = 0; i < 60; ++i) {
    scratch.write(
        fmt::format("{}.yaml", i),
        fmt::format("espalier: rules\notherwise: {0}.yaml\nregions: {{a: {0}.yaml, b: {0}.yaml}}\n", i + 1));
  }
  scratch.write("60.yaml", "espalier: rules\n");
  const auto rules = readRules(scratch.path("0.yaml"));
  ASSERT_TRUE(rules) << format(rules.problems());
  EXPECT_LT(settings(**rules).size(), 61u * 100);
}

TEST(Settings, OfASceneDoNotHangOnWhereTheFilesLie) {
  const tests::Scratch scratch;
  const auto in = [&](const std::string& folder) {
    scratch.write(folder + "/meshes/a.obj", "");
    scratch.write(folder + "/vine.yaml", "espalier: rules\nbias: {up: 0.1}\notherwise: {bias: {up: 0.2}}\n");
    scratch.write(folder + "/other.yaml", "espalier: rules\nbias: {up: 0.1}\notherwise: {bias: {up: 0.2}}\n");
    const auto scene = readScene(scratch.write(
        folder + "/scenes/s.yaml",
        "espalier: scene\nmeshes: [../meshes/a.obj]\nworld: {voxel: 1}\nplants:\n"
        "  - {rules: ../vine.yaml, seeds: [[0, 0, 0]]}\n  - {rules: ../other.yaml, seeds: [[1, 0, 0]]}\n"));
    EXPECT_TRUE(scene) << format(scene.problems());
    return scene ? settings(*scene) : Settings{};
  };
  const auto all = in("one");
  EXPECT_EQ(all, in("another/place"));
  EXPECT_EQ(at(all, "meshes[0].file"), "\"../meshes/a.obj\"");
  EXPECT_EQ(at(all, "world.bounds"), "") << "an optional mapping that is not there";
  EXPECT_EQ(at(all, "plants[0].seeds[0].at"), "[0, 0, 0]");
  Settings first, second;
  for (auto [path, value] : all) {
    if (path.starts_with("plants[0].rules")) first.emplace_back(path.substr(15), value);
    if (path.starts_with("plants[1].rules")) second.emplace_back(path.substr(15), value);
  }
  EXPECT_GT(first.size(), 50u);
  EXPECT_EQ(first, second) << "two files of the same text say the same";
}

}  // namespace
}  // namespace espalier::scenes
