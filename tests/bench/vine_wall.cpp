#include "tests/bench/vine_wall.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "scenes/read/read_rules.h"
#include "sim/base/error.h"
#include "sim/light/sky.h"
#include "sim/light/sun.h"

namespace espalier::bench {
namespace {

constexpr double kWallVoxel_m = 0.02;
/// A cover of the wall that still grows: so many segments on a square metre.
constexpr double kSegmentsToASquareMetre = 1000.0;
constexpr double kSeedsToASquareMetre = 2.0;

}  // namespace

sim::World wallFor(double segments) {
  const double height_m = std::sqrt(segments / kSegmentsToASquareMetre / 2.0);
  const auto voxels = [](double metres) { return static_cast<int>(std::lround(metres / kWallVoxel_m)); };
  const sim::Voxel size(voxels(2.0 * height_m), voxels(height_m), voxels(0.7));
  sim::World world({sim::Vec3(0.0), kWallVoxel_m, size});
  const sim::PartId wall = world.addPart({"wall", "brick", sim::PartKind::scene, -1});
  std::vector<sim::TiledVoxel> row;
  for (int y = 0; y < size.y; ++y) {
    row.clear();
    for (int z = 0; z < voxels(0.2); ++z) {
      for (int x = 0; x < size.x; ++x) row.push_back({{x, y, z}, {wall, sim::Colour(0.5f), 1.0f}});
    }
    world.occupy(row);
  }
  world.setLayers(4);
  return world;
}

std::vector<sim::Seed> seedsOn(const sim::World& world) {
  const sim::Voxel size = world.frame().size;
  const double area_m2 = size.x * size.y * kWallVoxel_m * kWallVoxel_m;
  std::mt19937 random(1989);
  std::vector<sim::Vec3> places;
  for (int i = 0; i < std::max(1, static_cast<int>(area_m2 * kSeedsToASquareMetre)); ++i) {
    const auto x = random() % static_cast<unsigned>(size.x), y = random() % static_cast<unsigned>(size.y);
    places.emplace_back(x, y, 11.0);
  }
  return sim::seedsAt(world.frame(), places);
}

rules::RuleSet figureFour() {
  auto rules = scenes::readRules(ESPALIER_SOURCE_DIR "/rules/library/courtyard_vine.yaml");
  if (!rules) throw sim::InputError(scenes::format(rules.problems()));
  return **rules;
}

sim::GrowthSettings settingsFor() {
  sim::GrowthSettings settings;
  settings.iterations = 100'000;
  settings.light.sky = sim::makeSky({.directions = 128}).directions;
  settings.light.sun = sim::makeSun({20.0, 180.0, 48}).directions;
  settings.sky_table = [] { return sim::makeSkyTable(9, 36, sim::backgroundOf(sim::Weighting::uniform)); };
  return settings;
}

}  // namespace espalier::bench
