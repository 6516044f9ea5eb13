#pragma once
#include <vector>

#include "rules/language/key.h"

/// The registry of the rule language: every key of a rule file stands here once, with its type, unit,
/// default, range, meaning and Greene's own name for it. The reader, the JSON Schema and the reference page
/// walk it.
///
/// To add a key: give the struct in rules/language/rule_set.h a field with its default, and add one line to
/// the table of that struct in rules/language/registry.cpp. Then run the scenes tests once with
/// ESPALIER_UPDATE_DOCS=1.
namespace espalier::rules {

/// The keys of a rule set; its struct is RuleSet.
const Table& ruleTable();
/// What must hold between them.
const std::vector<Check>& ruleChecks();
/// What is left to do when every key has been set: normalizes the blend of light.
void finish(RuleSet& rules);

}  // namespace espalier::rules
