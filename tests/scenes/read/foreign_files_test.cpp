#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scenes/read/read_scene.h"
#include "tests/support/scratch.h"

/// Files that are no rule or scene files, and headers that say so.
namespace espalier::scenes {
namespace {

TEST(BadHeaders, AreRefused) {
  const tests::Scratch scratch;
  const auto shown = [&](const std::string& text) {
    return scratch.shown(readRulesOrScene(scratch.write("f.yaml", text)).problems());
  };
  const std::string none =
      "f.yaml:1:1: the file does not say what it is; expected 'espalier: rules' or 'espalier: scene' first";
  EXPECT_EQ(shown(""), "f.yaml:1:1: an empty file; expected 'espalier: rules' or 'espalier: scene' first");
  EXPECT_EQ(shown("# only words\n---\n"),
            "f.yaml:1:1: an empty file; expected 'espalier: rules' or 'espalier: scene' first");
  EXPECT_EQ(shown("name: x\n"), none);
  EXPECT_EQ(shown("espallier: rules\n"), none + "; did you mean 'espalier'?");
  EXPECT_EQ(shown("- espalier: rules\n"), none + "; did you mean 'espalier'?");
  EXPECT_EQ(shown("espalier\n"), none + "; did you mean 'espalier'?");
  EXPECT_EQ(shown("espalier: rule\n"),
            "f.yaml:1:11: espalier is 'rule'; expected rules or scene; did you mean 'rules'?");
  EXPECT_EQ(shown("espalier: rules/2\n"),
            "f.yaml:1:11: the version '2' of the language; expected rules/1, the only one that there is");
  EXPECT_EQ(shown("espalier: [rules]\n"), "f.yaml:1:11: espalier is a list; expected rules or scene");
  for (const char* good :
       {"espalier: rules/1\n", "name: x\nespalier: rules\n", "'espalier': rules", "  espalier: rules",
        "# a comment\n\n---\n\"espalier\" : rules\n", "{espalier: rules}", "{name: x, espalier: rules}",
        "{\n  name: x,\n  espalier: rules\n}\n",
        "\xEF\xBB\xBF"
        "espalier: rules\r\n"})
    EXPECT_EQ(shown(good), "") << good;
  EXPECT_EQ(
      shown(std::string(
                "espalier: scene/1\nworld: {resolution: 9, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\n") +
            "plants: [{rules: {}, seeds: [[0, 0, 0]]}]\n"),
      "");
}

/// Texts that nobody meant to show to whoever reads an error.
const std::vector<std::string> kForeign = {"root:x:0:0:root:/root:/bin/bash\nsecret:x:1:1::/:/bin/sh\n",
                                           "secret: [unclosed\n",
                                           "secret\n",
                                           "- secret\n",
                                           "a: 1\na: secret\nsecret: 2\n  b: 3\n",
                                           "\tsecret: 1\n",
                                           "secret \x01\xff\n",
                                           "services:\n  secret: 1\n  espalier: secret\n",
                                           "secret 12:03 espalier: stopped\n",
                                           "key: |\n  espalier: secret\n",
                                           "{secret: 1}\n",
                                           "%SECRET\nsecret: &secret *secret\n"};

TEST(ForeignFiles, AreNotRepeatedAndWhoAsksForThemIsNamed) {
  for (const std::string& text : kForeign) {
    const tests::Scratch scratch;
    const auto foreign = scratch.write("foreign", text).string();
    const auto expectSilence = [&](const std::string& shown, const std::string& place) {
      EXPECT_TRUE(shown.starts_with(place)) << shown << "\nof\n" << text;
      EXPECT_NE(shown.find("the file does not say what it is; expected 'espalier: rules'"), shown.npos)
          << shown;
      for (const char* word : {"secret", "SECRET", "root:", "0x", "U+00"})
        EXPECT_EQ(shown.find(word), shown.npos) << shown << "\nof\n" << text;
    };
    expectSilence(scratch.shown(readRulesOrScene(foreign).problems()), "foreign:1:1: the file");
    const auto asked = [&](const std::string& name, const std::string& file_text) {
      return scratch.shown(readRulesOrScene(scratch.write(name, file_text)).problems());
    };
    expectSilence(asked("r.yaml", "espalier: rules\nbase: foreign\n"), "r.yaml:2:7: foreign: the file");
    expectSilence(asked("r.yaml", "espalier: rules\notherwise: " + foreign + "\n"),
                  "r.yaml:2:12: foreign: the file");
    expectSilence(asked("r.yaml", "espalier: rules\nregions: {wall: ./foreign}\n"),
                  "r.yaml:2:17: foreign: the file");
    scratch.write("on.yaml", "espalier: rules\nname: on\nbase: foreign\n");
    expectSilence(asked("s.yaml",
                        "espalier: scene\nworld: {resolution: 9, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\n"
                        "plants: [{rules: on.yaml, seeds: [[0, 0, 0]]}]\n"),
                  "on.yaml:3:7: foreign: the file");
  }
}

TEST(ForeignFiles, MayHaveNamesOfAnyLength) {
  const tests::Scratch scratch;
  const std::string name(70'000, 'x');
  for (const std::string& rules :
       {"base: " + name, "otherwise: " + name, "regions: {wall: ./" + name + "}",
        "regions: {" + name + ": {lenght: 1}}", "regions: {" + name + ": {length: 1000000 km}}", name + ": 1",
        "propagate: " + name, "length: " + name}) {
    const auto problems =
        readRulesOrScene(scratch.write("r.yaml", "espalier: rules\n" + rules + "\n")).problems();
    ASSERT_FALSE(problems.empty()) << rules.substr(0, 20);
    for (const auto& problem : problems) {
      const auto line = scratch.shown({problem});
      EXPECT_TRUE(line.starts_with("r.yaml:2:")) << line;
      EXPECT_LT(line.size(), 1100u) << line;
    }
  }
}

}  // namespace
}  // namespace espalier::scenes
