#include "scenes/show/emitted_light.h"

#include <algorithm>

namespace espalier::scenes {
EmittedLight::EmittedLight(const std::vector<sim::TiledMesh>& meshes, const sim::World& world,
                           const std::vector<sim::Plant>& plants)
    : world_(world) {
  const auto covered = [&](sim::Voxel v) {
    const auto surface = world.surfaceAt(v);
    return surface ? surface->coverage : 0.0f;
  };
  lamps_ = sim::emissionOf(world.frame(), meshes, covered);
  const auto add = [&](sim::PartId part, sim::Colour emits) {
    if (part != sim::kFree && emits != sim::Colour(0.0f)) parts_.emplace_back(part, emits);
  };
  for (const sim::Plant& plant : plants) {
    add(plant.stem_part, plant.stem_emits);
    for (std::size_t i = 0; i < plant.element_parts.size(); ++i)
      add(plant.element_parts[i], plant.shapes[i].emits);
  }
  std::sort(parts_.begin(), parts_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
}

sim::Colour EmittedLight::at(sim::Voxel voxel) const {
  sim::Colour sum(0.0f);
  const auto lamp = std::lower_bound(lamps_.begin(), lamps_.end(), voxel, [](const auto& a, sim::Voxel v) {
    return sim::beforeInRows(a.voxel, v);
  });
  if (lamp != lamps_.end() && lamp->voxel == voxel) sum = lamp->light;
  if (parts_.empty()) return sum;
  const sim::PartId part = world_.partAt(voxel);
  const auto of_part = std::lower_bound(parts_.begin(), parts_.end(), part,
                                        [](const auto& a, sim::PartId id) { return a.first < id; });
  if (of_part == parts_.end() || of_part->first != part) return sum;
  return sum + std::min(1.0f, world_.surfaceAt(voxel)->coverage) * of_part->second;
}

}  // namespace espalier::scenes
