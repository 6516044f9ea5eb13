#include "scenes/show/emitted_light.h"

#include <algorithm>
#include <cmath>

#include "render/model/radii.h"
#include "render/model/stem_curves.h"
#include "sim/tile/tiling.h"

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
    if (plant.stem_emits_share != 1.0f) dimByOrder(plant);
    for (std::size_t i = 0; i < plant.element_parts.size(); ++i)
      add(plant.element_parts[i], plant.shapes[i].emits);
  }
  std::stable_sort(fainter_.begin(), fainter_.end(), [](const Fainter& a, const Fainter& b) {
    return sim::beforeInRows(a.voxel, b.voxel) || (a.voxel == b.voxel && a.share > b.share);
  });
  std::sort(parts_.begin(), parts_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
}

/// Where limbs of several orders meet, the brightest says what the voxel sends out.
void EmittedLight::dimByOrder(const sim::Plant& plant) {
  const sim::Skeleton& skeleton = plant.skeleton;
  const render::StemCurves curves = render::stemCurves(skeleton, render::stemRadii(skeleton, plant.girth));
  std::vector<sim::Voxel> voxels;
  for (sim::NodeId n = 0; n < skeleton.size(); ++n) {
    const sim::NodeId parent = skeleton.parent[static_cast<std::size_t>(n)];
    if (parent == sim::kNoNode) continue;
    voxels.clear();
    sim::tileSegment(skeleton.position_vx[static_cast<std::size_t>(parent)],
                     skeleton.position_vx[static_cast<std::size_t>(n)], voxels);
    const float share = powf(plant.stem_emits_share, static_cast<float>(curves.orderAt(n)));
    for (const sim::Voxel voxel : voxels) fainter_.push_back({voxel, share});
  }
}

sim::Colour EmittedLight::at(sim::Voxel voxel) const {
  sim::Colour sum(0.0f);
  const auto lamp = std::lower_bound(lamps_.begin(), lamps_.end(), voxel, [](const auto& a, sim::Voxel v) {
    return sim::beforeInRows(a.voxel, v);
  });
  if (lamp != lamps_.end() && lamp->voxel == voxel) sum = lamp->light;
  if (parts_.empty() || (stood_ != nullptr && !stood_->at(voxel))) return sum;
  const sim::PartId part = world_.partAt(voxel);
  const auto of_part = std::lower_bound(parts_.begin(), parts_.end(), part,
                                        [](const auto& a, sim::PartId id) { return a.first < id; });
  if (of_part == parts_.end() || of_part->first != part) return sum;
  float share = std::min(1.0f, world_.surfaceAt(voxel)->coverage);
  const auto fainter =
      std::lower_bound(fainter_.begin(), fainter_.end(), voxel,
                       [](const Fainter& a, sim::Voxel v) { return sim::beforeInRows(a.voxel, v); });
  const bool stem = world_.part(part).kind == sim::PartKind::stem;
  if (stem && fainter != fainter_.end() && fainter->voxel == voxel) share *= fainter->share;
  return sum + share * of_part->second;
}

void letBeMet(sim::World& world, const std::vector<sim::Plant>& plants) {
  std::vector<sim::PartId> shining;
  const auto add = [&](sim::PartId part, sim::Colour emits) {
    if (part != sim::kFree && emits != sim::Colour(0.0f)) shining.push_back(part);
  };
  for (const sim::Plant& plant : plants) {
    add(plant.stem_part, plant.stem_emits);
    for (std::size_t i = 0; i < plant.element_parts.size(); ++i)
      add(plant.element_parts[i], plant.shapes[i].emits);
  }
  if (shining.empty()) return;
  sim::BitVolume voxels(world.frame().size);
  for (const sim::TiledVoxel& tiled : world.surfaces()) {
    if (std::find(shining.begin(), shining.end(), tiled.surface.part) != shining.end())
      voxels.set(tiled.voxel);
  }
  world.addOpaque(voxels);
}

}  // namespace espalier::scenes
