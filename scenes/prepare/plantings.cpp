#include "scenes/prepare/plantings.h"

#include <fmt/format.h>

#include <bit>

#include "rules/growth/make_process.h"
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
std::vector<sim::Vec3> scatter(const sim::World& world, const Scatter& spec, std::uint64_t stream) {
  std::vector<sim::Voxel> open = placesAbove(world, spec.region);
  if (open.size() < static_cast<std::size_t>(spec.count)) {
    throw sim::InputError(fmt::format("scatter: region '{}' has {} places that look up; expected at least {}",
                                      spec.region, open.size(), spec.count));
  }
  std::vector<sim::Vec3> seeds;
  for (int i = 0; i < spec.count; ++i) {  // Fisher and Yates, as far as needed
    sim::Draws draws({stream, static_cast<std::uint32_t>(i)}, sim::Purpose::scatter);
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

sim::Planting plant(const PlantSpec& spec, const Site& site, std::uint64_t seed) {
  const sim::Frame& frame = site.world.frame();
  std::vector<sim::Vec3> places_vx;
  for (const sim::Vec3& seed_m : spec.seeds_m) places_vx.push_back(sim::voxelFromWorld(frame, seed_m));
  if (spec.scatter) {
    requireRegion(site.world, spec.scatter->region);
    const auto seeds = scatter(site.world, *spec.scatter, sim::streamOf(seed, spec.name));
    places_vx.insert(places_vx.end(), seeds.begin(), seeds.end());
  }
  for (const auto& [region, rule] : spec.rules->regions) requireRegion(site.world, region);
  return {spec.name, rules::makeProcess(spec.rules, frame.voxel_m), sim::seedsAt(frame, places_vx)};
}

}  // namespace

std::vector<sim::Planting> makePlantings(const Scene& scene, const Site& site) {
  std::vector<sim::Planting> plantings;
  inScene(scene, [&] {
    for (const PlantSpec& spec : scene.plants) plantings.push_back(plant(spec, site, scene.seed));
  });
  return plantings;
}

sim::GrowthSettings growthSettings(const Scene& scene, const Site& site) {
  sim::GrowthSettings settings;
  settings.iterations = scene.iterations;
  settings.seed = scene.seed;
  settings.light = {sim::receivedBy(site.sky), site.sun.directions, site.random_sky, site.sky.weighting};
  settings.sky_table = [weighting = site.sky.weighting] {
    return sim::makeSkyTable(9, 36, sim::backgroundOf(weighting));  // cells of 10 degrees
  };
  for (const ImageSpec& image : scene.images) {
    settings.record_attempts = settings.record_attempts || image.kind == ImageKind::attempts;
  }
  return settings;
}

}  // namespace espalier::scenes
