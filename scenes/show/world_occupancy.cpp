#include "scenes/show/world_occupancy.h"

#include <algorithm>
#include <numbers>

#include "rules/growth/rule_book.h"

namespace espalier::scenes {
namespace {

/// How thick a mesh is where it is open; of the scene's meshes, those that are tiled have names of their own.
std::vector<double> thicknesses(const Scene& scene, const std::vector<sim::TiledMesh>& meshes,
                                double voxel_m) {
  std::vector<double> result;
  for (const sim::TiledMesh& tiled : meshes) {
    double thickness_m = SceneMesh().thickness_m;
    for (const SceneMesh& mesh : scene.meshes) {
      if (mesh.name == tiled.mesh.name) thickness_m = mesh.thickness_m;
    }
    result.push_back(thickness_m / voxel_m);
  }
  return result;
}

/// Of what an element covers. A body's faces are counted, and it lies between two of them.
double thicknessOf(const rules::Element& element, double voxel_m) {
  if (!(element.thick.number > 0.0)) return WorldOccupancy::kLeaf_m / voxel_m;
  const double size = 0.5 * (element.size.low + std::max(element.size.low, element.size.high));
  const bool metres = element.thick.metres || element.size_metres;
  return 0.5 * element.thick.number * size / (metres ? voxel_m : 1.0);
}

double thicknessOf(const Scene& scene, const sim::Part& part, const std::vector<sim::Plant>& plants,
                   double voxel_m) {
  // What a stem covers is its length times its twigs' diameter, and what it fills times pi r^2.
  if (part.kind == sim::PartKind::stem)
    return 0.5 * std::numbers::pi * plants[static_cast<std::size_t>(part.plant)].girth.twig_vx;
  double thickness_vx = WorldOccupancy::kLeaf_m / voxel_m;
  for (const PlantSpec& plant : scene.plants) {
    if (plant.name != part.object || !plant.rules) continue;
    rules::forEachSet(*plant.rules, [&](const rules::RuleSet& set, const std::string&) {
      for (const rules::Element& element : set.elements) {
        if (element.name == part.region) thickness_vx = thicknessOf(element, voxel_m);
      }
    });
  }
  return thickness_vx;
}

sim::VoxelSet both(sim::BitVolume a, const sim::BitVolume& b) {
  a.add(b);
  return sim::VoxelSet(std::move(a));
}

}  // namespace

WorldOccupancy::WorldOccupancy(const Scene& scene, const std::vector<sim::TiledMesh>& meshes,
                               const sim::World& world, const sim::BitVolume& bare,
                               const std::vector<sim::Plant>& plants)
    : world_(world),
      bare_(bare),
      scene_(sim::meshOccupancy(world, bare, meshes, thicknesses(scene, meshes, world.frame().voxel_m))),
      thin_(both(scene_.where->bits(), world.inPlants())) {
  for (const sim::Part& part : world.parts()) {
    const bool grown = part.kind != sim::PartKind::scene;
    thickness_vx_.push_back(grown ? thicknessOf(scene, part, plants, world.frame().voxel_m) : 0.0);
  }
}

sim::Occupancy WorldOccupancy::at(sim::Voxel voxel) const {
  if (scene_.where->has(voxel)) return scene_.values[scene_.index(voxel)];
  const auto surface = world_.surfaceAt(voxel);
  if (!surface) return {};
  const sim::PartKind kind = world_.part(surface->part).kind;
  if (kind == sim::PartKind::scene) return {1.0f, 1.0f};
  return sim::sheetOccupancy(static_cast<double>(surface->coverage),
                             thickness_vx_[static_cast<std::size_t>(surface->part - 1)]);
}

sim::BitVolume WorldOccupancy::full() const {
  sim::BitVolume full = bare_;
  full.remove(thin_.bits());
  return full;
}

render::VdbField WorldOccupancy::alpha() const {
  return {"alpha",
          "share of a voxel's volume that is occupied",
          "1",
          std::vector<render::VdbPart<float>>{
              {&thin_, [this](sim::Voxel v, std::size_t) { return at(v).alpha; }}},
          {},
          true,
          1.0f};
}

}  // namespace espalier::scenes
