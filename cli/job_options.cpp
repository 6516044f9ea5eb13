#include "cli/job_options.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <chrono>

#include "cli/commands.h"
#include "cli/doing.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/say.h"
#include "cli/values.h"
#include "scenes/prepare/site.h"
#include "scenes/read/read_scene.h"
#include "sim/base/parallel.h"

namespace espalier::cli {

namespace {

using Clock = std::chrono::steady_clock;

int run(const JobOptions& options, const JobWork& work) {
  const Interrupt interrupt;
  auto scene = scenes::readScene(options.scene);
  if (!scene) return sayProblems(scene.problems());
  scenes::RunOptions run;
  run.folder = options.folder.empty() ? "out/" + scene->file.stem().string() : options.folder;
  run.pictures = !options.no_pictures;
  run.strict = options.strict;
  run.stop = interrupt.token();
  JobOutcome outcome;
  try {
    Progress progress(options.quiet || options.json, ::isatty(STDERR_FILENO) == 1);
    if (!options.quiet && !options.json)
      run.on_foretold = [&](const scenes::Foretold& foretold) {
        progress.foretold(scenes::toText(foretold), Clock::now());
      };
    run.on_stage = [&](const std::string& name) {
      nowDoing(options.scene, name);
      progress.stage(name, Clock::now());
    };
    run.on_growth = [&](const sim::GrowthProgress& growth) { progress.growth(growth, Clock::now()); };
    run.on_warning = [&](const scenes::Problem& warning) {
      if (!options.quiet) progress.warning(scenes::formatWarning(warning));
    };
    sim::onThreads(options.threads, [&] { outcome = work(std::move(*scene), run); });
  } catch (const scenes::MeshMissing& missing) {
    saySkipped(missing);
    return 0;
  }
  if (options.json) {
    printJson(outcome.json);
  } else if (!options.quiet) {
    print(outcome.summary);
  }
  return 0;
}

}  // namespace

void addSceneOptions(CLI::App& command, JobOptions& options, const std::string& default_folder) {
  command.add_option("scene", options.scene, "Scene file")->required();
  addRunOptions(command, options, default_folder);
}

void addRunOptions(CLI::App& command, JobOptions& options, const std::string& default_folder) {
  options.threads = sim::threadCount();
  command.add_option("-o,--output", options.folder, "Folder to write to (default: " + default_folder + ")");
  rules::Key threads;
  threads.kind = rules::Kind::whole;
  threads.limits = {1.0, 1024.0};
  addWhole(
      command, "--threads", threads,
      [&options](std::int64_t number) { options.threads = static_cast<int>(number); },
      "Threads to use; the result does not depend on it (default: all)");
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

int sayProblems(const std::vector<scenes::Problem>& problems) {
  for (const scenes::Problem& problem : problems) say(scenes::format(problem));
  return kInputError;
}

int sayWrong(const sim::InputError& error) {
  const auto* const many = dynamic_cast<const scenes::ManyLines*>(&error);
  if (!many) say(error.what());
  for (const std::string& line : many ? many->lines() : std::vector<std::string>()) say(line);
  return kInputError;
}

void saySkipped(const scenes::MeshMissing& missing) {
  say(scenes::formatWarning(missing.problem()));
}

int runJob(const JobOptions& options, const JobWork& work) {
  return doing(options.scene, "reading", [&] { return run(options, work); });
}

}  // namespace espalier::cli
