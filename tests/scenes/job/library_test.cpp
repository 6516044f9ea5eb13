#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "rules/language/registry.h"
#include "scenes/read/json_schema.h"
#include "scenes/read/read_scene.h"
#include "scenes/read/reference.h"
#include "scenes/read/registry.h"
#include "tests/scenes/read/sample.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;

TEST(Library, HasNoProblems) {
  const auto files = tests::libraryFiles();
  EXPECT_GE(files.size(), 7u);
  for (const auto& file : files) EXPECT_EQ(format(readRulesOrScene(file).problems()), "");
}

/// The pages in docs/ are the registries' own words. ESPALIER_UPDATE_DOCS=1 writes them anew.
TEST(Reference, StandsInTheDocs) {
  for (const auto& [page, kind] :
       {std::pair{"docs/rule-reference.md", FileKind::rules}, {"docs/scene-reference.md", FileKind::scene}}) {
    const auto path = tests::sourceFolder() / page;
    if (std::getenv("ESPALIER_UPDATE_DOCS")) std::ofstream(path, std::ios::binary) << referenceFor(kind);
    EXPECT_TRUE(tests::fileText(path) == referenceFor(kind))
        << page
        << " is not what the registry says; run this test once with ESPALIER_UPDATE_DOCS=1 and commit the "
           "page";
  }
}

TEST(Readme, ShowsTheFirstRuleFileAsItIs) {
  const std::string readme = tests::fileText(tests::sourceFolder() / "README.md");
  EXPECT_NE(readme.find(tests::fileText(tests::sourceFolder() / "docs/first/vine.yaml")), std::string::npos);
}

TEST(Readme, ShowsTheLibrarysUserAsTheTestsBuildIt) {
  const std::string readme = tests::fileText(tests::sourceFolder() / "README.md");
  EXPECT_NE(readme.find(tests::fileText(tests::sourceFolder() / "tests/house/consumer/CMakeLists.txt")),
            std::string::npos);
  EXPECT_NE(readme.find(tests::fileText(tests::sourceFolder() / "tests/house/consumer/main.cpp")),
            std::string::npos);
}

/// Asks Python's jsonschema about YAML texts: true where a text is valid.
class Validator {
 public:
  explicit Validator(const tests::Scratch& scratch) : scratch_(scratch) {
    scratch_.write("validate.py", R"(import json, sys
import jsonschema, re, yaml
# PyYAML reads YAML 1.1, where -.5 is a text and yes is true; our files are YAML 1.2.
class Loader(yaml.SafeLoader):
    pass
Loader.yaml_implicit_resolvers = {}
def resolve(tag, pattern, first):
    Loader.add_implicit_resolver('tag:yaml.org,2002:' + tag, re.compile('^(?:' + pattern + ')$'), first)
resolve('null', '~|null|', ['~', 'n', ''])
resolve('bool', 'true|false', list('tf'))
resolve('int', '[-+]?[0-9]+', list('-+0123456789'))
resolve('float', r'[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?', list('-+.0123456789'))
schema = json.load(open(sys.argv[1]))
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
for text in json.load(open(sys.argv[2])):
    print(int(validator.is_valid(yaml.load(text, Loader))))
)");
  }

  static bool isThere() {
    return std::system(
               "/usr/bin/python3 -c 'import jsonschema, yaml; jsonschema.Draft202012Validator' >/dev/null "
               "2>&1") == 0;
  }

  std::vector<bool> areValid(FileKind kind, const std::vector<std::string>& texts) const {
    const auto schema = scratch_.write("schema.json", schemaFor(kind));
    const auto file = scratch_.write("texts.json", nlohmann::json(texts).dump());
    const auto verdicts = scratch_.path("verdicts");
    const auto command =
        fmt::format("/usr/bin/python3 '{}' '{}' '{}' >'{}'", scratch_.path("validate.py").string(),
                    schema.string(), file.string(), verdicts.string());
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::vector<bool> valid;
    for (const char c : tests::fileText(verdicts)) {
      if (c != '\n') valid.push_back(c == '1');
    }
    EXPECT_EQ(valid.size(), texts.size());
    valid.resize(texts.size());
    return valid;
  }

 private:
  const tests::Scratch& scratch_;
};

class Schema : public testing::Test {
 protected:
  void SetUp() override {
    if (!Validator::isThere()) GTEST_SKIP() << "python3-jsonschema and python3-yaml are not installed";
  }
};

TEST_F(Schema, AcceptsTheWholeLibrary) {
  const tests::Scratch scratch;
  const Validator validator(scratch);
  for (const auto& [kind, folder] : {std::pair{FileKind::rules, "rules"}, {FileKind::scene, "scenes"}}) {
    std::vector<std::string> texts;
    std::vector<fs::path> files;
    for (const auto& file : tests::libraryFiles()) {
      if (file.parent_path().parent_path().filename() != folder) continue;
      files.push_back(file);
      texts.push_back(tests::fileText(file));
    }
    ASSERT_FALSE(texts.empty());
    const auto valid = validator.areValid(kind, texts);
    for (std::size_t i = 0; i < files.size(); ++i) EXPECT_TRUE(valid[i]) << files[i];
  }
}

TEST_F(Schema, RefusesBrokenFiles) {
  const tests::Scratch scratch;
  const Validator validator(scratch);
  const std::vector<std::string> rules{"name: x\n",
                                       "espalier: scene\n",
                                       "espalier: rules\nbiass: {}\n",
                                       "espalier: rules\nbias: {up: 2}\n",
                                       "espalier: rules\nrandom_tree: {length: 2 inches}\n",
                                       "espalier: rules\nelements: [{name: leaf}]\n",
                                       "espalier: rules\nstem: {colour: green}\n",
                                       "espalier: rules\nregions: {wall: {bias: {upp: 1}}}\n"};
  const auto valid = validator.areValid(FileKind::rules, rules);
  for (std::size_t i = 0; i < rules.size(); ++i) EXPECT_FALSE(valid[i]) << rules[i];
  const std::vector<std::string> scenes{"espalier: scene\n", "espalier: scene\nworld: {voxel: 0}\n",
                                        "espalier: scene\nworld: {}\nimages: [vine]\n",
                                        "espalier: scene\nworld: {}\nplants: [{seeds: []}]\n",
                                        "espalier: scene\nworld: {}\ncameras: [main]\n"};
  const auto valid_scenes = validator.areValid(FileKind::scene, scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) EXPECT_FALSE(valid_scenes[i]) << scenes[i];
}

/// The schema and the reader are two derivations of one registry: they must agree on every key.
TEST_F(Schema, AgreesWithTheReaderOnEveryKey) {
  const tests::Scratch scratch;
  const Validator validator(scratch);
  for (const auto kind : {FileKind::rules, FileKind::scene}) {
    const bool is_rules = kind == FileKind::rules;
    std::vector<std::string> texts;
    std::size_t good = 0;
    const auto gather = [&](const auto& samples, bool all) {
      tests::forEachKeyInPlace(
          is_rules ? rules::ruleTable() : sceneTable(), "", [](const std::string& root) { return root; },
          [&](const std::string&, const rules::Key& key, const auto& wrap) {
            if (key.kind == rules::Kind::header) return;
            for (const auto& text : samples(key)) {
              // What only a reader can know: what files hold, and which of two numbers is greater.
              const bool beyond = text == "none.yaml" || text == "x" || text.find("forbiden") != text.npos ||
                                  text == "[5, 4]" || text == "[0.5, 0.25]" || text == "[4 mm, 3 mm]" ||
                                  text == "[1 vx, 1 m]" || text == "[1, 1 m]" || text == "-1 cm" ||
                                  text == "true" || text == "007" || text == "0x1" ||
                                  (text == "yes" && key.kind == rules::Kind::flag);
              if (!all && beyond) continue;
              texts.push_back(
                  fmt::format("{{espalier: {}, {}", is_rules ? "rules" : "scene", wrap(text).substr(1)));
            }
          });
    };
    gather([](const auto& key) { return tests::goodTexts(key); }, true);
    good = texts.size();
    gather([](const auto& key) { return tests::badTexts(key); }, false);
    const auto valid = validator.areValid(kind, texts);
    for (std::size_t i = 0; i < texts.size(); ++i) EXPECT_EQ(valid[i], i < good) << texts[i];
    EXPECT_GT(texts.size() - good, 150u);
  }
}

}  // namespace
}  // namespace espalier::scenes
