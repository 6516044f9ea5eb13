#include "rules/language/rule_set.h"

#include <gtest/gtest.h>

namespace espalier::rules {
namespace {

TEST(RuleFor, FindsTheNamedRegionElseTheOthersElseNothing) {
  RuleSet rules;
  EXPECT_EQ(ruleFor(rules, "wall"), nullptr);
  rules.regions["wall"] = {};
  EXPECT_EQ(ruleFor(rules, "wall"), &rules.regions.at("wall"));
  EXPECT_EQ(ruleFor(rules, "roof"), nullptr);
  rules.others = RegionRule{true, nullptr};
  EXPECT_EQ(ruleFor(rules, "wall"), &rules.regions.at("wall")) << "a name goes before the others";
  EXPECT_EQ(ruleFor(rules, "roof"), &*rules.others);
  EXPECT_EQ(ruleFor(rules, ""), &*rules.others) << "a mesh's region may be without a name";
}

}  // namespace
}  // namespace espalier::rules
