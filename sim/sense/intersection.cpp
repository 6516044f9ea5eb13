#include "sim/sense/intersection.h"

#include <algorithm>

namespace espalier::sim {

Fit fits(const World& world, std::span<const Voxel> voxels, const Attachment& attachment) {
  const auto& occupied = world.occupied();
  for (const Voxel v : voxels) {
    if (!contains(occupied.size(), v)) return Fit::outside;
    if (!occupied.at(v)) continue;
    if (std::find(attachment.parent.begin(), attachment.parent.end(), v) != attachment.parent.end()) continue;
    if (besides(v, attachment.at) && world.partAt(v) == attachment.stem) continue;
    return Fit::blocked;
  }
  return Fit::clear;
}

}  // namespace espalier::sim
