#include "scenes/job/plant_reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "rules/growth/front_memory.h"
#include "rules/growth/laying_front.h"
#include "scenes/problem.h"
#include "sim/base/provenance.h"

namespace espalier::scenes {
namespace {

Report::Growth::Plant plantReport(const PlantSpec& spec, const sim::Frame& frame, const sim::Plant& plant,
                                  std::size_t number, const sim::Tally& tally) {
  Report::Growth::Plant report;
  report.name = plant.name;
  report.planting = spec.name;
  report.rules = spec.rules->name;
  report.given = spec.skeleton.has_value();
  report.at_m = sim::worldFromVoxel(frame, plant.skeleton.position_vx.front());
  const bool named = number < spec.seeds.size() && !spec.seeds[number].key.empty();
  report.key = named ? spec.seeds[number].key : sim::hexOf(plant.key);
  report.segments = static_cast<std::size_t>(plant.skeleton.size()) - 1;
  report.elements = plant.elements.size();
  if (const auto* const joins = sim::find(plant.skeleton, sim::kJoinsColumn)) {
    report.loops = static_cast<std::size_t>(
        std::count_if(joins->begin(), joins->end(), [](float node) { return node > 0.0f; }));
  }
  report.tally = tally;
  return report;
}

std::vector<Report::Growth::Attractors> attractorReports(const Scene& scene, const sim::Growth& growth) {
  std::vector<Report::Growth::Attractors> reports;
  const std::string prefix = rules::attractorsNamed("");
  const bool by_itself = growth.iterations < scene.iterations && growth.cut_short.empty();
  for (const auto& [name, columns] : growth.commons) {
    if (!name.starts_with(prefix)) continue;
    reports.push_back({name.substr(prefix.size()), rules::fatesIn(columns),
                       rules::endingIn(columns, growth.iterations, by_itself)});
  }
  return reports;
}

Report::Growth::Laid laidReport(const PlantSpec& spec, std::span<const sim::Plant> plants,
                                std::span<const sim::Tally> tallies, const sim::Columns& memory,
                                const std::shared_ptr<const sim::SceneSurface>& surface,
                                const sim::World& world) {
  Report::Growth::Laid laid;
  laid.planting = spec.name;
  for (const sim::Plant& plant : plants) laid.elements += plant.elements.size();
  laid.asked_fill = spec.rules->diffusion.fill;
  laid.measure = rules::measureLaid(spec.rules, plants, surface, world);
  laid.waiting = rules::countLaying(memory);
  for (const sim::Tally& tally : tallies) {
    for (std::size_t i = 0; i < laid.ends.size(); ++i) laid.ends[i] += tally.sites[i];
  }
  return laid;
}

/// How much of a planting whose skeletons were given lies in what stands in the scene; empty where nothing
/// does.
std::string inTheWay(const std::string& planting, std::span<const sim::Plant> plants,
                     std::span<const sim::Tally> tallies) {
  std::uint64_t met = 0, segments = 0;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    met += sim::timesOf(tallies[i].trials, sim::Outcome::blocked);
    segments += static_cast<std::uint64_t>(plants[i].skeleton.size()) - 1;
  }
  if (met == 0) return "";
  return fmt::format(
      "{} of {} segments of the skeleton of {} pass through the scene's objects, and stand there all the "
      "same; "
      "move it by translate, rotate or scale if they should not",
      met, segments, inQuotes(planting));
}

}  // namespace

Report::Growth growthReport(const Scene& scene, const Site& site, const sim::BitVolume& scene_voxels,
                            const sim::Growth& growth, const std::vector<rules::Exposure>& lights) {
  const sim::World& grown = site.world;
  const sim::Tally tally = sim::total(growth);
  Report::Growth report;
  report.iterations = growth.iterations;
  report.buds = tally.sites;
  report.trials = tally.trials;
  report.attractors = attractorReports(scene, growth);
  report.state_hash = sim::stateHash(grown, growth);
  report.cut_short = growth.cut_short;
  std::shared_ptr<const sim::SceneSurface> surface;  // where it is asked for
  for (std::size_t i = 0; i < growth.stands.size(); ++i) {
    const PlantSpec& spec = scene.plants[i];
    const auto [first, count] = std::pair(growth.stands[i].first, growth.stands[i].count);
    auto failures = seedFailures(
        spec.rules, grown, scene_voxels, std::span(growth.plants).subspan(first, count),
        std::span(growth.tallies).subspan(first, count), std::span(lights).subspan(first, count));
    for (std::size_t k = 0; k < count; ++k) {
      report.plants.push_back(
          plantReport(spec, grown.frame(), growth.plants[first + k], k, growth.tallies[first + k]));
      report.plants.back().failure = std::move(failures[k]);
    }
    if (lays(spec)) {
      if (!surface) surface = sim::surfaceOf(site.world.frame(), site.meshes);
      report.laid.push_back(laidReport(spec, std::span(growth.plants).subspan(first, count),
                                       std::span(growth.tallies).subspan(first, count),
                                       growth.stands[i].memory, surface, grown));
    }
    if (!spec.skeleton) continue;
    std::string met = inTheWay(spec.name, std::span(growth.plants).subspan(first, count),
                               std::span(growth.tallies).subspan(first, count));
    if (!met.empty()) report.in_the_way.push_back(std::move(met));
  }
  return report;
}

}  // namespace espalier::scenes
