#include "rules/language/rule_set.h"

#include <algorithm>

namespace espalier::rules {

const SenseSpec& senseNamed(const RuleSet& rules, std::string_view name) {
  return *std::find_if(rules.senses.begin(), rules.senses.end(),
                       [&](const SenseSpec& sense) { return sense.name == name; });
}

const RegionRule* ruleFor(const RuleSet& rules, std::string_view region) {
  const auto named = rules.regions.find(region);
  if (named != rules.regions.end()) return &named->second;
  return rules.others ? &*rules.others : nullptr;
}

}  // namespace espalier::rules
