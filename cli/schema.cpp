#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>

#include "cli/commands.h"
#include "cli/say.h"
#include "cli/values.h"
#include "scenes/read/json_schema.h"

namespace espalier::cli {

void addSchema(CLI::App& app, int&) {
  auto* const command =
      app.add_subcommand("schema", "Print the JSON Schema of rule or scene files, for editors");
  rules::Key key;
  key.kind = rules::Kind::choice;
  key.choices = {"rules", "scene"};
  const auto kind = std::make_shared<std::string>();
  addChoice(
      *command, "kind", key, [kind](const std::string& word) { *kind = word; }, "rules or scene")
      ->required();
  command->callback([kind] {
    printJson(scenes::schemaFor(*kind == "rules" ? scenes::FileKind::rules : scenes::FileKind::scene));
  });
}

}  // namespace espalier::cli
