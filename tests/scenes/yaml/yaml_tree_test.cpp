#include "scenes/yaml/yaml_tree.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "scenes/yaml/yaml_text.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

using tests::Scratch;

std::string problemsOf(const std::string& text) {
  Problems problems;
  parseYaml(text, "f.yaml", problems);
  return format(problems.sorted());
}

TEST(Tree, KeepsTextsQuotesAndPlaces) {
  Problems problems;
  const auto root = parseYaml("a: 1\nb: [x, \"y\"]\nc:\n  d: 'it''s'\n", "f.yaml", problems);
  ASSERT_TRUE(root);
  EXPECT_TRUE(problems.empty());
  ASSERT_EQ(root->entries.size(), 3u);
  EXPECT_EQ(root->entry("a")->value.text, "1");
  EXPECT_FALSE(root->entry("b")->value.items[0].quoted);
  EXPECT_TRUE(root->entry("b")->value.items[1].quoted);
  EXPECT_EQ(root->entry("b")->value.items[1].place.line, 2);
  EXPECT_EQ(root->entry("b")->value.items[1].place.column, 8);
  EXPECT_EQ(root->entry("c")->value.entry("d")->value.text, "it's");
  EXPECT_EQ(root->entry("nothing"), nullptr);
}

TEST(Tree, CountsColumnsInCharacters) {
  Problems problems;
  const auto root = parseYaml("\xC3\xA9: \"\xC3\xBC\"\n{x: 1}: 2", "f.yaml", problems);
  EXPECT_EQ(format(problems.sorted()).substr(0, 12), "f.yaml:2:1: ");
  EXPECT_EQ(root->entry("\xC3\xA9")->value.place.column, 4);
}

TEST(Tree, TakesCarriageReturnsAndAByteOrderMark) {
  const Scratch scratch;
  Problems problems;
  const auto path = scratch
                        .write("f.yaml",
                               "\xEF\xBB\xBF"
                               "a: \"x\"\r\nb: 2\r\n")
                        .string();
  const auto text = readText(path, {std::make_shared<const std::string>(path), 0, 0}, problems);
  const auto root = parseYaml(*text, path, problems);
  EXPECT_EQ(format(problems.sorted()), "");
  EXPECT_EQ(root->entry("a")->value.text, "x");
  EXPECT_EQ(root->entry("b")->value.place.line, 2);
  EXPECT_EQ(root->entry("b")->value.place.column, 4);
}

TEST(Tree, NamesBothPlacesOfARepeatedKey) {
  EXPECT_EQ(problemsOf("a: 1\nb:\n  c: 1\n  d: 2\n  c: 3\n"),
            "f.yaml:5:3: the key 'c' stands here again, after line 3 column 3; expected each key once");
}

TEST(Tree, RefusesAnAliasBombAtOnce) {
  std::string bomb = "a0: &a0 [x, x]\n";
  for (int i = 1; i < 60; ++i) bomb += fmt::format("a{0}: &a{0} [*a{1}, *a{1}]\n", i, i - 1);
  EXPECT_NE(problemsOf(bomb).find("f.yaml:1:5: an anchor"), std::string::npos)
      << problemsOf(bomb).substr(0, 200);
  EXPECT_NE(problemsOf("a: &a [*a]\n").find("an alias"), std::string::npos);
}

TEST(Tree, AllowsSixtyFourLevels) {
  const auto nested = [](std::size_t levels) {
    return fmt::format("a: {}{}\n", std::string(levels, '['), std::string(levels, ']'));
  };
  EXPECT_EQ(problemsOf(nested(63)), "");
  EXPECT_EQ(problemsOf(nested(64)),
            "f.yaml:1:67: lists and mappings nested too deep; expected at most 64 levels");
  EXPECT_NE(problemsOf(nested(400'000)), "");
}

TEST(Tree, LimitsTheNumberOfValues) {
  std::string many = "a: [";
  for (std::size_t i = 0; i < kMaxNodes; ++i) many += "1,";
  EXPECT_NE(problemsOf(many + "]\n").find("too many values; expected at most 200000"), std::string::npos);
}

TEST(Text, MustBeARegularFile) {
  const Scratch scratch;
  const auto refusal = [&](const std::string& path) {
    Problems problems;
    EXPECT_EQ(readText(path, {std::make_shared<const std::string>(path), 0, 0}, problems), std::nullopt);
    return scratch.shown(problems.sorted());
  };
  EXPECT_EQ(refusal(scratch.path("none").string()),
            "none: cannot be opened (No such file or directory); expected a readable file");
  EXPECT_NE(refusal(scratch.path("").string()).find("is no regular file"), std::string::npos);
  ASSERT_EQ(mkfifo(scratch.path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(refusal(scratch.path("pipe").string()), "pipe: is no regular file; expected a text file");
  EXPECT_EQ(refusal("/dev/zero"), "/dev/zero: is no regular file; expected a text file");
  EXPECT_EQ(refusal(scratch.write("big", std::string(kMaxTextBytes + 1, ' ')).string()),
            "big: is too large; expected at most 1000000 bytes");
}

TEST(Text, MustBePlainUtf8) {
  const auto first = [](const std::string& text) {
    return problemsOf(text).substr(0, problemsOf(text).find(';'));
  };
  EXPECT_EQ(first("a: \xff\n"), "f.yaml:1:4: byte 0xff is no UTF-8");
  EXPECT_EQ(first("a: 1\nb: \xC3\n"), "f.yaml:2:4: byte 0xc3 is no UTF-8");
  EXPECT_EQ(first("a: \xED\xA0\x80\n"), "f.yaml:1:4: byte 0xed is no UTF-8");  // a lone surrogate
  EXPECT_EQ(first("a: \xC0\xAF\n"), "f.yaml:1:4: byte 0xc0 is no UTF-8");      // an overlong slash
  EXPECT_EQ(first("\xC3\xA9: \x01\n"), "f.yaml:1:4: the control character U+0001");
  EXPECT_EQ(first(std::string("a: \0\n", 5)), "f.yaml:1:4: the control character U+0000");
  EXPECT_EQ(first("a: 1\rb: 2\n"), "f.yaml:1:5: the control character U+000D");
  EXPECT_EQ(first("\xFF\xFE"
                  "a\0"),
            "f.yaml:1:1: byte 0xff is no UTF-8");  // UTF-16
}

TEST(Nearness, FindsTheKeyThatWasMeant) {
  const std::vector<std::string> keys{"length", "branch_angle", "colour", "up"};
  EXPECT_EQ(didYouMean("lenght", keys), "; did you mean 'length'?");
  EXPECT_EQ(didYouMean("Length", keys), "; did you mean 'length'?");
  EXPECT_EQ(didYouMean("branchangle", keys), "; did you mean 'branch_angle'?");
  EXPECT_EQ(didYouMean("color", keys), "; did you mean 'colour'?");
  EXPECT_EQ(didYouMean("ups", keys), "; did you mean 'up'?");
  EXPECT_EQ(didYouMean("weather", keys), "");
  EXPECT_EQ(didYouMean("", keys), "");
  EXPECT_EQ(didYouMean(std::string(100'000, 'x'), keys), "");
}

}  // namespace
}  // namespace espalier::scenes
