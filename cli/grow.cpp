#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/job_options.h"
#include "cli/values.h"
#include "render/model/plant_model.h"
#include "scenes/job/run.h"

namespace espalier::cli {
namespace {

struct GrowArguments {
  JobOptions job;
  std::optional<std::uint64_t> seed;
  std::optional<int> iterations;
  scenes::Keeping keeping;
  bool no_state = false;
  scenes::ModelsWanted models;
};

}  // namespace

void addGrow(CLI::App& app, int& exit_status) {
  auto* const command =
      app.add_subcommand("grow", "Grow a scene's plants; write the model, the world and the pictures");
  const auto arguments = std::make_shared<GrowArguments>();
  addJobOptions(*command, arguments->job);
  addStrict(*command, arguments->job);
  addWhole(
      *command, "--seed", sceneKey("seed"),
      [arguments](std::int64_t seed) { arguments->seed = static_cast<std::uint64_t>(seed); },
      "Random seed instead of the scene's own");
  addWhole(
      *command, "--iterations", sceneKey("iterations"),
      [arguments](std::int64_t number) { arguments->iterations = static_cast<int>(number); },
      "Iterations instead of the scene's own");
  rules::Key every = sceneKey("iterations");
  every.limits.min = 1.0;
  addWhole(
      *command, "--save-every", every,
      [arguments](std::int64_t number) { arguments->keeping.every = static_cast<int>(number); },
      "Keep the state of growth in the output folder after every so many iterations");
  rules::Key levels = sceneKey("iterations");
  levels.limits = {0.0, render::kLevels - 1.0};
  addWhole(
      *command, "--lods", levels,
      [arguments](std::int64_t number) { arguments->models.coarser = static_cast<int>(number); },
      "Write so many coarser models too, plant_lod1.glb and so on: each with an error three times as large");
  command->add_flag(
      "--instances", arguments->models.instances,
      "Write each kind of leaf into .glb files once, with the places where it stands: smaller files "
      "for programs that read EXT_mesh_gpu_instancing and Draco, which Blender 3.4 does not");
  command->add_flag("--obj", arguments->models.obj,
                    "Write plant.obj too, with plant.mtl and the pictures of its materials");
  rules::Key colours;
  colours.kind = rules::Kind::choice;
  colours.choices = {std::string(scenes::nameOf(scenes::ImageKind::first_pass)),
                     std::string(scenes::nameOf(scenes::ImageKind::surface_colour))};
  addChoice(
      *command, "--diced", colours,
      [arguments, lit = colours.choices.front()](const std::string& colour) {
        arguments->models.diced =
            colour == lit ? scenes::ImageKind::first_pass : scenes::ImageKind::surface_colour;
      },
      "Write diced.glb too, with --obj diced.obj: meshes and plants cut to the grid of voxels, in the "
      "voxels' "
      "colours, lit (first_pass) or not (surface_colour)");
  command->add_flag("--resume", arguments->keeping.resume,
                    "Go on from the state in the output folder, or begin if there is none");
  command->add_flag("--no-state", arguments->no_state, "Leave no state of growth behind at the end");
  command->callback([arguments, &exit_status] {
    arguments->keeping.keep = !arguments->no_state;
    exit_status = runJob(arguments->job, [&](scenes::Scene scene, const scenes::RunOptions& run) {
      if (arguments->seed) scene.seed = *arguments->seed;
      if (arguments->iterations) {
        scene.skeleton_iterations = scene.iterations;
        scene.iterations = *arguments->iterations;
      }
      scenes::RunOptions options = run;
      options.models = arguments->models;
      const scenes::Report report = scenes::runScene(scene, options, arguments->keeping);
      return JobOutcome{scenes::toJson(report), scenes::summary(report, run.folder)};
    });
  });
}

}  // namespace espalier::cli
