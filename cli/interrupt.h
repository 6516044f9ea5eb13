#pragma once
#include <stop_token>
#include <thread>

namespace espalier::cli {

/// While it lives, the first Ctrl-C (SIGINT) or SIGTERM asks the work to stop, and the second ends the
/// program at once. Make it before any other thread: it has the signals blocked in all of them.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::jthread watcher_;
};

}  // namespace espalier::cli
