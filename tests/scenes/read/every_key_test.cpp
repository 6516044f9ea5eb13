#include <gtest/gtest.h>

#include "rules/language/registry.h"
#include "scenes/read/read_scene.h"
#include "scenes/read/read_table.h"
#include "scenes/read/registry.h"
#include "scenes/yaml/yaml_tree.h"
#include "scenes/yaml/yaml_value.h"
#include "tests/scenes/read/sample.h"
#include "tests/support/scratch.h"

/// What holds for every key of the registries; a new key is covered without a word here.
namespace espalier::scenes {
namespace {

using rules::Datum;
using rules::Key;
using rules::Table;

const Table& tableOf(const std::string& kind) {
  return kind == "rules" ? rules::ruleTable() : sceneTable();
}

class EveryKey : public testing::TestWithParam<std::string> {
 protected:
  /// Calls with each key but the header, and with what makes a mapping at the file's root of its value.
  void forEach(const std::function<void(const std::string&, const Key&,
                                        const std::function<std::string(const std::string&)>&)>& visit) {
    int keys = 0;
    tests::forEachKeyInPlace(
        tableOf(GetParam()), "", [](const std::string& root) { return root; },
        [&](const auto& path, const auto& key, const auto& wrap) {
          ++keys;
          visit(path, key, wrap);
        });
    EXPECT_GT(keys, 40);
  }
};

/// A table may stand alone: its keys are read into a struct of its own.
void forEachTable(const Table& table, const std::function<void(const Table&)>& visit) {
  visit(table);
  for (const auto& key : table.keys) {
    if (key.child) forEachTable(*key.child, visit);
  }
}

TEST_P(EveryKey, SetsItsOwnFieldAndNoOther) {
  int set = 0;
  forEachTable(tableOf(GetParam()), [&](const Table& table) {
    for (const auto& key : table.keys) {
      if (!key.set || key.kind == rules::Kind::rules) continue;
      for (const auto& text : tests::goodTexts(key)) {
        Problems problems;
        const auto root = parseYaml(fmt::format("{{{}: {}}}", key.name, text), "f", problems);
        ASSERT_TRUE(root) << key.name << text;
        const auto datum = readDatum(root->entries[0].value, key, key.name, problems);
        ASSERT_TRUE(datum) << key.name << ": " << text << "\n" << format(problems.sorted());
        const auto target = table.make();
        key.set(target.get(), *datum);
        EXPECT_EQ(key.get(target.get()), *datum) << key.name << ": " << text;
        const auto fresh = table.make();
        for (const auto& other : table.keys) {
          if (!other.get || &other == &key) continue;
          EXPECT_EQ(other.get(target.get()), other.get(fresh.get())) << key.name << " changes " << other.name;
        }
        ++set;
      }
    }
  });
  EXPECT_GT(set, 60);
}

/// A curve may run over a sense, so only all of a rule set tells that there is none of that name.
TEST(EveryValue, RefusesCurvesOverWhatIsNotThere) {
  const tests::Scratch scratch;
  int tried = 0;
  tests::forEachKeyInPlace(
      rules::ruleTable(), "", [](const std::string& root) { return root; },
      [&](const std::string& path, const Key& key, const auto& wrap) {
        using rules::Kind;
        if (key.kind != Kind::value && key.kind != Kind::length && key.kind != Kind::size) return;
        ++tried;
        const auto shown = [&](const std::string& over) {
          const std::string curve = fmt::format("{{over: {}, points: [[0, 0.5], [1, 0.5]]}}", over);
          const std::string text = "{espalier: rules, " + wrap(curve).substr(1) + "\n";
          return format(readRulesOrScene(scratch.write("f.yaml", text)).problems());
        };
        EXPECT_NE(shown("x").find(".over is 'x'; expected exposure"), std::string::npos)
            << path << shown("x");
        EXPECT_EQ(shown("age").find(".over is"), std::string::npos) << path;
      });
  EXPECT_GE(tried, 15);
}

bool namesRuleSets(const Key& key) {
  return key.kind == rules::Kind::header || key.kind == rules::Kind::base || key.kind == rules::Kind::rules ||
         key.kind == rules::Kind::regions;
}

TEST_P(EveryKey, TakesGoodValuesAndRefusesBadOnes) {
  const auto& table = tableOf(GetParam());
  forEach([&](const std::string& path, const Key& key, const auto& wrap) {
    if (namesRuleSets(key)) return;
    const auto complaints = [&](const std::string& text) {
      Problems problems;
      Reading reading{problems};
      reading.special = [](const auto&...) {};
      const auto root = parseYaml(wrap(text), "f", problems);
      if (root) readTable(*root, table, table.make().get(), "", reading);
      return format(problems.sorted());
    };
    for (const auto& text : tests::goodTexts(key)) EXPECT_EQ(complaints(text), "") << path << ": " << text;
    for (const auto& text : tests::badTexts(key)) EXPECT_NE(complaints(text), "") << path << ": " << text;
  });
}

TEST_P(EveryKey, ThatNamesRuleSetsTakesFilesAndMappings) {
  const tests::Scratch scratch;
  scratch.write("other.yaml", "espalier: rules\n");
  const std::string plain =
      GetParam() == "rules" ? "" : "world: {voxel: 1, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\n";
  int seen = 0;
  forEach([&](const std::string& path, const Key& key, const auto&) {
    if (!namesRuleSets(key)) return;
    ++seen;
    const auto complaints = [&](const std::string& text) {
      std::string file = fmt::format("espalier: {}\n{}", GetParam(), plain);
      if (path == "espalier") {
        file = fmt::format("espalier: {}\n{}", text, plain);
      } else if (path == "plants[].rules") {
        file += fmt::format("plants: [{{seeds: [[0, 0, 0]], rules: {}}}]\n", text);
      } else {
        file += fmt::format("{}: {}\n", path, text);
      }
      return format(readRulesOrScene(scratch.write("f.yaml", file)).problems());
    };
    for (const auto& text : tests::goodTexts(key)) EXPECT_EQ(complaints(text), "") << path << ": " << text;
    for (const auto& text : tests::badTexts(key)) EXPECT_NE(complaints(text), "") << path << ": " << text;
  });
  EXPECT_GE(seen, 2);
}

INSTANTIATE_TEST_SUITE_P(Registries, EveryKey, testing::Values("rules", "scene"),
                         [](const auto& at) { return at.param; });

}  // namespace
}  // namespace espalier::scenes
