#include "cli/interrupt.h"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <ctime>
#include <string>

#include "cli/commands.h"
#include "sim/base/whole_file.h"

namespace espalier::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kGrace(200);

sigset_t stopSignals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

/// Ends the program under the hands of its other threads.
[[noreturn]] void leave() {
  sim::abandonFiles();
  const std::string text =
      (::isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "") + std::string(kStoppedText) + "\n";
  // Once, whatever comes of it: it must not wait.
  static_cast<void>(!::write(STDERR_FILENO, text.data(), text.size()));
  ::_exit(kStopped);
}

}  // namespace

Interrupt::Interrupt() {
  const sigset_t set = stopSignals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  watcher_ = std::jthread([this](const std::stop_token& ended) {
    const sigset_t signals = stopSignals();
    const timespec tick{0, 20'000'000};
    Clock::time_point asked{};
    while (!ended.stop_requested()) {
      const bool signalled = sigtimedwait(&signals, nullptr, &tick) >= 0;
      if (!source_.stop_requested()) {
        if (!signalled) continue;
        asked = Clock::now();
        source_.request_stop();
      } else if (signalled || Clock::now() - asked > kGrace) {
        leave();
      }
    }
  });
}

Interrupt::~Interrupt() = default;

}  // namespace espalier::cli
