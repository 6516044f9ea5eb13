#include "scenes/prepare/unknown_regions.h"

#include <fmt/format.h>

#include <set>
#include <string>

namespace espalier::scenes {
namespace {

/// The regions of the meshes, each once, in the order of the meshes.
class Regions {
 public:
  /// `but`: objects whose regions are none of them.
  explicit Regions(const sim::World& world, const std::set<std::string>& but = {}) {
    for (const sim::Part& part : world.parts()) {
      const bool of_scene = part.kind == sim::PartKind::scene && !but.contains(part.object);
      if (of_scene && known_.insert(part.region).second) names_.push_back(part.region);
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
  std::set<std::string> guides;
  for (const auto& mesh : scene.meshes) {
    if (mesh.guide) guides.insert(mesh.name);
  }
  const Regions regions(world), filling(world, guides);
  Problems problems;
  for (const auto& [region, place, sensed] : scene.region_mentions) {
    if (problems.full()) break;
    if (!regions.has(region)) {
      problems.add(place, regions.unknown(region));
    } else if (sensed && !filling.has(region)) {
      problems.add(place, fmt::format("the region {} is a guide's, of which nothing is sensed; expected one "
                                      "that fills voxels",
                                      inQuotes(region)));
    }
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
