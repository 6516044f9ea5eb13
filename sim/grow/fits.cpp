#include "sim/grow/fits.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/base/counted.h"
#include "sim/grow/grow.h"

namespace espalier::sim {

Fits::Fits(const MemoryPlan& plan) : plan_(plan), before_bytes_(memoryInUse()) {}

std::string Fits::whyNot(const Grown& so_far, std::size_t sites) const {
  constexpr double kLeastASite = 2000.0;  // a segment with some leaves and their voxels
  // Twice what a site took so far: proposals are in flight, and arrays that grow lie there twice for a while.
  constexpr double kInFlight = 2.0;
  const double in_use = memoryInUse();
  const auto segments = static_cast<double>(so_far.segments), next = static_cast<double>(sites);
  const double a_site = std::max(
      kLeastASite, asked_ > 0 ? (in_use - before_bytes_) / static_cast<double>(asked_) : kLeastASite);
  // The next segments carry as many elements as those before them.
  const double elements =
      static_cast<double>(so_far.elements) * (1.0 + (segments > 0.0 ? next / segments : 0.0));
  const double needed = kInFlight * a_site * next + plan_.later_bytes +
                        plan_.later_a_segment * (segments + next) + plan_.later_an_element * elements;
  const double free = std::max(0.0, plan_.budget_bytes - in_use);
  if (needed <= free) return "";
  constexpr double kGigabyte = 1024.0 * 1024.0 * 1024.0;
  return fmt::format(
      "growth stopped after {} with {}: with the next, and its files, it would need "
      "{:.2f} GB of memory more, and {:.2f} are free for it here; limit iterations, or light or proximity in "
      "the rules",
      counted(static_cast<std::uint64_t>(so_far.iterations), "iteration"),
      counted(so_far.segments, "segment"), needed / kGigabyte, free / kGigabyte);
}

bool Growing::nextFits() {
  const Fits::Grown so_far{growth_.iterations, segments_, elements_};
  growth_.cut_short = fits_.whyNot(so_far, alive());
  if (growth_.cut_short.empty()) return true;
  // Most that are alive may wait. To count those that are due takes a copy of what processes remember.
  std::size_t sites = 0;
  for (const std::vector<Site>& due : due().sites) sites += due.size();
  growth_.cut_short = fits_.whyNot(so_far, sites);
  return growth_.cut_short.empty();
}

}  // namespace espalier::sim
