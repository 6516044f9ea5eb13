#include "sim/grow/seeded.h"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "sim/base/error.h"

namespace espalier::sim {
namespace {

void requireFree(const World& world, const Planting& planting, Vec3 seed_vx) {
  const Voxel v = voxelAt(seed_vx);
  const Vec3 m = worldFromVoxel(world.frame(), seed_vx);
  if (!contains(world.frame().size, v)) {
    throw InputError(fmt::format("a seed of '{}' at [{:.3f}, {:.3f}, {:.3f}] lies outside the world",
                                 planting.name, m.x, m.y, m.z));
  }
  if (const PartId part = world.partAt(v); part != kFree && !planting.anywhere) {
    throw InputError(fmt::format(
        "a seed of '{}' at [{:.3f}, {:.3f}, {:.3f}] lies inside '{}' ({}); move it into the open{}",
        planting.name, m.x, m.y, m.z, world.part(part).object, world.part(part).region,
        orLeaveHollow(world.part(part))));
  }
}

void requireSeeds(const World& world, const std::vector<Planting>& plantings) {
  std::set<std::pair<std::string, std::uint64_t>> keys;  // two of one name may be two plantings
  for (const Planting& planting : plantings) {
    for (const Seed& seed : planting.seeds) {
      requireFree(world, planting, seed.at_vx);
      if (!keys.emplace(planting.name, seed.key).second)
        throw InputError(fmt::format(
            "two seeds of '{}' have the same key, or stand in one place; expected keys that differ, "
            "places, or names of the plants",
            planting.name));
    }
  }
}

}  // namespace

Growth seeded(World& world, const std::vector<Planting>& plantings, const GrowthSettings& settings) {
  requireProcesses(plantings);
  requireSeeds(world, plantings);
  Growth growth;
  growth.commons = settings.commons;
  growth.recorded = settings.record_attempts;
  for (const Planting& planting : plantings) {
    growth.stands.push_back({growth.plants.size(), planting.seeds.size(), {}});
    for (std::size_t i = 0; i < planting.seeds.size(); ++i) {
      const int number = static_cast<int>(growth.plants.size());
      Plant plant = planting.process->seedling();
      plant.name = planting.seeds.size() == 1 ? planting.name : fmt::format("{} {}", planting.name, i + 1);
      plant.key = planting.seeds[i].key;
      plant.stem_part = world.addPart({plant.name, "stem", PartKind::stem, number});
      for (const ElementShape& shape : plant.shapes) {
        plant.element_parts.push_back(world.addPart({plant.name, shape.name, PartKind::element, number}));
      }
      plant.skeleton.parent.push_back(kNoNode);
      plant.skeleton.position_vx.push_back(planting.seeds[i].at_vx);
      plant.skeleton.born.push_back(0);
      for (auto& [name, values] : plant.skeleton.columns) values.push_back(0.0f);
      growth.plants.push_back(std::move(plant));
    }
  }
  growth.tallies.resize(growth.plants.size());
  return growth;
}

}  // namespace espalier::sim
