#pragma once
#include <optional>

#include "sim/base/bits.h"

namespace espalier::sim {

/// The voxel nearest to one in a volume that is set there, by the distance between their centres; of equally
/// near ones the first in rows (beforeInRows). None where none is set. `from` must lie inside.
std::optional<Voxel> nearestSet(const BitVolume& volume, Voxel from);

}  // namespace espalier::sim
