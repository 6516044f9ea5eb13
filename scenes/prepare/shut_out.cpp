#include "scenes/prepare/shut_out.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/tile/inside.h"

namespace espalier::scenes {
namespace {

/// The tiled mesh that a plant's attractors lie in; empty where there is none.
std::string bodyAround(const Scene& scene, const PlantSpec& plant) {
  const std::string wanted = attractorsFor(plant);
  const auto named = std::find_if(scene.attractors.begin(), scene.attractors.end(),
                                  [&](const AttractorsSpec& spec) { return spec.name == wanted; });
  if (named == scene.attractors.end() || named->inside.empty()) return {};
  const auto mesh = std::find_if(scene.meshes.begin(), scene.meshes.end(),
                                 [&](const SceneMesh& spec) { return spec.name == named->inside; });
  return mesh != scene.meshes.end() && mesh->tiled && !mesh->guide ? mesh->name : std::string();
}

}  // namespace

std::vector<Problem> shutOutWarnings(const Scene& scene, const Site& site,
                                     const std::vector<sim::Planting>& plantings) {
  std::vector<Problem> warnings;
  for (std::size_t i = 0; i < scene.plants.size(); ++i) {
    const PlantSpec& plant = scene.plants[i];
    if (!colonizes(plant)) continue;
    const std::string body = bodyAround(scene, plant);
    if (body.empty()) continue;
    const sim::BitVolume inside = sim::insideOf(meshNamed(site, body), site.world.frame());
    const auto& seeds = plantings[i].seeds;
    const bool shut_out =
        !seeds.empty() && std::none_of(seeds.begin(), seeds.end(), [&](const sim::Seed& seed) {
          return inside.at(sim::voxelAt(seed.at_vx));
        });
    if (!shut_out) continue;
    warnings.push_back(
        problemAt(plant.rules_place, scene.file,
                  fmt::format("'{}' starts outside of '{}', which stands between it and the "
                              "attractors in its inside; expected a seed in there, or tiled: false of "
                              "the mesh",
                              plant.name, body)));
  }
  return warnings;
}

}  // namespace espalier::scenes
