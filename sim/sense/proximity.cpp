#include "sim/sense/proximity.h"

namespace espalier::sim {

Vec3 awayFromScene(const World& world, Voxel v) {
  const NearSteps near = world.nearSteps();
  const Voxel size = world.frame().size;
  const int beyond = NearSteps::kInVoxel * (world.layers() + 1);
  constexpr double kOver[] = {0.0, 1.0, 0.5};  // 1 over the square of the step; a third is rounded
  Vec3 gradient(0.0);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Voxel step(dx, dy, dz);
        const int square = dx * dx + dy * dy + dz * dz;
        if (square == 0) continue;
        const int distance = contains(size, v + step) ? near.at(v + step) : beyond;
        const double share = square == 3 ? distance / 3.0 : distance * kOver[square];
        gradient += Vec3(step) * share;
      }
    }
  }
  const double length = glm::length(gradient);
  return length > 1e-6 ? gradient / length : Vec3(0.0);
}

double meanProximity(const World& world, std::span<const Voxel> voxels) {
  const NearSteps near = world.nearSteps();
  std::int32_t sum = 0;
  for (const Voxel v : voxels) sum += near.at(v);
  return static_cast<float>(sum) /
         static_cast<float>(static_cast<std::int32_t>(voxels.size()) * NearSteps::kInVoxel);
}

}  // namespace espalier::sim
