#pragma once
#include <functional>
#include <string>

#include "rules/language/rule_set.h"

namespace espalier::rules {

/// Calls visit(path, value) for every number of a rule set that may be a range or a curve, such as
/// "bias.senses.crowd.amount"; not those of other sets that it leads to.
void forEachValue(const RuleSet& rules,
                  const std::function<void(const std::string& path, const Value& value)>& visit);

}  // namespace espalier::rules
