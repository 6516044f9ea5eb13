#pragma once
#include <optional>

#include "sim/base/bits.h"

namespace espalier::sim {

/// Farther than any voxel of a volume is from any other.
inline constexpr int kAnywhere = 1 << 20;

/// The nearest voxel that is set, by the distance between its centre and that of another one, which may lie
/// outside of the volume; of equally near ones the first in rows (beforeInRows). Nothing where none is nearer
/// than or at `most` voxel widths (0 .. kAnywhere). Looks at rows of bits in growing rings about the voxel.
std::optional<Voxel> nearestSet(const BitVolume& bits, Voxel from, int most = kAnywhere);

/// Its distance, voxel widths.
std::optional<double> distanceToNearest(const BitVolume& bits, Voxel from, int most);

}  // namespace espalier::sim
