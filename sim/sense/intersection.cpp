#include "sim/sense/intersection.h"

#include <algorithm>

namespace espalier::sim {

Fit fit(const World& world, std::span<const Voxel> piece, std::span<const Voxel> attachment, Passage passage,
        int gives_way, std::vector<Voxel>& takes) {
  const BitVolume &occupied = world.occupied(), &solid = world.solid();
  const auto gives = [&](Voxel v) { return !solid.at(v) && world.part(world.partAt(v)).plant == gives_way; };
  takes.clear();
  takes.reserve(piece.size());
  for (const Voxel v : piece) {
    if (!contains(occupied.size(), v)) return Fit::outside;
    if (!occupied.at(v) || gives(v)) {
      takes.push_back(v);
    } else if (passage == Passage::around &&
               std::find(attachment.begin(), attachment.end(), v) == attachment.end()) {
      return Fit::blocked;
    }
  }
  return Fit::clear;
}

}  // namespace espalier::sim
