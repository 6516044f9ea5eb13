#include "scenes/read/read_rules.h"

#include "scenes/read/document.h"
#include "scenes/read/rule_loader.h"

namespace espalier::scenes {

Result<std::shared_ptr<const rules::RuleSet>> readRules(const std::filesystem::path& path) {
  Problems problems;
  const Document document = readDocument(path, FileKind::rules, problems);
  auto rules = document.root ? RuleLoader(problems).file(path, document) : nullptr;
  if (!problems.empty()) return problems.sorted();
  return rules;
}

}  // namespace espalier::scenes
