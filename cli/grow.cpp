#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "scenes/read_scene.h"
#include "scenes/run.h"
#include "sim/parallel.h"

namespace espalier::cli {
namespace {

struct GrowArguments {
  std::string scene;
  std::string folder;
  std::optional<std::uint64_t> seed;
  int threads = sim::threadCount();
  bool quiet = false, json = false, no_pictures = false;
};

int grow(const GrowArguments& arguments) {
  const Interrupt interrupt;
  auto scene = scenes::readScene(arguments.scene);
  if (!scene) {
    fmt::print(stderr, "{}\n", scenes::format(scene.problems()));
    return kInputError;
  }
  if (arguments.seed) scene->seed = *arguments.seed;

  scenes::RunOptions options;
  options.folder = arguments.folder.empty() ? "out/" + scene->file.stem().string() : arguments.folder;
  options.pictures = !arguments.no_pictures;
  options.stop = interrupt.token();
  scenes::Report report;
  {
    Progress progress(arguments.quiet || arguments.json);
    options.on_stage = [&](const std::string& stage) { progress.stage(stage); };
    options.on_growth = [&](const sim::GrowthProgress& growth) { progress.growth(growth); };
    try {
      sim::onThreads(arguments.threads, [&] { report = scenes::runScene(std::move(*scene), options); });
    } catch (const scenes::MeshMissing& missing) {
      fmt::print(stderr, "{}; skipped, as the scene calls it optional\n", missing.what());
      return 0;
    }
  }
  if (arguments.json) {
    fmt::print("{}", scenes::toJson(report));
  } else if (!arguments.quiet) {
    fmt::print("{}", scenes::summary(report, options.folder));
  }
  return 0;
}

}  // namespace

void addGrow(CLI::App& app, int& exit_status) {
  auto* const command =
      app.add_subcommand("grow", "Grow a scene's plants; write the model, the world and the pictures");
  const auto arguments = std::make_shared<GrowArguments>();
  command->add_option("scene", arguments->scene, "Scene file")->required();
  command->add_option("-o,--output", arguments->folder,
                      "Folder to write to (default: out/<scene's file name>)");
  command->add_option("--seed", arguments->seed, "Random seed instead of the scene's own");
  command
      ->add_option("--threads", arguments->threads,
                   "Threads to use; the result does not depend on it (default: all)")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--no-pictures", arguments->no_pictures,
                    "Write the model, the world and the report alone");
  command->add_flag("--quiet", arguments->quiet, "Say nothing but errors");
  command->add_flag("--json", arguments->json,
                    "Print the report as JSON on standard output, and no progress");
  command->callback([arguments, &exit_status] { exit_status = grow(*arguments); });
}

}  // namespace espalier::cli
