#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>

#include "cli/commands.h"
#include "cli/doing.h"
#include "cli/job_options.h"
#include "scenes/read/read_scene.h"

namespace espalier::cli {

void addCheck(CLI::App& app, int& exit_status) {
  auto* const command =
      app.add_subcommand("check", "Name every error in rule and scene files; silent when all is well");
  const auto files = std::make_shared<std::vector<std::string>>();
  command->add_option("file", *files, "Rule and scene files")->required();
  command->callback([files, &exit_status] {
    for (const std::string& file : *files) {
      const auto problems = doing(file, "checking", [&] { return scenes::checkFile(file); });
      if (!problems.empty()) exit_status = sayProblems(problems);
    }
  });
}

}  // namespace espalier::cli
