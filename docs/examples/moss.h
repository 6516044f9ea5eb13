#pragma once
#include <memory>

#include "sim/grow/process.h"

namespace espalier::examples {

/// Moss creeps over what stands in the world, as cushions one voxel apart, where it sees no more of the sky
/// than `most_sky` (0..1). The world needs a boundary layer.
std::shared_ptr<const sim::Process> makeMoss(double most_sky);

}  // namespace espalier::examples
