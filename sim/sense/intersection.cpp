#include "sim/sense/intersection.h"

#include <algorithm>

namespace espalier::sim {

Fit fit(const World& world, std::span<const Voxel> piece, std::span<const Voxel> attachment, Passage passage,
        std::vector<Voxel>& takes) {
  const auto& occupied = world.occupied();
  takes.clear();
  for (const Voxel v : piece) {
    if (!contains(occupied.size(), v)) return Fit::outside;
    if (!occupied.at(v)) {
      takes.push_back(v);
    } else if (passage == Passage::around &&
               std::find(attachment.begin(), attachment.end(), v) == attachment.end()) {
      return Fit::blocked;
    }
  }
  return Fit::clear;
}

}  // namespace espalier::sim
