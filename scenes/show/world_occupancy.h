#pragma once
#include <vector>

#include "render/files/vdb.h"
#include "scenes/scene.h"
#include "sim/grow/grow.h"
#include "sim/tile/occupancy.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// How much of each voxel of a finished world is taken: of its volume, and of the rays that cross it.
class WorldOccupancy {
 public:
  /// Leaves are as thick as that where their element is no body (metres).
  static constexpr double kLeaf_m = 0.0003;

  /// `bare`: what the scene alone occupies. Borrows this and the world.
  WorldOccupancy(const Scene& scene, const std::vector<sim::TiledMesh>& meshes, const sim::World& world,
                 const sim::BitVolume& bare, const std::vector<sim::Plant>& plants);

  /// Nothing of a free voxel.
  sim::Occupancy at(sim::Voxel voxel) const;
  /// The voxels of the scene that are taken wholly, and stop every ray.
  sim::BitVolume full() const;
  /// As a grid for render::writeVdb, `alpha`. Borrows this.
  render::VdbField alpha() const;

 private:
  const sim::World& world_;
  const sim::BitVolume& bare_;
  sim::Field<sim::Occupancy> scene_;
  std::vector<double> thickness_vx_;  // of what a plant's part covers, by part
  sim::VoxelSet thin_;                // the voxels that are not full, or that plants have
};

}  // namespace espalier::scenes
