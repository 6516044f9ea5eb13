#include "sim/sense/mass.h"

#include <cstdint>

namespace espalier::sim {

std::optional<Vec3> centreOfMass(const BitVolume& occupied, Voxel about, double radius_vx) {
  const int reach = static_cast<int>(radius_vx);
  const double square = radius_vx * radius_vx;
  glm::i64vec3 sum(0);  // whole numbers: the order of summing does not matter
  std::int64_t count = 0;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dz = -reach; dz <= reach; ++dz) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const Voxel step(dx, dy, dz);
        if (dx * dx + dy * dy + dz * dz > square || !occupied.at(about + step)) continue;
        sum += glm::i64vec3(step);
        ++count;
      }
    }
  }
  if (count == 0) return std::nullopt;
  return Vec3(about) + Vec3(sum) / static_cast<double>(count);
}

}  // namespace espalier::sim
