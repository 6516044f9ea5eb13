#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>

#include "cli/commands.h"
#include "scenes/read/json_schema.h"

namespace espalier::cli {

void addSchema(CLI::App& app, int&) {
  auto* const command =
      app.add_subcommand("schema", "Print the JSON Schema of rule or scene files, for editors");
  const auto kind = std::make_shared<std::string>();
  command->add_option("kind", *kind, "rules or scene")->required()->check(CLI::IsMember({"rules", "scene"}));
  command->callback([kind] {
    fmt::print("{}", scenes::schemaFor(*kind == "rules" ? scenes::FileKind::rules : scenes::FileKind::scene));
  });
}

}  // namespace espalier::cli
