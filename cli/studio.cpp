#include <spawn.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <array>
#include <condition_variable>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <string>

#include "cli/commands.h"
#include "cli/doing.h"
#include "cli/interrupt.h"
#include "cli/say.h"
#include "cli/values.h"
#include "scenes/import/reading.h"
#include "sim/base/parallel.h"
#include "studio/server/server.h"
#include "studio/session/session.h"

namespace espalier::cli {
namespace {

struct StudioArguments {
  std::string scene;
  int threads = sim::threadCount();
  int port = 0;
  bool no_open = false;
};

/// Where there is a desktop; nobody waits for it, and where it fails there is still the printed address.
void openInBrowser(std::string address) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  std::string program = "xdg-open";
  std::array<char*, 3> words{program.data(), address.data(), nullptr};
  posix_spawn_file_actions_t silent;
  ::posix_spawn_file_actions_init(&silent);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    ::posix_spawn_file_actions_addopen(&silent, stream, "/dev/null", stream == STDIN_FILENO ? 0 : 1, 0);
  pid_t child = 0;
  static_cast<void>(::posix_spawnp(&child, program.c_str(), &silent, nullptr, words.data(), environ));
  ::posix_spawn_file_actions_destroy(&silent);
}

void serve(const StudioArguments& arguments) {
  scenes::readInProgram("/proc/self/exe");  // threads are at work beside
  const Interrupt interrupt;
  studio::Session session(arguments.scene, arguments.threads);
  const studio::Server server(session, arguments.port);
  print("The studio is open at " + server.address() + "\nCtrl-C closes it.\n");
  if (!arguments.no_open) openInBrowser(server.address());
  std::mutex mutex;
  std::condition_variable_any stopped;
  std::unique_lock lock(mutex);
  stopped.wait(lock, interrupt.token(), [] { return false; });
}

}  // namespace

void addStudio(CLI::App& app, int& exit_status) {
  auto* const command = app.add_subcommand(
      "studio", "Open a scene in the browser: write its rules there, and see the plants regrow");
  const auto arguments = std::make_shared<StudioArguments>();
  command->add_option("scene", arguments->scene, "Scene file")->required();
  rules::Key port;
  port.kind = rules::Kind::whole;
  port.limits = {0.0, 65535.0};
  addWhole(
      *command, "--port", port,
      [arguments](std::int64_t number) { arguments->port = static_cast<int>(number); },
      "Port of this machine to serve the page at (default: one that is free)");
  rules::Key threads;
  threads.kind = rules::Kind::whole;
  threads.limits = {1.0, 1024.0};
  addWhole(
      *command, "--threads", threads,
      [arguments](std::int64_t number) { arguments->threads = static_cast<int>(number); },
      "Threads to use; the result does not depend on it (default: all)");
  command->add_flag("--no-open", arguments->no_open, "Only print the page's address; open no browser");
  command->callback([arguments, &exit_status] {
    exit_status = doing(arguments->scene, "serving", [&] {
      serve(*arguments);
      return 0;
    });
  });
}

}  // namespace espalier::cli
