#include "scenes/yaml/yaml_number.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>

namespace espalier::scenes {
namespace {

std::string wrong;

TEST(Numbers, AreDecimal) {
  EXPECT_EQ(parseNumber("2.4", wrong), 2.4);
  EXPECT_EQ(parseNumber(".32", wrong), .32);
  EXPECT_EQ(parseNumber("-.23", wrong), -.23);
  EXPECT_EQ(parseNumber("+5", wrong), 5.0);
  EXPECT_EQ(parseNumber("5.", wrong), 5.0);
  EXPECT_EQ(parseNumber("1e3", wrong), 1000.0);
  EXPECT_EQ(parseNumber("1.5E-2", wrong), 0.015);
  EXPECT_EQ(parseNumber("0.5", wrong), 0.5);
  EXPECT_FALSE(std::signbit(*parseNumber("-0", wrong)));
}

TEST(Numbers, AreNothingElse) {
  for (const char* text :
       {"",     "-",     "+",        ".",        "e3",    "1e",     "1e+",    "0x10", "0o17",
        "0b1",  "1_000", "1,5",      "1 000",    "2.4.1", "--1",    "+-1",    ".nan", "nan",
        ".inf", "inf",   "-.inf",    "infinity", "1e400", "1e-400", "2.4 vx", "2.4f", "ten",
        " 1",   "1 ",    "\xd9\xa3", "010",      "-010",  "00",     "01.5"}) {
    wrong.clear();
    EXPECT_EQ(parseNumber(text, wrong), std::nullopt) << text;
    EXPECT_FALSE(wrong.empty()) << text;
  }
}

TEST(Numbers, DoNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(parseNumber("2.5", wrong), 2.5);
  std::setlocale(LC_ALL, before.c_str());
}

TEST(WholeNumbers, AreWhole) {
  EXPECT_EQ(parseWhole("0", wrong), 0);
  EXPECT_EQ(parseWhole("-17", wrong), -17);
  EXPECT_EQ(parseWhole("9007199254740991", wrong), 9007199254740991);
  for (const char* text : {"1.0", "1.5", "1e3", "010", "99999999999999999999", "yes", ""})
    EXPECT_EQ(parseWhole(text, wrong), std::nullopt) << text;
}

TEST(Lengths, HaveUnits) {
  using Unit = WrittenLength::Unit;
  const auto is = [](std::string_view text, double number, Unit unit) {
    const auto read = parseLength(text, wrong);
    ASSERT_TRUE(read) << text;
    EXPECT_EQ(read->number, number) << text;
    EXPECT_EQ(read->unit, unit) << text;
  };
  is("2.4", 2.4, Unit::none);
  is("2.4 vx", 2.4, Unit::voxels);
  is("12 cm", 0.12, Unit::metres);
  is("4cm", 0.04, Unit::metres);
  is("0.12 m", 0.12, Unit::metres);
  is("120 mm", 0.12, Unit::metres);
  is("-.5 m", -0.5, Unit::metres);
  is("1e2 mm", 0.1, Unit::metres);
  for (const char* text : {"", "cm", "12 inches", "12 CM", "12 c m", "12 cm cm", "1,2 m", "12 ", "0x1 m",
                           "010 cm", "12\tcm", "m 12", "1 2 cm"}) {
    wrong.clear();
    EXPECT_EQ(parseLength(text, wrong), std::nullopt) << text;
    EXPECT_FALSE(wrong.empty()) << text;
  }
}

}  // namespace
}  // namespace espalier::scenes
