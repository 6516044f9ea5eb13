#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "cli/job_options.h"
#include "scenes/job/run.h"
#include "scenes/problem.h"
#include "sim/base/error.h"

namespace espalier::cli {
namespace {

struct RenderArguments {
  JobOptions job;
  std::string from;
  std::vector<std::string> images;
};

constexpr const char* kFilm = "film";

/// Those of the scene's images that are named, and those that a contact sheet among them needs; its film
/// where that is.
void keepImages(scenes::Scene& scene, const std::vector<std::string>& names) {
  std::vector<std::string> known, wanted = names;
  for (const scenes::ImageSpec& image : scene.images) known.push_back(image.name);
  if (scene.film) known.emplace_back(kFilm);
  for (const std::string& name : names) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end()) {
      throw sim::InputError(scene.file.string() + ": there is no image " + scenes::inQuotes(name) +
                            "; expected one of " + scenes::listed(known) + scenes::didYouMean(name, known));
    }
    if (scene.film && name == kFilm) continue;
    const scenes::ImageSpec& image = scene.images[static_cast<std::size_t>(at - known.begin())];
    wanted.insert(wanted.end(), image.of.begin(), image.of.end());
  }
  std::erase_if(scene.images, [&](const scenes::ImageSpec& image) {
    return std::find(wanted.begin(), wanted.end(), image.name) == wanted.end();
  });
  if (std::find(wanted.begin(), wanted.end(), kFilm) == wanted.end()) scene.film.reset();
}

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
      if (!arguments->images.empty()) keepImages(scene, arguments->images);
      const scenes::Report report = scenes::renderScene(scene, arguments->from, run);
      return JobOutcome{scenes::toJson(report), scenes::summary(report, run.folder)};
    });
  });
}

}  // namespace espalier::cli
