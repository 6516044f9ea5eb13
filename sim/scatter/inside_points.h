#pragma once
#include <cstddef>
#include <cstdint>

#include "sim/base/bits.h"
#include "sim/base/frame.h"
#include "sim/scatter/point_set.h"
#include "sim/tile/mesh.h"

namespace espalier::sim {

/// How far a mesh's inside is known.
struct InsideDoubt {
  double doubtful = 0.0;   ///< share of what may be inside for which lines along the axes contradict each
                           ///< other: there the mesh leaks, and a vote over thirteen directions decides
  double undecided = 0.0;  ///< share for which that vote has no majority of two thirds either
};

struct InsidePoints {
  PointSet points;
  InsideDoubt doubt;
};

/// A mesh's inside as cubes: those whose middles are inside.
struct InsideCells {
  Frame frame;
  BitVolume inside;
  InsideDoubt doubt;
};

/// More undecided than this, and both of the following throw.
inline constexpr double kMostUndecided = 0.5;

/// Points in a mesh, even by volume: where its distance, by a narrow band of OpenVDB with the sign that the
/// filling of solids gives (sim/tile/fill.cpp), is negative. So the mesh may be inside out and have holes.
/// Each point follows from the mesh, the stream and its number alone. Throws InputError for a mesh without an
/// inside, for one of whose inside more than kMostUndecided is a guess, for no points, and for more than
/// 2^32 - 1.
InsidePoints scatterWithin(const Mesh& mesh, std::size_t count, std::uint64_t stream);

/// The same inside, on the grid whose corners that distance has: 128 cells along the longest side, or finer
/// where the mesh is slender. Throws InputError for a mesh as above.
InsideCells cellsWithin(const Mesh& mesh);

}  // namespace espalier::sim
