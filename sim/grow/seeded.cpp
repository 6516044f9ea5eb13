#include "sim/grow/seeded.h"

#include <fmt/format.h>

#include <utility>

#include "sim/grow/faults.h"

namespace espalier::sim {

Growth seeded(World& world, const std::vector<Planting>& plantings, const GrowthSettings& settings) {
  requireProcesses(plantings);
  if (auto faults = seedFaults(world, plantings); !faults.empty()) throw PlantingFaults(std::move(faults));
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
