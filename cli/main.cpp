#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "cli/commands.h"
#include "sim/base/error.h"

int main(int argc, char** argv) {
  using namespace espalier;
  int exit_status = 0;
  // A file that grows beyond a limit, or a closed pipe, is a failed write with a reason, not the end of the
  // program.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  try {
    CLI::App app("Espalier grows plants that feel their way through a world of voxels.", "espalier");
    app.require_subcommand(1);
    app.set_version_flag("--version", "espalier " ESPALIER_VERSION);
    cli::addGrow(app, exit_status);
    cli::addRender(app, exit_status);
    cli::addExpose(app, exit_status);
    cli::addCheck(app, exit_status);
    cli::addCertify(app, exit_status);
    cli::addSchema(app, exit_status);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return app.exit(error) == 0 ? 0 : cli::kInputError;  // --help and --version end here too
    }
  } catch (const sim::Stopped&) {
    fmt::print(stderr, "{}", cli::kStoppedText);
    return cli::kStopped;
  } catch (const sim::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return cli::kInputError;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "espalier: out of memory; use larger voxels, fewer iterations or smaller images\n");
    return 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "espalier: {}\n", error.what());
    return 1;
  }
  return exit_status;
}
