#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <csignal>
#include <exception>
#include <sstream>
#include <string>
#include <string_view>

#include "cli/commands.h"
#include "cli/doing.h"
#include "cli/job_options.h"
#include "cli/say.h"
#include "cli/values.h"
#include "scenes/import/reading.h"
#include "sim/base/error.h"

namespace espalier::cli {
namespace {

int parse(int argc, char** argv) {
  int exit_status = 0;
  CLI::App app("Espalier grows plants that feel their way through a world of voxels.", "espalier");
  app.require_subcommand(1);
  app.option_defaults()->disable_flag_override();  // of all commands: --json=maybe says nothing
  app.set_version_flag("--version", "espalier " ESPALIER_VERSION);
  addGrow(app, exit_status);
  addRender(app, exit_status);
  addExpose(app, exit_status);
  addCheck(app, exit_status);
  addCertify(app, exit_status);
  addInspect(app, exit_status);
  addRules(app, exit_status);
  addSchema(app, exit_status);
  addInit(app, exit_status);
  addExplain(app, exit_status);
  addGallery(app, exit_status);
  addStudio(app, exit_status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help and --version
    std::ostringstream text;
    app.exit(asked, text, text);
    print(text.str());
  } catch (const CLI::ParseError& error) {
    say(explained(app, error));
    return kInputError;
  }
  return exit_status;
}

int run(int argc, char** argv) {
  try {
    return doing("espalier", "reading the command line", [&] { return parse(argc, argv); });
  } catch (const sim::Stopped&) {
    say(kStoppedText);
    return kStopped;
  } catch (const sim::InputError& error) {
    return sayWrong(error);
  } catch (const std::exception& error) {
    say(error.what());
    return kFailed;
  }
}

}  // namespace
}  // namespace espalier::cli

int main(int argc, char** argv) {
  using namespace espalier;
  if (argc == 2 && std::string_view(argv[1]) == scenes::kAnswerFlag) scenes::readForParent();
  cli::keepStandardStreams();
  cli::keepLastWords();
  // A file that grows beyond a limit, or a closed pipe, is a failed write with a reason, not the end of the
  // program.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  return cli::statusWithLoss(cli::run(argc, argv));
}
