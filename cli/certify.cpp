#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "scenes/accuracy/accuracy_study.h"
#include "scenes/accuracy/certificate.h"
#include "scenes/read/read_scene.h"

namespace espalier::cli {
namespace {

struct CertifyArguments {
  std::string scene;
  bool json = false;
};

int certify(const CertifyArguments& arguments) {
  const Interrupt interrupt;
  if (arguments.scene.empty()) {
    fmt::print("{}", scenes::accuracyStudy());
    return 0;
  }
  auto scene = scenes::readScene(arguments.scene);
  if (!scene) {
    fmt::print(stderr, "{}\n", scenes::format(scene.problems()));
    return kInputError;
  }
  try {
    const scenes::Certificate certificate = scenes::certify(scenes::makeSiteForLight(*scene), scene->seed);
    fmt::print("{}", arguments.json ? scenes::toJson(certificate) : scenes::toText(certificate));
  } catch (const scenes::MeshMissing& missing) {
    fmt::print(stderr, "{}; skipped, as the scene calls it optional\n", missing.what());
  }
  return 0;
}

}  // namespace

void addCertify(CLI::App& app, int& exit_status) {
  auto* const command = app.add_subcommand(
      "certify",
      "Print the error of a scene's exposure maps: against shapes that are known, and against rays");
  const auto arguments = std::make_shared<CertifyArguments>();
  auto* const scene =
      command->add_option("scene", arguments->scene,
                          "Scene file (without one: the whole study of docs/accuracy.md, as Markdown)");
  command->add_flag("--json", arguments->json, "Print JSON")->needs(scene);
  command->callback([arguments, &exit_status] { exit_status = certify(*arguments); });
}

}  // namespace espalier::cli
