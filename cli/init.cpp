#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "cli/commands.h"
#include "cli/doing.h"
#include "cli/say.h"
#include "scenes/job/first_project.h"

namespace espalier::cli {

void addInit(CLI::App& app, int& exit_status) {
  auto* const command =
      app.add_subcommand("init", "Make a first project: a scene, rules, a mesh, and settings for editors");
  const auto folder = std::make_shared<std::string>();
  command->add_option("folder", *folder, "A new folder, or an empty one")->required();
  command->callback([folder, &exit_status] {
    exit_status = doing(*folder, "making a project", [&] {
      const std::filesystem::path root = *folder;
      std::string text;
      for (const std::string& name : scenes::makeFirstProject(root)) text += (root / name).string() + "\n";
      print(text + fmt::format("Next: espalier grow {}\n", (root / "scene.yaml").string()));
      return 0;
    });
  });
}

}  // namespace espalier::cli
