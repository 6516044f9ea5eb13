#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/job_options.h"
#include "scenes/job/run.h"

namespace espalier::cli {

void addGrow(CLI::App& app, int& exit_status) {
  auto* const command =
      app.add_subcommand("grow", "Grow a scene's plants; write the model, the world and the pictures");
  const auto options = std::make_shared<JobOptions>();
  const auto seed = std::make_shared<std::optional<std::uint64_t>>();
  addJobOptions(*command, *options);
  addStrict(*command, *options);
  command->add_option("--seed", *seed, "Random seed instead of the scene's own");
  command->callback([options, seed, &exit_status] {
    exit_status = runJob(*options, [&](scenes::Scene scene, const scenes::RunOptions& run) {
      if (*seed) scene.seed = **seed;
      const scenes::Report report = scenes::runScene(scene, run);
      return JobOutcome{scenes::toJson(report), scenes::summary(report, run.folder)};
    });
  });
}

}  // namespace espalier::cli
