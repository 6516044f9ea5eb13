#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <map>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/job_options.h"
#include "cli/values.h"
#include "scenes/job/expose.h"
#include "sim/base/error.h"

namespace espalier::cli {
namespace {

const std::map<std::string, scenes::ExposureWhere> kWhere = {
    {"surfaces", scenes::ExposureWhere::surfaces},
    {"band", scenes::ExposureWhere::band},
    {"everything", scenes::ExposureWhere::everything}};

struct ExposeArguments {
  JobOptions job;
  std::optional<std::string> where;
  std::optional<int> band_vx;
};

}  // namespace

void addExpose(CLI::App& app, int& exit_status) {
  auto* const command = app.add_subcommand(
      "expose", "Find the sun and the sky that a scene's surfaces see; write maps, fields and tables");
  const auto arguments = std::make_shared<ExposeArguments>();
  addJobOptions(*command, arguments->job);
  addChoice(
      *command, "--where", sceneKey("exposure.where"),
      [arguments](const std::string& where) { arguments->where = where; },
      "surfaces, band (the free space near them too) or everything (all free space), instead of the scene's "
      "exposure.where");
  addWhole(
      *command, "--band", sceneKey("exposure.band"),
      [arguments](std::int64_t band) { arguments->band_vx = static_cast<int>(band); },
      "How many voxels wide a band is; implies --where band");
  command->callback([arguments, &exit_status] {
    const auto& where = arguments->where;
    const auto& band_vx = arguments->band_vx;
    if (band_vx && where && *where != "band") {
      throw sim::InputError("espalier: --band means nothing to --where " + *where +
                            "; expected --where band, or no --band");
    }
    exit_status = runJob(arguments->job, [&](scenes::Scene scene, const scenes::RunOptions& run) {
      if (band_vx) {
        scene.exposure.where = scenes::ExposureWhere::band;
        scene.exposure.band_vx = *band_vx;
      } else if (where) {
        scene.exposure.where = kWhere.at(*where);
      }
      const scenes::ExposeResult result = scenes::exposeScene(scene, run);
      return JobOutcome{scenes::toJson(result.report), scenes::summary(result, run.folder)};
    });
  });
}

}  // namespace espalier::cli
