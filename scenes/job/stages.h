#pragma once
#include <chrono>
#include <string>
#include <utility>

#include "scenes/job/report.h"
#include "scenes/job/run.h"
#include "sim/base/memory.h"
#include "sim/base/stop.h"

namespace espalier::scenes {

/// Names and times the stages of a run, which its token can stop while this lives. What a stage needed for
/// itself is given back at its end. Borrows both.
class Stages {
 public:
  Stages(const RunOptions& options, Report& report) : options_(options), report_(report) {}

  Clock::time_point began() const { return began_; }

  template <typename Work>
  auto run(const std::string& name, Work work) {
    sim::throwIfStopped();
    if (options_.on_stage) options_.on_stage(name);
    const Timer timer{report_, name};
    return work();
  }

 private:
  struct Timer {
    Report& report;
    std::string name;
    Clock::time_point began = Clock::now();
    ~Timer() {
      const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
      sim::releaseFreed();
      report.run.stages_s.emplace_back(name, seconds);
      report.run.total_s += seconds;
    }
  };

  const Clock::time_point began_ = Clock::now();
  const RunOptions& options_;
  Report& report_;
  sim::StopScope in_force_{options_.stop};
};

}  // namespace espalier::scenes
