#include "sim/sense/proximity.h"

namespace espalier::sim {
namespace {

double distanceAt(const World& world, Voxel v) {
  const auto nearness = world.nearnessAt(v);
  return nearness ? static_cast<double>(nearness->distance_vx) : world.layers() + 1.0;
}

}  // namespace

Vec3 awayFromScene(const World& world, Voxel v) {
  Vec3 gradient(0.0);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Vec3 step(dx, dy, dz);
        const double square = glm::dot(step, step);
        if (square > 0.0) gradient += step / square * distanceAt(world, v + Voxel(dx, dy, dz));
      }
    }
  }
  const double length = glm::length(gradient);
  return length > 1e-6 ? gradient / length : Vec3(0.0);
}

}  // namespace espalier::sim
