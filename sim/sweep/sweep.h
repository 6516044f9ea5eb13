#pragma once
#include <memory>

#include "sim/base/bits.h"
#include "sim/sweep/directions.h"
#include "sim/sweep/open_table.h"
#include "sim/world/field.h"

/// What is seen along lattice directions, for many voxels at once: exactly what casting each of the rays from
/// each voxel's centre gives (sim/light/exposure.h), at a cost in proportion to the voxels and not to the
/// length of the rays.
///
/// Along a direction v, with o_1 .. o_m = v the voxels crossed in one period (LatticeDirection::crossed),
///     blocked(p) = occupied(p + o_1) or .. or occupied(p + o_m) or blocked(p + v).
/// Outside the world nothing is occupied or blocked. Sums are whole numbers: neither the number of threads
/// nor the width of the processor's vectors changes them.
namespace espalier::sim {

/// The weighted sum of `directions` that reach the world's edge, for every voxel.
ExposureField sweepExposure(const BitVolume& occupied, const DirectionSet& directions);

/// The same for the voxels of `where`, which must have the world's size.
ExposureField sweepExposure(const BitVolume& occupied, const DirectionSet& directions,
                            std::shared_ptr<const VoxelSet> where);

/// Each direction on its own, for the voxels of `where`.
OpenTable sweepOpen(const BitVolume& occupied, const DirectionSet& directions,
                    std::shared_ptr<const VoxelSet> where);

}  // namespace espalier::sim
