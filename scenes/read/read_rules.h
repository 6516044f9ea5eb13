#pragma once
#include <filesystem>
#include <memory>

#include "rules/language/rule_set.h"
#include "scenes/problem.h"

namespace espalier::scenes {

/// Reads a rule file and the rule files that it names (base, otherwise, regions): a rule set, or every
/// problem in all of those files.
Result<std::shared_ptr<const rules::RuleSet>> readRules(const std::filesystem::path& path);

}  // namespace espalier::scenes
