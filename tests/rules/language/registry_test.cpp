#include "rules/language/registry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "rules/language/colour.h"

namespace espalier::rules {
namespace {

void forEach(const Table& table, const std::string& prefix,
             const std::function<void(const std::string&, const Key&)>& visit) {
  for (const auto& key : table.keys) {
    visit(prefix + key.name, key);
    if (key.child) forEach(*key.child, prefix + key.name + ".", visit);
  }
}

TEST(Registry, SaysOfEveryKeyWhatItMeansInOneLine) {
  std::set<std::string> paths;
  forEach(ruleTable(), "", [&](const std::string& path, const Key& key) {
    EXPECT_TRUE(paths.insert(path).second) << path;
    EXPECT_GT(key.meaning.size(), 10u) << path;
    EXPECT_LT(key.meaning.size(), 120u) << path;
    EXPECT_EQ(key.meaning.back(), '.') << path;
    EXPECT_EQ(key.meaning.find_first_of("|\n"), key.meaning.npos)
        << path << ": it stands in a Markdown table";
    EXPECT_EQ(key.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), key.name.npos) << path;
  });
  EXPECT_GT(paths.size(), 40u);
}

TEST(Registry, StatesUnitAndRangeOfEveryNumber) {
  forEach(ruleTable(), "", [&](const std::string& path, const Key& key) {
    const bool number = key.kind == Kind::whole || key.kind == Kind::whole_range ||
                        key.kind == Kind::number || key.kind == Kind::value || key.kind == Kind::length ||
                        key.kind == Kind::metres || key.kind == Kind::distance || key.kind == Kind::size;
    if (!number) return;
    EXPECT_FALSE(key.unit.empty()) << path;
    EXPECT_TRUE(std::isfinite(key.limits.min) && std::isfinite(key.limits.max)) << path;
    EXPECT_LT(key.limits.min, key.limits.max) << path;
    if (const auto* number_default = std::get_if<double>(&key.default_value);
        number_default && std::isfinite(*number_default)) {
      EXPECT_TRUE(within(key.limits, *number_default)) << path;
    }
  });
}

TEST(Registry, HasEveryNameOfGreenesFigure4) {
  std::set<std::string> known;
  forEach(ruleTable(), "", [&](const std::string&, const Key& key) { known.insert(key.greene); });
  for (const char* name :
       {"length", "branch_age_range", "branch_angle", "vertical_bias", "no_of_trials_max", "no_of_trials_min",
        "seekprox", "maxprox", "exposure min", "exposure max", "boost", "number_of_trials",
        "expected_frequency", "seeksun_bias", "blend sun=", "blend sky="}) {
    EXPECT_TRUE(known.contains(name)) << name;
  }
}

TEST(Registry, TakesDefaultsFromTheStructItself) {
  const RuleSet rules;
  const auto* tree = find(ruleTable(), "random_tree");
  ASSERT_NE(tree, nullptr);
  EXPECT_EQ(find(*tree->child, "length")->default_value, Datum{rules.random_tree.length});
  EXPECT_EQ(find(*find(*tree->child, "trials")->child, "max")->default_value,
            Datum{std::int64_t{rules.random_tree.trials_max}});
  EXPECT_EQ(find(*find(ruleTable(), "prefer")->child, "proximity")->default_value, Datum{});
}

TEST(Registry, NormalizesTheBlendOfLight) {
  RuleSet rules;
  rules.light = {.sun = 0.2, .sky = 0.6, .boost = 1.0};
  finish(rules);
  EXPECT_DOUBLE_EQ(rules.light.sun, 0.25);
  EXPECT_DOUBLE_EQ(rules.light.sky, 0.75);
}

TEST(Ranges, AreSaidInWords) {
  EXPECT_EQ(rangeText({}), "");
  EXPECT_EQ(rangeText({0, 1}), "0 to 1");
  EXPECT_EQ(rangeText({0, 5, true}), "more than 0, at most 5");
  EXPECT_EQ(rangeText({.min = 2}), "2 or more");
  EXPECT_EQ(rangeText({.max = 2}), "at most 2");
}

TEST(Ranges, KnowTheirEnds) {
  EXPECT_TRUE(within({0, 1}, 0));
  EXPECT_TRUE(within({0, 1}, 1));
  EXPECT_FALSE(within({0, 1}, 1.0000001));
  EXPECT_FALSE(within({0, 1, true}, 0));
}

TEST(Colours, GoBetweenSrgbAndLinear) {
  EXPECT_EQ(linearFromSrgb({0, 0, 0}), sim::Colour(0, 0, 0));
  EXPECT_NEAR(linearFromSrgb({1, 1, 1}).r, 1.0f, 1e-6f);
  EXPECT_NEAR(linearFromSrgb({0.5f, 0, 0}).r, 0.21404f, 1e-5f);  // IEC 61966-2-1
  for (int byte = 0; byte < 256; ++byte) {
    const float s = static_cast<float>(byte) / 255.0f;
    EXPECT_NEAR(srgbFromLinear(linearFromSrgb({s, s, s})).g, s, 1e-5f);
  }
  EXPECT_EQ(hexFromLinear(linearFromSrgb({0x4f / 255.0f, 0x7a / 255.0f, 0x2c / 255.0f})), "#4f7a2c");
}

}  // namespace
}  // namespace espalier::rules
