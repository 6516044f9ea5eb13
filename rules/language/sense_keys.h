#pragma once
#include <memory>

#include "rules/language/key.h"
#include "rules/language/rule_set.h"

/// What a rule set senses around a place, and the keys that make use of it.
namespace espalier::rules {

std::shared_ptr<const Table> senseKeys();
/// Of bias.senses, of require.senses and require.along, and of prefer.senses.
std::shared_ptr<const Table> senseBiasKeys();
std::shared_ptr<const Table> senseBoundsKeys();
std::shared_ptr<const Table> sensePreferenceKeys();

/// Complains of what asks for a sense that the rule set has not, and of senses that cannot be.
void checkSenses(const RuleSet& rules, const Check::Given& given, const Check::Complain& complain);

}  // namespace espalier::rules
