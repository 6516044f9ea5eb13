#include "scenes/prepare/unknown_regions.h"

#include <fmt/format.h>

#include <memory>
#include <set>
#include <string>

#include "sim/base/error.h"

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

  void require(const std::string& region, const Place& place, Problems& problems) const {
    if (known_.contains(region) || problems.full()) return;
    const auto expected = names_.empty() ? "a mesh that has it" : "one of " + listed(names_, region);
    problems.add(place, fmt::format("no mesh of the scene has a region {}; expected {}{}", inQuotes(region),
                                    expected, didYouMean(region, names_)));
  }

 private:
  std::vector<std::string> names_;
  std::set<std::string> known_;
};

}  // namespace

std::vector<Problem> unknownRegions(const Scene& scene, const sim::World& world) {
  const Regions regions(world);
  Problems problems;
  for (const auto& [region, place] : scene.region_mentions) regions.require(region, place, problems);
  return problems.sorted();
}

void requireRegionsToScatterOver(const Scene& scene, const sim::World& world) {
  const Regions regions(world);
  Problems problems;
  const auto file = std::make_shared<const std::string>(scene.file.string());
  for (const PlantSpec& plant : scene.plants) {
    if (!plant.scatter) continue;
    const Place& place = plant.scatter->region_place;
    regions.require(plant.scatter->region, place.path ? place : Place{file, 0, 0}, problems);
  }
  if (!problems.empty()) throw ManyLines(problems.sorted());
}

}  // namespace espalier::scenes
