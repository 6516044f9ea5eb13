#pragma once
#include <string>
#include <vector>

#include "sim/world/world.h"

/// Worlds to grow in, with parts and boundary layers.
namespace espalier::tests {

inline void addBox(sim::World& world, const std::string& region, sim::Voxel low, sim::Voxel high) {
  const sim::PartId part = world.addPart({"plot", region, sim::PartKind::scene, -1});
  std::vector<sim::TiledVoxel> voxels;
  for (int y = low.y; y <= high.y; ++y) {
    for (int z = low.z; z <= high.z; ++z) {
      for (int x = low.x; x <= high.x; ++x) {
        voxels.push_back({{x, y, z}, {part, sim::Colour(0.5f), 1.0f, sim::Vec3f(0.0f)}});
      }
    }
  }
  world.occupy(voxels);
}

/// A floor of soil, a wall of brick three voxels thick across the middle, open sky.
inline sim::World wallPlot(sim::Voxel size = {48, 48, 40}, int layers = 4) {
  sim::World world({sim::Vec3(0.0), 0.04, size});
  addBox(world, "soil", {0, 0, 0}, {size.x - 1, 0, size.z - 1});
  addBox(world, "brick", {0, 1, size.z / 2 - 1}, {size.x - 1, size.y * 2 / 3, size.z / 2 + 1});
  world.setLayers(layers);
  return world;
}

}  // namespace espalier::tests
