#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>

#include "cli/commands.h"
#include "cli/doing.h"
#include "cli/interrupt.h"
#include "cli/job_options.h"
#include "cli/say.h"
#include "scenes/job/expose.h"
#include "scenes/job/run.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"

namespace espalier::cli {

namespace {

/// Says what a scene's job will take: to grow its plants, or else to find its light.
int foretell(const scenes::Scene& scene, const scenes::RunOptions& options) {
  try {
    const scenes::Foretold foretold =
        scene.plants.empty() ? scenes::foretellExpose(scene, options) : scenes::foretellRun(scene, options);
    print(fmt::format("{}: {}\n", scene.file.string(), scenes::toText(foretold)));
  } catch (const scenes::MeshMissing& missing) {
    saySkipped(missing);
  } catch (const sim::InputError& error) {
    return sayWrong(error);
  }
  return 0;
}

}  // namespace

void addCheck(CLI::App& app, int& exit_status) {
  auto* const command = app.add_subcommand(
      "check",
      "Name every error in rule and scene files; of a scene say how long it will take, and how much memory");
  const auto files = std::make_shared<std::vector<std::string>>();
  command->add_option("file", *files, "Rule and scene files")->required();
  command->callback([files, &exit_status] {
    const Interrupt interrupt;
    scenes::RunOptions options;
    options.stop = interrupt.token();
    options.on_warning = [](const std::string& text) { say(text); };
    for (const std::string& file : *files) {
      const int status = doing(file, "checking", [&] {
        const auto read = scenes::readRulesOrScene(file);
        if (!read) return sayProblems(read.problems());
        return *read ? foretell(**read, options) : 0;
      });
      if (status != 0) exit_status = status;
    }
  });
}

}  // namespace espalier::cli
