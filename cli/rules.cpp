#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "cli/say.h"
#include "scenes/problem.h"
#include "scenes/read/rule_library.h"
#include "sim/base/error.h"

namespace espalier::cli {
namespace {

std::string list() {
  std::size_t widest = 0;
  for (const scenes::LibraryRules& rules : scenes::ruleLibrary())
    widest = std::max(widest, rules.name.size());
  std::string text;
  for (const scenes::LibraryRules& rules : scenes::ruleLibrary())
    text += fmt::format("{:{}}  {}\n", rules.name, widest, scenes::aboutOf(rules));
  return text;
}

}  // namespace

void addRules(CLI::App& app, int&) {
  auto* const command = app.add_subcommand(
      "rules", "List the rule sets of the library, which rule and scene files know by name, or print one");
  const auto name = std::make_shared<std::string>();
  command->add_option("name", *name, "One of them: its file is printed");
  command->callback([name] {
    if (name->empty()) return print(list());
    const std::string unknown = scenes::notCalled("rule set of the library", *name, scenes::libraryNames());
    if (!unknown.empty()) throw sim::InputError("espalier: " + unknown);
    print(scenes::libraryRules(*name)->text);
  });
}

}  // namespace espalier::cli
