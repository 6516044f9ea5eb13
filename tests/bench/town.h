#pragma once
#include "sim/base/bits.h"

namespace espalier::bench {

/// A town in a world of this size: ground, and houses of all heights along streets. The same for the same
/// size.
sim::BitVolume town(sim::Voxel size);

}  // namespace espalier::bench
