#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "rules/language/registry.h"
#include "scenes/read/document.h"
#include "scenes/read/read_rules.h"
#include "scenes/read/read_scene.h"
#include "scenes/read/read_table.h"
#include "scenes/read/registry.h"
#include "scenes/read/settings.h"
#include "tests/support/scratch.h"

/// Files of version 1 of the language are read for ever, and mean what they meant (version_1/README.md).
namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> filesOfVersion1() {
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::recursive_directory_iterator(tests::sourceFolder() / "tests/scenes/read/version_1")) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::shared_ptr<const YamlNode> rootOf(const fs::path& file) {
  Problems problems;
  return readDocument(file, std::nullopt, problems).root;
}

FileKind kindOf(const YamlNode& root) {
  Problems problems;
  return headerOf(root, problems).value();
}

std::string whatIsRead(const fs::path& file) {
  if (kindOf(*rootOf(file)) == FileKind::scene) {
    const auto scene = readScene(file);
    EXPECT_TRUE(scene) << format(scene.problems());
    return scene ? format(settings(*scene)) : "";
  }
  const auto rules = readRules(file);
  EXPECT_TRUE(rules) << format(rules.problems());
  return rules ? format(settings(**rules)) : "";
}

std::set<std::string> linesOf(const std::string& text) {
  std::set<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.insert(line);
  return lines;
}

/// What was read, and beside it the lines as they were before a key became a mapping in which it has a name:
/// "wander.angle: 20" was "wander: 20", and a file may go on to say so.
std::set<std::string> withBriefs(std::set<std::string> lines) {
  std::set<std::string> names;  // such as ".wander.angle: "
  for (const rules::Table* table : {&rules::ruleTable(), &sceneTable()}) {
    forEachKey(*table, [&](const std::string&, const rules::Key& key) {
      if (key.kind == rules::Kind::section && !key.shorthand.empty())
        names.insert("." + key.name + "." + key.shorthand + ": ");
    });
  }
  std::set<std::string> all = lines;
  for (const std::string& line : lines) {
    const std::size_t value = line.find(": "), last = line.rfind('.', value);
    if (value == line.npos || last == line.npos || last == 0) continue;
    const std::size_t before = line.rfind('.', last - 1);
    if (before != line.npos && names.contains(line.substr(before, value + 2 - before)))
      all.insert(line.substr(0, last) + line.substr(value));
  }
  return all;
}

class Version1 : public testing::TestWithParam<fs::path> {};

TEST_P(Version1, IsReadAsItWasRead) {
  const auto read = whatIsRead(GetParam());
  const auto kept = fs::path(GetParam()).replace_extension(".txt");
  if (std::getenv("ESPALIER_UPDATE_DOCS") && !fs::exists(kept)) std::ofstream(kept, std::ios::binary) << read;
  ASSERT_TRUE(fs::exists(kept)) << "run this test once with ESPALIER_UPDATE_DOCS=1 and commit " << kept;
  const auto now = withBriefs(linesOf(read));
  const auto then = linesOf(tests::fileText(kept));
  EXPECT_GT(then.size(), 25u);
  for (const auto& line : then)
    EXPECT_TRUE(now.contains(line)) << "no longer read from " << GetParam() << ": " << line;
}

INSTANTIATE_TEST_SUITE_P(Files, Version1, testing::ValuesIn(filesOfVersion1()),
                         [](const auto& at) { return at.param.stem().string(); });

/// Notes every key that stands in files, by its path in the registry, and every choice made there.
class Used {
 public:
  void noteMapping(const YamlNode& map, const rules::Table& table, const std::string& prefix) {
    for (const auto& entry : map.entries) {
      if (const auto* key = rules::find(table, entry.key)) note(entry.value, *key, prefix + key->name);
    }
  }
  bool has(const std::string& path) const { return paths_.contains(path); }

 private:
  void note(const YamlNode& node, const rules::Key& key, const std::string& path) {
    paths_.insert(path);
    if (key.kind == rules::Kind::choice) paths_.insert(path + ": " + node.text);
    if (key.kind == rules::Kind::section) noteOne(node, key, path + ".");
    for (const auto& item : node.items) {
      if (key.kind == rules::Kind::entries) noteOne(item, key, path + "[].");
    }
    for (const auto& item : node.entries) {
      if (key.kind == rules::Kind::named) noteOne(item.value, key, path + ".<name>.");
    }
  }
  void noteOne(const YamlNode& node, const rules::Key& key, const std::string& prefix) {
    const auto* brief = rules::briefOf(key);
    if (node.kind == YamlNode::Kind::map) return noteMapping(node, *key.child, prefix);
    if (brief) note(node, *brief, prefix + brief->name);
  }

  std::set<std::string> paths_;
};

TEST(Version1Files, UseEveryKeyAndEveryChoice) {
  Used in_rules, in_scenes;
  for (const auto& file : filesOfVersion1()) {
    const auto root = rootOf(file);
    if (kindOf(*root) == FileKind::rules) {
      in_rules.noteMapping(*root, rules::ruleTable(), "");
    } else {
      in_scenes.noteMapping(*root, sceneTable(), "");
    }
  }
  const auto expectAll = [](const rules::Table& table, const Used& used) {
    forEachKey(table, [&](const std::string& path, const rules::Key& key) {
      EXPECT_TRUE(used.has(path)) << path << " stands in no file of tests/scenes/read/version_1; add one";
      for (const auto& choice : key.choices)
        EXPECT_TRUE(used.has(path + ": " + choice))
            << path << ": " << choice << " stands in no file of tests/scenes/read/version_1; add one";
    });
  };
  expectAll(rules::ruleTable(), in_rules);
  expectAll(sceneTable(), in_scenes);
}

}  // namespace
}  // namespace espalier::scenes
