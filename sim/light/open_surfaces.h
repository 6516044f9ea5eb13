#pragma once
#include <bit>
#include <cstdint>

#include "sim/world/world.h"

/// Surface voxels that are not deep inside of something, where no light gets in.
namespace espalier::sim {

/// Whether all voxels around take light.
bool isBuried(const BitVolume& opaque, Voxel voxel);
/// The same for 64 voxels of a row at once.
std::uint64_t buriedBits(const BitVolume& opaque, int y, int z, int word);

/// Calls visit(voxel with its surface) for those of one y and of z from z0 to z1 - 1 that are not buried,
/// until it answers false.
template <class Visit>
void forEachOpenSurface(const World& world, int y, int z0, int z1, Visit visit) {
  for (int z = z0; z < z1; ++z) {
    const std::uint64_t* const row = world.occupied().row(y, z);
    for (int i = 0; i < world.occupied().rowWords() - 1; ++i) {
      for (std::uint64_t word = row[i] & ~buriedBits(world.opaque(), y, z, i); word != 0; word &= word - 1) {
        const Voxel v(i * BitVolume::kWordBits + std::countr_zero(word), y, z);
        if (!visit(TiledVoxel{v, *world.surfaceAt(v)})) return;
      }
    }
  }
}

}  // namespace espalier::sim
