#include "rules/language/rule_set.h"

namespace espalier::rules {

const RegionRule* ruleFor(const RuleSet& rules, std::string_view region) {
  const auto named = rules.regions.find(region);
  if (named != rules.regions.end()) return &named->second;
  return rules.others ? &*rules.others : nullptr;
}

}  // namespace espalier::rules
