#include "scenes/prepare/unknown_regions.h"

#include <fmt/format.h>

#include <set>
#include <string>

namespace espalier::scenes {
namespace {

/// The regions of the meshes, each once, in the order of the meshes.
class Regions {
 public:
  explicit Regions(const sim::World& world) {
    for (const sim::Part& part : world.parts()) {
      if (part.kind == sim::PartKind::scene && known_.insert(part.region).second)
        names_.push_back(part.region);
    }
  }

  bool has(const std::string& region) const { return known_.contains(region); }
  /// What is said of one that is not there.
  std::string unknown(const std::string& region) const {
    const auto expected = names_.empty() ? "a mesh that has it" : "one of " + listed(names_, region);
    return fmt::format("no mesh of the scene has a region {}; expected {}{}", inQuotes(region), expected,
                       didYouMean(region, names_));
  }

 private:
  std::vector<std::string> names_;
  std::set<std::string> known_;
};

}  // namespace

std::vector<Problem> unknownRegions(const Scene& scene, const sim::World& world) {
  const Regions regions(world);
  Problems problems;
  for (const auto& [region, place] : scene.region_mentions) {
    if (!regions.has(region) && !problems.full()) problems.add(place, regions.unknown(region));
  }
  return problems.sorted();
}

std::vector<std::optional<Problem>> unknownToScatterOver(const Scene& scene, const sim::World& world) {
  const Regions regions(world);
  std::vector<std::optional<Problem>> unknown;
  for (const PlantSpec& plant : scene.plants) {
    unknown.emplace_back();
    if (!plant.scatter || regions.has(plant.scatter->region)) continue;
    unknown.back() =
        problemAt(plant.scatter->region_place, scene.file, regions.unknown(plant.scatter->region));
  }
  return unknown;
}

}  // namespace espalier::scenes
