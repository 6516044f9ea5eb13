#include "scenes/clean_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace espalier::scenes {
namespace {

TEST(Printable, LeavesWhatATerminalShowsAndEscapesWhatItObeys) {
  for (const char* good : {"", "plain text: 'a', \"b\" \\ c", "Gr\xc3\xbc\xc3\x9fung \xe2\x82\xac",
                           "\xf0\x9f\x8c\xbf", "\xd7\xa9\xd7\x9c\xd7\x95\xd7\x9d"})
    EXPECT_EQ(printable(good), good);
  EXPECT_EQ(printable("\x1b[31m\x07\b\x7f"), "\\x1b[31m\\x07\\x08\\x7f");
  EXPECT_EQ(printable("a\tb\r\nc"), "a\\tb\\r\\nc");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(printable("\xc2\x80\xc2\x85\xc2\x9b\xc2\x9f\xc2\xa0"), "\\u0080\\u0085\\u009b\\u009f\xc2\xa0");
  EXPECT_EQ(printable("\xd8\x9c\xe2\x80\x8e\xe2\x80\x8f"), "\\u061c\\u200e\\u200f");
  EXPECT_EQ(printable("\xe2\x80\xa8\xe2\x80\xa9\xe2\x80\xaa\xe2\x80\xae"), "\\u2028\\u2029\\u202a\\u202e");
  EXPECT_EQ(printable("\xe2\x81\xa5\xe2\x81\xa6\xe2\x81\xa9\xe2\x81\xaa"),
            "\xe2\x81\xa5\\u2066\\u2069\xe2\x81\xaa");
  EXPECT_EQ(printable("\x80\xff\xc2"), "\\x80\\xff\\xc2");
  EXPECT_EQ(printable("\xc0\x9b\xe0\x82\x9b"), "\\xc0\\x9b\\xe0\\x82\\x9b") << "overlong";
  EXPECT_EQ(printable("\xed\xa0\x80\xf4\x90\x80\x80"), "\\xed\\xa0\\x80\\xf4\\x90\\x80\\x80")
      << "no characters";
}

TEST(Shortened, KeepsBothEndsAndCutsNoCharacter) {
  EXPECT_EQ(shortened("abcdefghij", 10), "abcdefghij");
  EXPECT_EQ(shortened("abcdefghijk", 9), "abcd...jk");
  const std::string umlauts = "\xc3\xa4\xc3\xb6\xc3\xbc\xc3\x84\xc3\x96\xc3\x9c";
  EXPECT_EQ(shortened(umlauts + umlauts, 6), "\xc3\xa4\xc3\xb6...\xc3\x9c");
}

TEST(OneLine, IsNoLongerThanSomebodyReads) {
  const std::string path = "/" + std::string(5000, 'x') + "/scene.yaml:12:3:";
  const std::string line = oneLine(path + " there is no such key");
  EXPECT_LT(line.size(), 300u);
  EXPECT_TRUE(line.starts_with("/xxx")) << line;
  EXPECT_TRUE(line.ends_with("/scene.yaml:12:3: there is no such key")) << line;
  EXPECT_EQ(oneLine(line), line);
  const std::string file(255, 'n');
  EXPECT_EQ(oneLine("a " + file), "a " + file);

  std::string words;
  for (int i = 0; i < 5000; ++i) words += "\x1b word";
  EXPECT_EQ(oneLine(words).size(), 1024u);
  EXPECT_EQ(oneLine(oneLine(words)), oneLine(words));
  EXPECT_EQ(oneLine("two  spaces "), "two  spaces ");
}

TEST(PrintableJson, HasTheSameValues) {
  const nlohmann::json json = {
      {"na\xe2\x80\xaeme", "\x1b\x7f\xc2\x9b\xd8\x9c\xe2\x80\xa8\n\t\"\\ Gr\xc3\xbc\xc3\x9fung"}};
  const std::string shown = printableJson(json.dump(2));
  EXPECT_EQ(nlohmann::json::parse(shown), json);
  for (const char* obeyed : {"\x7f", "\xc2\x9b", "\xd8\x9c", "\xe2\x80"})
    EXPECT_EQ(shown.find(obeyed), std::string::npos) << shown;
  EXPECT_NE(shown.find("Gr\xc3\xbc\xc3\x9fung"), std::string::npos);
  EXPECT_NE(shown.find("\n  \"na\\u202eme\""), std::string::npos) << shown;
}

}  // namespace
}  // namespace espalier::scenes
