#pragma once
#include <span>
#include <vector>

#include "sim/base/bits.h"
#include "sim/tile/build_world.h"
#include "sim/world/field.h"
#include "sim/world/world.h"

namespace espalier::sim {

/// How much of a voxel is taken.
struct Occupancy {
  float alpha = 0.0f;  ///< share of its volume, 0..1
  /// Share of the rays that cross it, 0..1: as alpha in solids; of what is thinner than a voxel, as a leaf
  /// is, its area over a face's.
  float stops = 0.0f;

  friend bool operator==(const Occupancy&, const Occupancy&) = default;
};

/// Of something thin whose area inside a voxel, over a face's, is `coverage`.
Occupancy sheetOccupancy(double coverage, double thickness_vx);

/// Of the scene's voxels that the surfaces of its meshes meet; all others of it are full. `world` was built
/// from `meshes`, and what has grown in it since does not matter; `scene`: what the scene alone occupies.
/// The volume that a closed mesh encloses is exact: that of its mesh, to the rounding of numbers, where no
/// two of its surfaces overlap and none leaks. What is open is a sheet, as thick as `thickness_vx` says for
/// each of the meshes. Does not depend on the number of threads. Throws InputError where there are not as
/// many thicknesses as meshes, or one is not positive.
Field<Occupancy> meshOccupancy(const World& world, const BitVolume& scene,
                               const std::vector<TiledMesh>& meshes, std::span<const double> thickness_vx);

}  // namespace espalier::sim
