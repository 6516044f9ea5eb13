#pragma once
#include "sim/bits.h"
#include "sim/directions.h"
#include "sim/field.h"

namespace espalier::sim {

/// The weighted fraction of `directions` that reach the world's edge, for every voxel at once: exactly what
/// casting each of the rays from each voxel's centre gives (sim/sense/exposure.h), at a cost in proportion to
/// the voxels and not to the length of the rays.
///
/// Along a direction v, with o_1 .. o_m = v the voxels crossed in one period (LatticeDirection::crossed),
///     blocked(p) = occupied(p + o_1) or .. or occupied(p + o_m) or blocked(p + v),
/// computed for 64 voxels in a word, from the top slice down. Outside the world nothing is occupied or
/// blocked. Parallel over directions; sums are whole numbers, so that the answer does not depend on the
/// threads.
ExposureField sweepExposure(const BitVolume& occupied, const DirectionSet& directions);

}  // namespace espalier::sim
