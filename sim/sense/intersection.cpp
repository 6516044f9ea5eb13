#include "sim/sense/intersection.h"

#include <algorithm>

namespace espalier::sim {

Fit fit(const World& world, std::span<const Voxel> piece, std::span<const Voxel> attachment, Passage passage,
        int plant, std::vector<Voxel>& takes) {
  const BitVolume &occupied = world.occupied(), &solid = world.solid();
  const auto own = [&](Voxel v) { return world.part(world.partAt(v)).plant == plant; };
  takes.clear();
  takes.reserve(piece.size());
  for (const Voxel v : piece) {
    if (!contains(occupied.size(), v)) return Fit::outside;
    if (!occupied.at(v) || (!solid.at(v) && own(v))) {
      takes.push_back(v);
    } else if (passage == Passage::past_own
                   ? !own(v)
                   : passage == Passage::around &&
                         std::find(attachment.begin(), attachment.end(), v) == attachment.end()) {
      return Fit::blocked;
    }
  }
  return Fit::clear;
}

}  // namespace espalier::sim
