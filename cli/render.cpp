#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>

#include "cli/commands.h"
#include "cli/job_options.h"
#include "scenes/job/chosen_images.h"
#include "scenes/job/run.h"

namespace espalier::cli {
namespace {

struct RenderArguments {
  JobOptions job;
  std::string from;
  std::vector<std::string> images;
};

}  // namespace

void addRender(CLI::App& app, int& exit_status) {
  auto* const command = app.add_subcommand(
      "render",
      "Draw a scene's images of what was grown before, with other cameras and suns, without growing");
  const auto arguments = std::make_shared<RenderArguments>();
  addSceneOptions(*command, arguments->job, "the folder that --from names");
  command->add_option("--from", arguments->from, "Output folder of espalier grow, which holds growth.state")
      ->required();
  command->add_option("--images", arguments->images,
                      "Only these of the scene's images, by name; film is its film");
  addStrict(*command, arguments->job);
  command->callback([arguments, &exit_status] {
    if (arguments->job.folder.empty()) arguments->job.folder = arguments->from;
    exit_status = runJob(arguments->job, [&](scenes::Scene scene, const scenes::RunOptions& run) {
      if (!arguments->images.empty()) scenes::keepImages(scene, arguments->images);
      const scenes::Report report = scenes::renderScene(scene, arguments->from, run);
      return JobOutcome{scenes::toJson(report), scenes::summary(report, run.folder)};
    });
  });
}

}  // namespace espalier::cli
