#include "cli/progress.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/say.h"
#include "sim/base/counted.h"

namespace espalier::cli {
namespace {

constexpr int kBarWidth = 28;
constexpr std::chrono::seconds kBetweenLines(2);

}  // namespace

Progress::~Progress() {
  if (open_line_) unsay();
}

void Progress::line(const std::string& text, Time now) {
  if (terminal_) {
    sayForNow(text);
    open_line_ = true;
  } else {
    say(text);
  }
  last_line_ = now;
}

void Progress::foretold(const std::string& text, Time now) {
  told_ = true;
  warning(text);
  line(stage_, now);  // which began before
}

void Progress::stage(const std::string& name, Time now) {
  if (quiet_) return;
  stage_ = name;
  stage_began_ = now;
  if (told_ || terminal_) line(name, now);
}

void Progress::warning(const std::string& text) {
  if (open_line_) unsay();
  open_line_ = false;
  say(text);
}

void Progress::growth(const sim::GrowthProgress& growth, Time now) {
  if (quiet_ || (!told_ && !terminal_)) return;
  const bool last = growth.iteration == growth.iterations || growth.sites == 0;
  if (!last && now - last_line_ < (terminal_ ? Time::duration(std::chrono::milliseconds(50)) : kBetweenLines))
    return;
  const double spent = std::chrono::duration<double>(now - stage_began_).count();
  const double left = spent / (growth.iteration - growth.first) * (growth.iterations - growth.iteration);
  const std::string state =
      fmt::format("iteration {}/{}, {}, {}", growth.iteration, growth.iterations,
                  sim::counted(growth.segments, "segment"), sim::counted(growth.sites, "live bud"));
  if (!terminal_) return line("  " + state, now);
  const int filled = kBarWidth * growth.iteration / std::max(1, growth.iterations);
  line(fmt::format("growing [{:=<{}}{: <{}}] {}, {:.0f} s left", "", filled, "", kBarWidth - filled, state,
                   left),
       now);
}

}  // namespace espalier::cli
