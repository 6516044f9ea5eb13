#include "sim/grow/faults.h"

#include <fmt/format.h>

#include <cstdint>
#include <set>
#include <utility>

namespace espalier::sim {
namespace {

/// Empty where there is nothing.
std::string wrongPlace(const World& world, const Planting& planting, Vec3 seed_vx) {
  const Voxel v = voxelAt(seed_vx);
  const Vec3 m = worldFromVoxel(world.frame(), seed_vx);
  if (!contains(world.frame().size, v)) {
    return fmt::format("a seed of '{}' at [{:.3f}, {:.3f}, {:.3f}] lies outside the world", planting.name,
                       m.x, m.y, m.z);
  }
  if (const PartId part = world.partAt(v); part != kFree && !planting.anywhere) {
    return fmt::format(
        "a seed of '{}' at [{:.3f}, {:.3f}, {:.3f}] lies inside '{}' ({}); move it into the open{}",
        planting.name, m.x, m.y, m.z, world.part(part).object, world.part(part).region,
        orLeaveHollow(world.part(part)));
  }
  return "";
}

}  // namespace

PlantingFaults::PlantingFaults(std::vector<PlantingFault> faults)
    : InputError(faults.front().text), faults_(std::move(faults)) {}

std::vector<PlantingFault> seedFaults(const World& world, const std::vector<Planting>& plantings) {
  std::vector<PlantingFault> faults;
  std::set<std::pair<std::string, std::uint64_t>> keys;  // two of one name may be two plantings
  for (std::size_t p = 0; p < plantings.size(); ++p) {
    const Planting& planting = plantings[p];
    for (std::size_t s = 0; s < planting.seeds.size(); ++s) {
      if (std::string wrong = wrongPlace(world, planting, planting.seeds[s].at_vx); !wrong.empty())
        faults.push_back({p, s, std::move(wrong)});
      if (!keys.emplace(planting.name, planting.seeds[s].key).second) {
        faults.push_back(
            {p, s,
             fmt::format("two seeds of '{}' have the same key, or stand in one place; expected keys that "
                         "differ, places, or names of the plants",
                         planting.name)});
      }
    }
  }
  return faults;
}

}  // namespace espalier::sim
