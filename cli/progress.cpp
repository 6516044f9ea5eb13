#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "cli/say.h"

namespace espalier::cli {
namespace {

constexpr int kBarWidth = 28;
constexpr std::chrono::seconds kBetweenLines(2);

}  // namespace

Progress::Progress(bool quiet)
    : quiet_(quiet),
      terminal_(::isatty(STDERR_FILENO) == 1),
      stage_began_(Clock::now()),
      last_line_(Clock::now()) {}

Progress::~Progress() {
  if (open_line_) unsay();
}

void Progress::line(const std::string& text) {
  if (terminal_) {
    sayForNow(text);
    open_line_ = true;
  } else {
    say(text);
  }
  last_line_ = Clock::now();
}

void Progress::foretold(const std::string& text) {
  told_ = true;
  warning(text);
  line(stage_);  // which began before
}

void Progress::stage(const std::string& name) {
  if (quiet_) return;
  stage_ = name;
  stage_began_ = Clock::now();
  if (told_ || terminal_) line(name);
}

void Progress::warning(const std::string& text) {
  if (open_line_) unsay();
  open_line_ = false;
  say(text);
}

void Progress::growth(const sim::GrowthProgress& growth) {
  if (quiet_ || (!told_ && !terminal_)) return;
  const auto now = Clock::now();
  const bool last = growth.iteration == growth.iterations || growth.sites == 0;
  if (!last &&
      now - last_line_ < (terminal_ ? Clock::duration(std::chrono::milliseconds(50)) : kBetweenLines))
    return;
  const double spent = std::chrono::duration<double>(now - stage_began_).count();
  const double left = spent / (growth.iteration - growth.first) * (growth.iterations - growth.iteration);
  const std::string state = fmt::format("iteration {}/{}, {} segments, {} live buds", growth.iteration,
                                        growth.iterations, growth.segments, growth.sites);
  if (!terminal_) return line("  " + state);
  const int filled = kBarWidth * growth.iteration / std::max(1, growth.iterations);
  line(fmt::format("growing [{:=<{}}{: <{}}] {}, {:.0f} s left", "", filled, "", kBarWidth - filled, state,
                   left));
}

}  // namespace espalier::cli
