#include "scenes/prepare/plantings.h"

#include <fmt/format.h>

#include <bit>

#include "rules/growth/random_tree.h"
#include "scenes/prepare/in_scene.h"
#include "scenes/problem.h"
#include "sim/base/error.h"
#include "sim/base/random.h"

namespace espalier::scenes {
namespace {

/// The open voxels right above a region, in (y, z, x) order.
std::vector<sim::Voxel> placesAbove(const sim::World& world, const std::string& region) {
  const sim::BitVolume& occupied = world.occupied();
  std::vector<sim::Voxel> places;
  for (int y = 0; y + 1 < occupied.size().y; ++y) {
    for (int z = 0; z < occupied.size().z; ++z) {
      const std::uint64_t *const row = occupied.row(y, z), *const above = occupied.row(y + 1, z);
      for (int w = 0; w < occupied.rowWords() - 1; ++w) {
        for (std::uint64_t left = row[w] & ~above[w]; left != 0; left &= left - 1) {
          const sim::Voxel v(w * sim::BitVolume::kWordBits + std::countr_zero(left), y, z);
          if (world.part(world.partAt(v)).region == region) places.push_back(v + sim::Voxel(0, 1, 0));
        }
      }
    }
  }
  return places;
}

/// Seeds in the open voxels right above a region, drawn without putting two in one place.
std::vector<sim::Vec3> scatter(const sim::World& world, const Scatter& spec, std::uint64_t seed,
                               std::size_t plant) {
  std::vector<sim::Voxel> open = placesAbove(world, spec.region);
  if (open.size() < static_cast<std::size_t>(spec.count)) {
    throw sim::InputError(fmt::format("scatter: region '{}' has {} places that look up; expected at least {}",
                                      spec.region, open.size(), spec.count));
  }
  sim::Draws draws({seed, static_cast<std::uint32_t>(plant), 0, 0}, sim::Purpose::scatter);
  std::vector<sim::Vec3> seeds;
  for (int i = 0; i < spec.count; ++i) {  // Fisher and Yates, as far as needed
    const int pick = draws.whole(i, static_cast<int>(open.size()) - 1);
    std::swap(open[static_cast<std::size_t>(i)], open[static_cast<std::size_t>(pick)]);
    seeds.emplace_back(open[static_cast<std::size_t>(i)]);
  }
  return seeds;
}

void requireRegion(const sim::World& world, const std::string& region) {
  std::vector<std::string> known;
  for (const sim::Part& part : world.parts()) {
    if (part.region == region) return;
    known.push_back(part.region);
  }
  throw sim::InputError(fmt::format("there is no region '{}'; the meshes have: {}{}", region,
                                    fmt::join(known, ", "), didYouMean(region, known)));
}

sim::Planting plant(const Scene& scene, const Site& site, std::size_t number,
                    std::vector<std::unique_ptr<const sim::Rule>>& rules) {
  const PlantSpec& spec = scene.plants[number];
  rules.push_back(rules::makeRandomTree(spec.rules, site.world.frame().voxel_m));
  sim::Planting planting{spec.name, rules.back().get(), {}};
  for (const sim::Vec3& seed_m : spec.seeds_m) {
    planting.seeds_vx.push_back(sim::voxelFromWorld(site.world.frame(), seed_m));
  }
  if (spec.scatter) {
    requireRegion(site.world, spec.scatter->region);
    const auto seeds = scatter(site.world, *spec.scatter, scene.seed, number);
    planting.seeds_vx.insert(planting.seeds_vx.end(), seeds.begin(), seeds.end());
  }
  for (const auto& [region, rule] : spec.rules->regions) requireRegion(site.world, region);
  return planting;
}

}  // namespace

Plantings makePlantings(const Scene& scene, const Site& site) {
  Plantings plantings;
  inScene(scene, [&] {
    for (std::size_t i = 0; i < scene.plants.size(); ++i) {
      plantings.seeds.push_back(plant(scene, site, i, plantings.rules));
    }
  });
  return plantings;
}

sim::GrowthSettings growthSettings(const Scene& scene, const Site& site) {
  sim::GrowthSettings settings;
  settings.iterations = scene.iterations;
  settings.seed = scene.seed;
  settings.sky = sim::receivedBy(site.sky);
  settings.random_sky = site.random_sky;
  settings.weighting = site.sky.weighting;
  settings.sun = site.sun.directions;
  settings.sky_table =
      sim::makeSkyTable(9, 36, sim::backgroundOf(site.sky.weighting));  // cells of 10 degrees
  for (const ImageSpec& image : scene.images) {
    settings.record_attempts = settings.record_attempts || image.kind == ImageKind::attempts;
  }
  return settings;
}

}  // namespace espalier::scenes
