#pragma once
#include <chrono>
#include <string>

#include "sim/grow/grow.h"

namespace espalier::cli {

/// Says on standard error how far the work has come: a bar with the time left on a terminal, plain lines
/// elsewhere, nothing when quiet. `now`: when it is called; never earlier than before.
class Progress {
 public:
  using Time = std::chrono::steady_clock::time_point;

  Progress(bool quiet, bool terminal) : quiet_(quiet), terminal_(terminal) {}
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The first line, which stays: what the work will take. Elsewhere than on a terminal nothing is said
  /// before.
  void foretold(const std::string& text, Time now);
  void stage(const std::string& name, Time now);
  /// A line that stays, also when quiet.
  void warning(const std::string& text);
  void growth(const sim::GrowthProgress& growth, Time now);

 private:
  void line(const std::string& text, Time now);

  bool quiet_;
  bool terminal_;
  bool open_line_ = false;
  bool told_ = false;  // what the work will take
  std::string stage_;
  Time stage_began_;
  Time last_line_;
};

}  // namespace espalier::cli
