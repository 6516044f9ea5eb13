#include "scenes/job/seed_failure.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "rules/growth/rule_book.h"
#include "rules/growth/voxel_widths.h"
#include "sim/base/parallel.h"
#include "sim/sense/nearest_voxel.h"

namespace espalier::scenes {
namespace {

using rules::RuleSet;
using sim::Outcome;

/// The most frequent of some outcomes; the first of those that are equally frequent.
template <std::size_t N>
Outcome mostly(const sim::OutcomeCounts& counts, const std::array<Outcome, N>& among) {
  return *std::max_element(among.begin(), among.end(), [&](Outcome a, Outcome b) {
    return sim::timesOf(counts, a) < sim::timesOf(counts, b);
  });
}

/// What ended a site, or else what it met most often.
Outcome reasonOf(const sim::Tally& tally) {
  for (const Outcome end :
       {Outcome::forbidden, Outcome::too_dark, Outcome::too_bright, Outcome::unmet, Outcome::too_far}) {
    if (sim::timesOf(tally.sites, end) > 0) return end;
  }
  const Outcome often =
      mostly(tally.sites, std::array{Outcome::no_trial, Outcome::resting, Outcome::claimed});
  if (often != Outcome::no_trial) return often;
  return mostly(tally.trials, std::array{Outcome::blocked, Outcome::too_far, Outcome::too_near,
                                         Outcome::out_of_world, Outcome::unmet});
}

/// The key that forbids growth near a region; empty where none does.
std::string forbiddingKey(const RuleSet& rules, const std::string& region) {
  std::string path;
  return rules::setNear(rules, region, &path) == nullptr ? path : "";
}

RuleLength lengthOf(const rules::Distance& written, double voxel_m) {
  return {rules::widths(written, voxel_m), written.metres};
}

SeedFailure::Set setOf(const RuleSet& rules, std::string path, rules::Exposure light, double voxel_m) {
  SeedFailure::Set set;
  set.path = std::move(path);
  const rules::Vigour vigour = rules::vigourOf(light, rules);
  set.exposure = vigour.exposure;
  set.exposure_min = rules.require.exposure_min;
  set.exposure_max = rules.require.exposure_max;
  set.pace = vigour.vigour / std::max(1.0, rules.light.boost);
  set.proximity_min = lengthOf(rules.require.proximity_min, voxel_m);
  set.proximity_max = lengthOf(rules.require.proximity_max, voxel_m);
  if (set.exposure < set.exposure_min) set.outcome = Outcome::too_dark;
  if (set.exposure > set.exposure_max) set.outcome = Outcome::too_bright;
  return set;
}

int voxelsToTheRim(sim::Voxel size, sim::Voxel v) {
  int least = std::max({size.x, size.y, size.z});
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] > 1) least = std::min({least, v[axis], size[axis] - 1 - v[axis]});
  }
  return least;
}

int takenAround(const sim::BitVolume& occupied, sim::Voxel v) {
  int taken = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dx = -1; dx <= 1; ++dx) {
        const sim::Voxel n = v + sim::Voxel(dx, dy, dz);
        if (n != v && (!sim::contains(occupied.size(), n) || occupied.at(n))) ++taken;
      }
    }
  }
  return taken;
}

}  // namespace

std::vector<rules::Exposure> lightOfSeeds(const std::vector<sim::Planting>& plantings,
                                          const sim::World& world, const sim::LightSource& light) {
  std::vector<sim::Voxel> places;
  for (const sim::Planting& planting : plantings) {
    // One outside of the world is an error that growth will tell of.
    for (const sim::Seed& seed : planting.seeds)
      places.push_back(glm::clamp(sim::voxelAt(seed.at_vx), sim::Voxel(0), world.frame().size - 1));
  }
  std::vector<rules::Exposure> lights;
  if (places.empty()) return lights;
  sim::ClearAhead ahead;
  for (const sim::Light& seen : sim::LightSensor(world.opaque(), light).at(world.opaque(), places, ahead))
    lights.push_back(rules::exposureOf(seen));
  return lights;
}

std::vector<std::optional<SeedFailure>> seedFailures(const std::shared_ptr<const RuleSet>& rules,
                                                     const sim::World& grown, const sim::BitVolume& scene,
                                                     std::span<const sim::Plant> plants,
                                                     std::span<const sim::Tally> tallies,
                                                     std::span<const rules::Exposure> lights) {
  const rules::RuleBook book(rules);
  std::map<const RuleSet*, std::string> paths;
  rules::forEachSet(*rules, [&](const RuleSet& set, const std::string& path) { paths[&set] = path; });

  std::vector<std::optional<SeedFailure>> failures(plants.size());
  sim::parallelForEach(plants.size(), [&](std::size_t i) {
    const bool asked = std::any_of(tallies[i].sites.begin(), tallies[i].sites.end(),
                                   [](std::uint64_t times) { return times > 0; });
    if (plants[i].skeleton.size() > 1 || !plants[i].elements.empty() || !asked) return;
    const sim::Voxel at = sim::voxelAt(plants[i].skeleton.position_vx.front());
    SeedFailure failure;
    failure.tally = tallies[i];
    failure.reason = reasonOf(tallies[i]);
    failure.voxel_m = grown.frame().voxel_m;
    failure.lays = rules->propagate == rules::Propagate::diffusion;
    failure.rim_vx = voxelsToTheRim(grown.frame().size, at);
    failure.taken = takenAround(grown.occupied(), at);
    failure.wall_vx = sim::distanceToNearest(scene, at, kFarthestWall);
    if (const auto nearness = grown.nearnessAt(at)) {
      failure.region = grown.part(nearness->part).region;
      failure.forbidden_by = forbiddingKey(*rules, failure.region);
    }
    for (const RuleSet* set = book.first(grown, at); set != nullptr; set = book.next(*set, grown, at))
      failure.sets.push_back(setOf(*set, paths.at(set), lights[i], failure.voxel_m));
    failures[i] = std::move(failure);
  });
  return failures;
}

}  // namespace espalier::scenes
