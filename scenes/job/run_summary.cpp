#include <fmt/format.h>

#include <algorithm>

#include "scenes/job/run.h"
#include "scenes/job/run_pieces.h"
#include "scenes/job/seed_failure_words.h"
#include "scenes/problem.h"
#include "sim/base/counted.h"

namespace espalier::scenes {
namespace {

/// "4.2 m²" or "310 cm²".
std::string areaText(double area_m2) {
  if (area_m2 >= 0.1) return fmt::format("{:.3g} m\u00b2", area_m2);
  return fmt::format("{:.3g} cm\u00b2", 1e4 * area_m2);
}

/// Why diffusion laid no more.
std::string whyNoMore(const Report::Growth::Laid& laid) {
  if (laid.waiting > 0) {
    return fmt::format(
        "the iterations ended while more could be laid beside {} of them; expected more "
        "iterations, or rounds",
        laid.waiting);
  }
  const std::uint64_t dark = sim::timesOf(laid.ends, sim::Outcome::too_dark),
                      bright = sim::timesOf(laid.ends, sim::Outcome::too_bright),
                      unmet = sim::timesOf(laid.ends, sim::Outcome::unmet),
                      full = sim::timesOf(laid.ends, sim::Outcome::no_trial);
  const std::string places =
      "expected smaller elements among them, a smaller gap, more trials, or seeds in every part";
  if (dark + bright + unmet == 0) return "nothing more found a place; " + places;
  return fmt::format(
      "of the places beside what lies there {} were too dark, {} too bright, {} not of the age or senses "
      "that are required, and at {} nothing found room; expected another require, or seeds elsewhere",
      dark, bright, unmet, full);
}

/// What diffusion has laid, and why no more where more was asked.
std::string laidText(const Report::Growth::Laid& laid, double voxel_m) {
  const rules::LaidMeasure& measure = laid.measure;
  const double share = measure.surface_vx2 > 0.0 ? measure.covered_vx2 / measure.surface_vx2 : 0.0;
  std::string text =
      fmt::format("{}: {} on {:.1f} % of {}", inQuotes(laid.planting), sim::counted(laid.elements, "element"),
                  100.0 * share, areaText(measure.surface_vx2 * voxel_m * voxel_m));
  if (const rules::Joints& joints = measure.joints; joints.length_vx > 0.0) {
    const double mm = 1000.0 * voxel_m;
    text +=
        fmt::format("; joints of {:.2f} mm, give or take {:.2g}, along {:.0f} % of their rims",
                    joints.mean_vx * mm, joints.deviation_vx * mm, 100.0 * joints.length_vx / joints.rims_vx);
  }
  text += "\n";
  if (laid.elements == 0 || laid.asked_fill == 1.0 || share >= laid.asked_fill - 0.005) return text;
  return text +
         fmt::format("note: fill asks for {:.1f} % of it: {}\n", 100.0 * laid.asked_fill, whyNoMore(laid));
}

/// Why buds ended, and which seeds never grew: what somebody who wonders about a thin plant wants to know.
std::string fates(const Report::Growth& report, double voxel_m) {
  const auto of = [&](sim::Outcome outcome) { return report.buds[static_cast<std::size_t>(outcome)]; };
  std::string text;
  const auto laid = [&](const Report::Growth::Plant& plant) {
    return std::any_of(report.laid.begin(), report.laid.end(),
                       [&](const Report::Growth::Laid& one) { return one.planting == plant.planting; });
  };
  if (!std::all_of(report.plants.begin(), report.plants.end(), laid))
    text = fmt::format(
        "buds that ended: {} found no way, {} too dark, {} too bright, {} in forbidden regions{}\n",
        of(sim::Outcome::no_trial), of(sim::Outcome::too_dark), of(sim::Outcome::too_bright),
        of(sim::Outcome::forbidden), unmetAmong(report.buds));
  for (const Report::Growth::Attractors& one : report.attractors)
    text += fmt::format("attractors {}: {}\n", inQuotes(one.name), one.ending);
  for (const Report::Growth::Plant& plant : report.plants) {
    if (plant.loops)
      text +=
          fmt::format("{}: its limbs close {}\n", inQuotes(plant.name), sim::counted(*plant.loops, "loop"));
  }
  for (const Report::Growth::Laid& one : report.laid) text += laidText(one, voxel_m);
  for (const std::string& met : report.in_the_way) text += "note: " + met + "\n";
  return text + poorPlants(report.plants);
}

}  // namespace

std::string summary(const Report& report, const std::filesystem::path& folder) {
  const Report::Growth& growth = *report.growth;
  std::size_t segments = 0, leaves = 0;
  for (const Report::Growth::Plant& plant : growth.plants) {
    segments += plant.segments;
    leaves += plant.elements;
  }
  for (const Report::Growth::Laid& laid : growth.laid) leaves -= laid.elements;
  const auto& size = report.frame.size;
  return fmt::format("{}: {} x {} x {} voxels of {:.4g} m; {}, {}, {} in {}\n", report.scene, size.x, size.y,
                     size.z, report.frame.voxel_m, sim::counted(growth.plants.size(), "plant"),
                     sim::counted(segments, "segment"), sim::counted(leaves, "leaf", "leaves"),
                     sim::counted(static_cast<std::uint64_t>(growth.iterations), "iteration")) +
         (growth.cut_short.empty() ? "" : "note: " + growth.cut_short + "\n") +
         fates(growth, report.frame.voxel_m) + piecesText(report.pieces) + endOfSummary(report, folder);
}

}  // namespace espalier::scenes
