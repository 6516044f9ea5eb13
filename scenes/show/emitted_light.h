#pragma once
#include <utility>
#include <vector>

#include "sim/grow/plant.h"
#include "sim/tile/emission.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// What the voxels of a finished world send out by themselves: lamps of its meshes, stems and elements.
class EmittedLight {
 public:
  /// Borrows the world.
  EmittedLight(const std::vector<sim::TiledMesh>& meshes, const sim::World& world,
               const std::vector<sim::Plant>& plants);
  /// Before all that grew stood there: what plants have in voxels of the world that are not among these is
  /// dark. Borrows it.
  void darkenBut(const sim::BitVolume& stood) { stood_ = &stood; }

  bool any() const { return anyMesh() || anyPlant(); }
  bool anyMesh() const { return !lamps_.empty(); }
  bool anyPlant() const { return !parts_.empty(); }
  /// Linear light of an occupied voxel.
  sim::Colour at(sim::Voxel voxel) const;

 private:
  struct Fainter {
    sim::Voxel voxel;
    float share;  // of what its part sends out
  };
  void dimByOrder(const sim::Plant& plant);

  const sim::World& world_;
  const sim::BitVolume* stood_ = nullptr;
  std::vector<sim::EmittingVoxel> lamps_;                   // in rows
  std::vector<std::pair<sim::PartId, sim::Colour>> parts_;  // of plants
  std::vector<Fainter> fainter_;  // in rows: of stems whose light hangs on their order
};

/// Lets all voxels of plants' parts that shine take light. What takes little of its voxels takes it in few of
/// them, by chance, and a thin thing would be met in a handful: each sends out its own share.
void letBeMet(sim::World& world, const std::vector<sim::Plant>& plants);

}  // namespace espalier::scenes
