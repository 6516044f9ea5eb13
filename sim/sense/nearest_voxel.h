#pragma once
#include <optional>

#include "sim/base/bits.h"

namespace espalier::sim {

/// The distance between the centres of a voxel and of the nearest one that is set, voxel widths; nothing
/// where none is nearer than or at `most` (at least 0). Looks at rows of bits in growing rings about the
/// voxel, which may lie outside of the volume.
std::optional<double> distanceToNearest(const BitVolume& bits, Voxel from, int most);

}  // namespace espalier::sim
