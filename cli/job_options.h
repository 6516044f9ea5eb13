#pragma once
#include <CLI/App.hpp>
#include <functional>
#include <string>

#include "scenes/job/run.h"
#include "scenes/prepare/site.h"
#include "scenes/problem.h"
#include "scenes/scene.h"

namespace espalier::cli {

/// What every command that works through a scene is told.
struct JobOptions {
  std::string scene;
  std::string folder;
  int threads = 0;
  bool quiet = false, json = false, no_pictures = false;
  bool strict = false;  ///< of the commands that offer it
};

/// --output, --threads, --quiet and --json.
void addRunOptions(CLI::App& command, JobOptions& options, const std::string& default_folder);
/// The same, and the scene.
void addSceneOptions(CLI::App& command, JobOptions& options, const std::string& default_folder);
/// The same, and --no-pictures: of commands that write more than pictures.
void addJobOptions(CLI::App& command, JobOptions& options);
/// --strict, of commands that prepare plants.
void addStrict(CLI::App& command, JobOptions& options);

/// Says each, and gives kInputError back.
int sayProblems(const std::vector<scenes::Problem>& problems);
/// Says what is wrong, in as many lines as it takes, and gives kInputError back.
int sayWrong(const sim::InputError& error);
/// Says that a scene is skipped, which is no failure.
void saySkipped(const scenes::MeshMissing& missing);

/// What is printed when the work is done.
struct JobOutcome {
  std::string json, summary;
};
using JobWork = std::function<JobOutcome(scenes::Scene scene, const scenes::RunOptions& options)>;

/// Reads the scene, runs the work on as many threads as asked with progress and Ctrl-C, and prints what came
/// of it. Gives the exit status back.
int runJob(const JobOptions& options, const JobWork& work);

}  // namespace espalier::cli
