#include "cli/interrupt.h"

#include <unistd.h>
#include <csignal>
#include <ctime>

#include "cli/commands.h"

namespace espalier::cli {
namespace {

sigset_t stopSignals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

}  // namespace

Interrupt::Interrupt() {
  const sigset_t set = stopSignals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  watcher_ = std::jthread([this](const std::stop_token& ended) {
    const sigset_t signals = stopSignals();
    const timespec tick{0, 50'000'000};
    while (!ended.stop_requested()) {
      if (sigtimedwait(&signals, nullptr, &tick) < 0) continue;
      if (source_.stop_requested()) ::_exit(kStopped);
      source_.request_stop();
    }
  });
}

Interrupt::~Interrupt() = default;

}  // namespace espalier::cli
