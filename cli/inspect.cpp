#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/doing.h"
#include "cli/interrupt.h"
#include "cli/job_options.h"
#include "cli/say.h"
#include "scenes/job/inspect.h"
#include "sim/base/error.h"
#include "sim/base/stop.h"
#include "sim/base/whole_file.h"

namespace espalier::cli {
namespace {

namespace fs = std::filesystem;

struct InspectArguments {
  std::vector<std::string> meshes;
  std::string scene;
  bool force = false, json = false;
};

/// Before the work: a scene file is written, and nothing else is written over.
void requireNewScene(const InspectArguments& arguments) {
  const fs::path scene = arguments.scene;
  if (scene.empty()) return;
  if (scene.extension() != ".yaml" && scene.extension() != ".yml") {
    throw sim::InputError(fmt::format(
        "espalier: --scene {}; expected the name of a scene file, such as scene.yaml", scene.string()));
  }
  std::error_code unknown;
  if (arguments.force || fs::status(scene, unknown).type() == fs::file_type::not_found) return;
  throw sim::InputError(fmt::format(
      "{}: it is there already; expected another name, or --force to write over it", scene.string()));
}

int inspect(const InspectArguments& arguments) {
  const Interrupt interrupt;
  const sim::StopScope stoppable(interrupt.token());
  requireNewScene(arguments);
  std::vector<scenes::Inspection> inspections;
  std::vector<scenes::Inspected> meshes;
  for (const std::string& mesh : arguments.meshes) {
    doing(mesh, "inspecting", [&] {
      inspections.push_back(scenes::inspectMesh(mesh));
      meshes.push_back(inspections.back().found);
      if (!arguments.json) print(scenes::toText(meshes.back()));
      return 0;
    });
  }
  return doing(arguments.meshes.front(), "making a scene of it", [&] {
    const std::string file = arguments.scene.empty() ? "scene.yaml" : arguments.scene;
    scenes::InScene scene;
    try {
      scene = scenes::sceneWith(std::move(inspections), file);
    } catch (const sim::InputError&) {  // the meshes are told of all the same
      if (arguments.json) printJson(scenes::toJson(meshes, {}));
      throw;
    }
    if (arguments.json) {
      printJson(scenes::toJson(meshes, scene));
    } else {
      print("what a world of it takes, for light alone:\n" + scenes::toText(scene.choices));
    }
    if (!arguments.scene.empty()) {
      sim::writeWhole(file, scene.text);
    } else if (!arguments.json) {
      print("a scene file that uses it:\n\n" + scene.text);
    }
    return 0;
  });
}

}  // namespace

void addInspect(CLI::App& app, int& exit_status) {
  auto* const command = app.add_subcommand("inspect",
                                           "Tell what meshes are: unit, way up, regions, holes and flaws, "
                                           "what a world of them takes, and the lines of a "
                                           "scene file that uses them");
  const auto arguments = std::make_shared<InspectArguments>();
  command->add_option("mesh", arguments->meshes, "Mesh files")->required();
  command->add_option("--scene", arguments->scene,
                      "Write a scene file that uses them, and grows a vine on them");
  command->add_flag("--force", arguments->force, "Write over a scene file that is there");
  command->add_flag("--json", arguments->json, "Print all of it as JSON on standard output");
  command->callback([arguments, &exit_status] { exit_status = inspect(*arguments); });
}

}  // namespace espalier::cli
