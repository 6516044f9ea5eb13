#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>

#include "cli/commands.h"
#include "cli/say.h"
#include "scenes/read/explain.h"

namespace espalier::cli {

void addExplain(CLI::App& app, int&) {
  auto* const command = app.add_subcommand(
      "explain", "Say what a key of rule or scene files does, what it may be and where it stands");
  const auto key = std::make_shared<std::string>();
  command->add_option("key", *key, "Its name, such as voxel, or its path, such as bias.up")->required();
  command->callback([key] { print(scenes::explainKey(*key)); });
}

}  // namespace espalier::cli
