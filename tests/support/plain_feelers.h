#pragma once
#include <cmath>
#include <vector>

#include "sim/sense/feelers.h"
#include "sim/sense/intersection.h"
#include "sim/tile/tiling.h"
#include "sim/world/world.h"

/// Segments felt along one by one: what the lanes of sim/sense/feelers must give bit for bit.
namespace espalier::tests {

/// What becomes of a segment, and its mean distance to the scene in whole numbers of 1/256 voxel width.
struct PlainFelt {
  sim::Fit fate = sim::Fit::clear;
  float proximity_vx = 0.0f;
};
inline PlainFelt plainFeel(const sim::World& world, sim::Vec3 from_vx, sim::Vec3 to_vx,
                           const std::vector<sim::Voxel>& attachment, sim::Passage passage,
                           int plant = sim::kNoPlant) {
  std::vector<sim::Voxel> passes, takes;
  sim::tileSegment(from_vx, to_vx, passes);
  switch (sim::fit(world, passes, attachment, passage, plant, takes)) {
    case sim::Fit::outside:
      return {sim::Fit::outside};
    case sim::Fit::blocked:
      return {sim::Fit::blocked};
    case sim::Fit::clear:
      break;
  }
  if (takes.empty()) return {sim::Fit::blocked};
  long sum = 0;
  for (const sim::Voxel v : passes) {
    const auto near = world.nearnessAt(v);
    sum += near ? std::lrint(static_cast<double>(near->distance_vx) * 256.0) : 256 * (world.layers() + 1);
  }
  return {sim::Fit::clear,
          static_cast<float>(sum) / static_cast<float>(256 * static_cast<long>(passes.size()))};
}

}  // namespace espalier::tests
