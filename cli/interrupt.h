#pragma once
#include <stop_token>
#include <thread>

#include "sim/base/stop.h"

namespace espalier::cli {

/// While it lives, the first Ctrl-C (SIGINT) or SIGTERM asks the work of this thread to stop (it is in force
/// as a sim::StopScope). Work that has not come back within 0.2 s, as it may be inside of a library, is left
/// where it is: the files that it is writing are removed, and the program ends as one that was stopped; a
/// second signal does so at once. Make it before any other thread: it has the signals blocked in all of them.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  sim::StopScope in_force_{source_.get_token()};
  std::jthread watcher_;
};

}  // namespace espalier::cli
