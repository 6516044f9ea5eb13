#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "scenes/read/read_scene.h"

namespace espalier::cli {

void addCheck(CLI::App& app, int& exit_status) {
  auto* const command =
      app.add_subcommand("check", "Name every error in rule and scene files; silent when all is well");
  const auto files = std::make_shared<std::vector<std::string>>();
  command->add_option("file", *files, "Rule and scene files")->required();
  command->callback([files, &exit_status] {
    for (const std::string& file : *files) {
      const auto problems = scenes::checkFile(file);
      if (problems.empty()) continue;
      fmt::print(stderr, "{}\n", scenes::format(problems));
      exit_status = kInputError;
    }
  });
}

}  // namespace espalier::cli
