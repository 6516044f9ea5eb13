#include "sim/grow/retiled.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "sim/base/stop.h"
#include "sim/tile/tiling.h"

namespace espalier::sim {
namespace {

/// What plants have in the world that they grew in, but for stems of those that have changed.
std::vector<TiledVoxel> keptOf(const World& grown, const std::vector<bool>& changed) {
  std::vector<TiledVoxel> kept;
  const BitVolume& taken = grown.inPlants();
  for (int y = 0; y < taken.size().y; ++y) {
    throwIfStopped();
    for (int z = 0; z < taken.size().z; ++z) {
      for (int w = 0; w < taken.rowWords() - 1; ++w) {
        for (std::uint64_t word = taken.row(y, z)[w]; word != 0; word &= word - 1) {
          const Voxel v(w * BitVolume::kWordBits + std::countr_zero(word), y, z);
          const Surface surface = *grown.surfaceAt(v);
          const Part& part = grown.part(surface.part);
          if (part.kind != PartKind::stem || !changed[static_cast<std::size_t>(part.plant)])
            kept.push_back({v, surface});
        }
      }
    }
  }
  return kept;
}

}  // namespace

std::vector<Voxel> stemVoxels(const Skeleton& skeleton) {
  std::vector<Voxel> voxels;
  for (std::size_t n = 0; n < skeleton.parent.size(); ++n) {
    if (skeleton.parent[n] == kNoNode) continue;
    tileSegment(skeleton.position_vx[static_cast<std::size_t>(skeleton.parent[n])], skeleton.position_vx[n],
                voxels);
  }
  std::sort(voxels.begin(), voxels.end(), beforeInRows);
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  return voxels;
}

Surface stemSurface(const Plant& plant) {
  return {plant.stem_part, plant.stem_colour, static_cast<float>(std::min(1.0, 2.0 * plant.girth.twig_vx)),
          Vec3f(0.0f)};
}

World retiled(World before, const World& grown, std::span<const Plant> plants,
              const std::vector<bool>& changed) {
  for (std::size_t i = before.parts().size(); i < grown.parts().size(); ++i) before.addPart(grown.parts()[i]);
  std::vector<TiledVoxel> stand = keptOf(grown, changed);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    if (!changed[i]) continue;
    const Surface surface = stemSurface(plants[i]);
    for (const Voxel v : stemVoxels(plants[i].skeleton)) stand.push_back({v, surface});
  }
  before.occupy(stand);
  return before;
}

}  // namespace espalier::sim
