#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "sim/base/vec.h"

/// Directions to the sky and to the sun. Every direction runs along a primitive integer vector, so that the
/// voxels which a ray crosses repeat with that vector as their period, wherever the ray starts.
namespace espalier::sim {

struct LatticeDirection {
  Voxel v{0, 1, 0};  ///< primitive; |component| <= kLongestComponent
  std::vector<Voxel>
      crossed;  ///< the voxels that a ray from the centre of voxel 0 crosses on its way to the centre
                ///< of voxel v, without the first and with the last (ties as in sim/tile/tiling.h)
  std::uint16_t weight = 0;
};

inline constexpr int kLongestComponent = 63;  ///< a sweep reads at most a word to either side

/// Directions whose weights add up to at most ExposureField::kWhole. With none of them every exposure is 0.
using DirectionSet = std::vector<LatticeDirection>;

/// The primitive vector with v.y >= 1 and components up to `longest` whose direction is nearest to a unit
/// vector.
Voxel nearestLatticeVector(Vec3 unit, int longest);

/// Calls visit for primitive vectors that lie around a unit vector, their longest component growing from 1 to
/// kLongestComponent, until it returns false: among the vectors of one size, those on every side of the unit
/// vector. v.y >= lowest, which is 0 or 1; some come more than once.
void forEachLatticeVector(Vec3 unit, int lowest, const std::function<bool(int longest, Voxel v)>& visit);

/// The sine of the angle between a vector and a unit vector; 1 from a right angle on.
double sineBetween(Voxel v, Vec3 unit);

/// How many voxels a ray crosses in one period of v: what a sweep along it costs.
int crossedCount(Voxel v);

/// A set of these directions with whole-number weights in proportion to the shares, adding up to `total`:
/// what rounding leaves over goes to the largest remainders. Shares must not be negative; directions whose
/// weight comes to 0 stay in the set. Shares of nothing but 0 give weights of 0.
DirectionSet directionSet(const std::vector<Voxel>& vectors, const std::vector<double>& shares, int total);

/// How many whole periods of v fit between voxel p of a world and the world's edge.
int periodsInside(Voxel size, Voxel p, Voxel v);

/// Voxels crossed on one period of v: LatticeDirection::crossed.
std::vector<Voxel> crossedVoxels(Voxel v);

}  // namespace espalier::sim
