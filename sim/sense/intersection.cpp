#include "sim/sense/intersection.h"

#include <algorithm>

namespace espalier::sim {

Fit fits(const World& world, std::span<const Voxel> voxels, std::span<const Voxel> attachment) {
  const auto& occupied = world.occupied();
  for (const Voxel v : voxels) {
    if (!contains(occupied.size(), v)) return Fit::outside;
    if (!occupied.at(v)) continue;
    if (std::find(attachment.begin(), attachment.end(), v) == attachment.end()) return Fit::blocked;
  }
  return Fit::clear;
}

}  // namespace espalier::sim
