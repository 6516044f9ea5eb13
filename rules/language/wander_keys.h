#pragma once
#include <memory>

#include "rules/language/key.h"

namespace espalier::rules {

/// The keys of random_tree.wander, which describe a RandomTree.
std::shared_ptr<const Table> wanderKeys();

/// A file says one distribution, and a table draws something.
void checkWander(const RuleSet& rules, const Check::Given& given, const Check::Complain& complain);

}  // namespace espalier::rules
