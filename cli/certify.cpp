#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>

#include "cli/commands.h"
#include "cli/doing.h"
#include "cli/interrupt.h"
#include "cli/job_options.h"
#include "cli/say.h"
#include "scenes/accuracy/accuracy_study.h"
#include "scenes/accuracy/certificate.h"
#include "scenes/job/fed.h"
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
    print(doing("the study", "certifying", [] { return scenes::accuracyStudy(); }));
    return 0;
  }
  return doing(arguments.scene, "certifying", [&] {
    const auto scene = scenes::readScene(arguments.scene);
    if (!scene) return sayProblems(scene.problems());
    try {
      scenes::RunOptions options;
      options.stop = interrupt.token();
      const scenes::FedInPassing fed(*scene, options);
      const scenes::Site site = scenes::makeSiteForLight(fed.scene());
      const scenes::Certificate certificate = scenes::certifyWithShapes(
          site, sim::lightOf(site.world, site.sky, {}, {.faces = false}), scene->seed);
      if (arguments.json) {
        printJson(scenes::toJson(certificate));
      } else {
        print(scenes::toText(certificate));
      }
    } catch (const scenes::MeshMissing& missing) {
      saySkipped(missing);
    }
    return 0;
  });
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
