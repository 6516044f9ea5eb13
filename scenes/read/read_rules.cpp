#include "scenes/read/read_rules.h"

#include "scenes/read/rule_loader.h"

namespace espalier::scenes {

Result<std::shared_ptr<const rules::RuleSet>> readRules(const std::filesystem::path& path) {
  Problems problems;
  RuleLoader loader(problems);
  auto rules = loader.file(path, {std::make_shared<const std::string>(path.string()), 0, 0});
  if (!problems.empty()) return problems.sorted();
  return rules;
}

}  // namespace espalier::scenes
