#include "cli/job_options.h"

#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "scenes/prepare/site.h"
#include "scenes/read/read_scene.h"
#include "sim/base/parallel.h"

namespace espalier::cli {

void addSceneOptions(CLI::App& command, JobOptions& options, const std::string& default_folder) {
  options.threads = sim::threadCount();
  command.add_option("scene", options.scene, "Scene file")->required();
  command.add_option("-o,--output", options.folder, "Folder to write to (default: " + default_folder + ")");
  command
      .add_option("--threads", options.threads,
                  "Threads to use; the result does not depend on it (default: all)")
      ->check(CLI::Range(1, 1024));
  command.add_flag("--quiet", options.quiet, "Say nothing but errors");
  command.add_flag("--json", options.json, "Print the report as JSON on standard output, and no progress");
}

void addJobOptions(CLI::App& command, JobOptions& options) {
  addSceneOptions(command, options, "out/<scene's file name>");
  command.add_flag("--no-pictures", options.no_pictures, "Write everything but the pictures");
}

void addStrict(CLI::App& command, JobOptions& options) {
  command.add_flag("--strict", options.strict,
                   "Take warnings, such as a rule for a region that the scene does not have, for errors");
}

int runJob(const JobOptions& options, const JobWork& work) {
  const Interrupt interrupt;
  auto scene = scenes::readScene(options.scene);
  if (!scene) {
    fmt::print(stderr, "{}\n", scenes::format(scene.problems()));
    return kInputError;
  }
  scenes::RunOptions run;
  run.folder = options.folder.empty() ? "out/" + scene->file.stem().string() : options.folder;
  run.pictures = !options.no_pictures;
  run.strict = options.strict;
  run.stop = interrupt.token();
  JobOutcome outcome;
  {
    Progress progress(options.quiet || options.json);
    run.on_stage = [&](const std::string& stage) { progress.stage(stage); };
    run.on_growth = [&](const sim::GrowthProgress& growth) { progress.growth(growth); };
    run.on_warning = [&](const std::string& text) {
      if (!options.quiet) progress.warning(text);
    };
    try {
      sim::onThreads(options.threads, [&] { outcome = work(std::move(*scene), run); });
    } catch (const scenes::MeshMissing& missing) {
      fmt::print(stderr, "{}; skipped, as the scene calls it optional\n", missing.what());
      return 0;
    }
  }
  if (options.json) {
    fmt::print("{}", outcome.json);
  } else if (!options.quiet) {
    fmt::print("{}", outcome.summary);
  }
  return 0;
}

}  // namespace espalier::cli
