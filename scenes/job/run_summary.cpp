#include <fmt/format.h>

#include "scenes/job/run.h"
#include "scenes/job/seed_failure_words.h"
#include "scenes/problem.h"
#include "sim/base/counted.h"

namespace espalier::scenes {
namespace {

/// Why buds ended, and which seeds never grew: what somebody who wonders about a thin plant wants to know.
std::string fates(const Report::Growth& report) {
  const auto of = [&](sim::Outcome outcome) { return report.buds[static_cast<std::size_t>(outcome)]; };
  std::string text =
      fmt::format("buds that ended: {} found no way, {} too dark, {} too bright, {} in forbidden regions{}\n",
                  of(sim::Outcome::no_trial), of(sim::Outcome::too_dark), of(sim::Outcome::too_bright),
                  of(sim::Outcome::forbidden), unmetAmong(report.buds));
  for (const Report::Growth::Attractors& one : report.attractors)
    text += fmt::format("attractors {}: {}\n", inQuotes(one.name), one.ending);
  for (const std::string& met : report.in_the_way) text += "note: " + met + "\n";
  return text + poorPlants(report.plants);
}

}  // namespace

std::string summary(const Report& report, const std::filesystem::path& folder) {
  const Report::Growth& growth = *report.growth;
  std::size_t segments = 0, elements = 0;
  for (const Report::Growth::Plant& plant : growth.plants) {
    segments += plant.segments;
    elements += plant.elements;
  }
  const auto& size = report.frame.size;
  return fmt::format("{}: {} x {} x {} voxels of {:.4g} m; {}, {}, {} in {}\n", report.scene, size.x, size.y,
                     size.z, report.frame.voxel_m, sim::counted(growth.plants.size(), "plant"),
                     sim::counted(segments, "segment"), sim::counted(elements, "leaf", "leaves"),
                     sim::counted(static_cast<std::uint64_t>(growth.iterations), "iteration")) +
         (growth.cut_short.empty() ? "" : "note: " + growth.cut_short + "\n") + fates(growth) +
         endOfSummary(report, folder);
}

}  // namespace espalier::scenes
