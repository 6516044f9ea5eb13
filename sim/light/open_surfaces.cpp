#include "sim/light/open_surfaces.h"

namespace espalier::sim {

bool isBuried(const BitVolume& opaque, Voxel voxel) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (!opaque.at(voxel + Voxel(dx, dy, dz))) return false;
      }
    }
  }
  return true;
}

std::uint64_t buriedBits(const BitVolume& opaque, int y, int z, int word) {
  if (y == 0 || z == 0 || y + 1 == opaque.size().y || z + 1 == opaque.size().z) return 0;
  std::uint64_t all = ~std::uint64_t{0};
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dz = -1; dz <= 1; ++dz) {
      const std::uint64_t* const row = opaque.row(y + dy, z + dz) + word;  // zero words lie around a row
      all &= row[0] & (row[0] << 1 | row[-1] >> 63) & (row[0] >> 1 | row[1] << 63);
    }
  }
  return all;
}

}  // namespace espalier::sim
