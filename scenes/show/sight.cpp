#include "scenes/show/sight.h"

#include "sim/world/ray.h"

namespace espalier::scenes {
namespace {

constexpr double kBefore = 1.5;  // voxel widths: what is so near does not hide

}  // namespace

Sight::Sight(const sim::World& world, const sim::BitVolume& bare, const sim::Bricks& bricks, sim::Vec3 eye_m)
    : world_(world), bare_(bare), bricks_(bricks), eye_vx_(sim::voxelFromWorld(world.frame(), eye_m)) {}

bool Sight::hides(sim::Vec3 at_m) const {
  sim::Vec3 at = sim::voxelFromWorld(world_.frame(), at_m);
  const sim::Voxel voxel = sim::voxelAt(at);
  if (bare_.at(voxel)) {
    const auto surface = world_.surfaceAt(voxel);
    const sim::Vec3 normal = surface ? sim::Vec3(surface->normal) : sim::Vec3(0.0);
    at += (glm::dot(normal, eye_vx_ - at) < 0.0 ? -kBefore : kBefore) * normal;
  }
  const double distance = glm::length(at - eye_vx_);
  if (!(distance > kBefore)) return false;
  const auto hit = sim::firstHit(bare_, bricks_, eye_vx_, (at - eye_vx_) / distance);
  return hit && hit->t < distance - kBefore;
}

}  // namespace espalier::scenes
