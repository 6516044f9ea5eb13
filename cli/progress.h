#pragma once
#include <chrono>
#include <string>

#include "sim/grow/grow.h"

namespace espalier::cli {

/// Says on standard error how far the work has come: a bar with the time left on a terminal, plain lines
/// elsewhere, nothing when quiet.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The first line, which stays: what the work will take. Elsewhere than on a terminal nothing is said
  /// before.
  void foretold(const std::string& text);
  void stage(const std::string& name);
  /// A line that stays, also when quiet.
  void warning(const std::string& text);
  void growth(const sim::GrowthProgress& growth);

 private:
  using Clock = std::chrono::steady_clock;
  void line(const std::string& text);

  bool quiet_;
  bool terminal_;
  bool open_line_ = false;
  bool told_ = false;  // what the work will take
  std::string stage_;
  Clock::time_point stage_began_;
  Clock::time_point last_line_;
};

}  // namespace espalier::cli
