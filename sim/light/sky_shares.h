#pragma once
#include <cstdint>
#include <vector>

#include "sim/base/vec.h"
#include "sim/sweep/directions.h"
#include "sim/world/field.h"

/// What part of the sky each direction of a set stands for.
namespace espalier::sim {

/// Each direction's part of the hemisphere y >= 0: the part that is nearer to it than to any other (its
/// spherical Voronoi cell, by clipping). Unit vectors, y > 0, no two alike. They add up to 1.
std::vector<double> voronoiShares(const std::vector<Vec3>& units);

/// Changes the shares as little as may be, each in proportion to itself, so that they integrate 1, x, y, z
/// and y^2 over the hemisphere exactly: sums of 1, 0, 1/2, 0 and 1/3. Leaves them alone where that cannot be
/// done without a negative share (fewer than about 16 directions).
void meetMoments(const std::vector<Vec3>& units, std::vector<double>& shares);

/// The shares as whole numbers that add up to ExposureField::kWhole, each at most one unit from its share,
/// rounded up or down so that the sums of x, y, z and y^2 move as little as may be.
std::vector<std::uint16_t> wholeShares(const std::vector<Vec3>& units, const std::vector<double>& shares);

/// A weight as a share again.
inline double shareOf(const LatticeDirection& direction) {
  return static_cast<double>(direction.weight) / ExposureField::kWhole;
}

}  // namespace espalier::sim
