#include <fmt/format.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/doing.h"
#include "cli/interrupt.h"
#include "cli/job_options.h"
#include "cli/progress.h"
#include "cli/say.h"
#include "scenes/gallery/gallery.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"

namespace espalier::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct GalleryArguments {
  JobOptions job;
  std::vector<std::string> names;
  std::string library;
};

/// Where the library's scenes lie beside this program: installed, or in the tree that it was built from.
fs::path libraryFolder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::string tried;
  for (const char* const place : {ESPALIER_INSTALLED_SCENES, ESPALIER_BUILT_SCENES}) {
    const fs::path folder = (program / place).lexically_normal();
    if (fs::is_directory(folder, error)) return folder;
    tried += (tried.empty() ? "" : ", ") + folder.string();
  }
  throw sim::InputError(
      fmt::format("espalier: the scenes of the library are not beside the program ({}); expected --library "
                  "with their folder, "
                  "scenes/library",
                  tried));
}

/// The help's list of what there is.
std::string figuresText() {
  std::string text;
  for (const scenes::GalleryDocument& document : scenes::galleryDocuments()) {
    text += fmt::format("\n{}: {} ({})\n", document.name, document.title, document.by);
    for (const scenes::GalleryFigure& figure : document.figures)
      text += fmt::format("  {}  {}\n", figure.name, figure.title);
  }
  return text;
}

int gallery(const GalleryArguments& arguments) {
  const JobOptions& job = arguments.job;
  const Interrupt interrupt;
  const std::vector<scenes::GalleryDocument> documents = scenes::figuresCalled(arguments.names);
  const std::vector<scenes::Scene> scenes =
      scenes::scenesOf(scenes::figuresOf(documents),
                       arguments.library.empty() ? libraryFolder() : fs::path(arguments.library));
  scenes::RunOptions run;
  run.folder = job.folder.empty() ? "out/gallery" : job.folder;
  run.stop = interrupt.token();
  const bool silent = job.quiet || job.json;
  scenes::Gallery made;
  {
    Progress progress(silent, ::isatty(STDERR_FILENO) == 1);
    std::string scene_file = job.scene;
    run.on_stage = [&](const std::string& name) {
      nowDoing(scene_file, name);
      progress.stage(name, Clock::now());
    };
    run.on_growth = [&](const sim::GrowthProgress& growth) { progress.growth(growth, Clock::now()); };
    run.on_warning = [&](const scenes::Problem& warning) {
      if (!job.quiet) progress.warning(scenes::formatWarning(warning));
    };
    const auto on_scene = [&](std::size_t number, const scenes::Scene& scene) {
      scene_file = scene.file.string();
      if (!silent) progress.warning(fmt::format("{}/{} {}", number, scenes.size(), scene.name));
    };
    sim::onThreads(job.threads, [&] { made = scenes::makeGallery(documents, scenes, run, on_scene); });
  }
  if (job.json) {
    printJson(scenes::toJson(made));
  } else if (!job.quiet) {
    print(scenes::summary(made, run.folder));
  }
  return 0;
}

}  // namespace

void addGallery(CLI::App& app, int& exit_status) {
  auto* const command =
      app.add_subcommand("gallery",
                         "Grow the figures of Greene's \"Voxel Space Automata\" and of four "
                         "other documents from the library's scenes, with a contact sheet "
                         "and a page that sets each beside what its document says");
  const auto arguments = std::make_shared<GalleryArguments>();
  arguments->job.scene = "the gallery";
  command->add_option("name", arguments->names,
                      "Figures, or documents with all of theirs, as below; without any, all of them");
  addRunOptions(*command, arguments->job, "out/gallery");
  command->add_option("--library", arguments->library,
                      "Folder of the library's scenes (default: the one that came with the program)");
  command->footer(figuresText());
  command->callback([arguments, &exit_status] {
    exit_status = doing(arguments->job.scene, "reading", [&] { return gallery(*arguments); });
  });
}

}  // namespace espalier::cli
