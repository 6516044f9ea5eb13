#include "scenes/show/voxel_colours.h"

#include <algorithm>
#include <cstdint>

#include "render/image/tone.h"
#include "render/voxels/panels.h"
#include "sim/base/faces.h"
#include "sim/sense/nearest_voxel.h"

namespace espalier::scenes {
namespace {

/// What is set in the first alone.
sim::BitVolume without(sim::BitVolume set, const sim::BitVolume& other) {
  set.remove(other);
  return set;
}

}  // namespace

VoxelColours::VoxelColours(const sim::World& world, const sim::BitVolume& bare, const sim::Lighting& light,
                           const PictureLight& lit, ImageKind kind, sim::Vec3 to_sun)
    : world_(world),
      light_(light),
      lit_(lit),
      kind_(kind),
      to_sun_(to_sun),
      kinds_{Kind{bare, {}}, Kind{without(world.solid(), bare), {}},
             Kind{without(world.occupied(), world.solid()), {}}} {
  for (Kind& one : kinds_) {
    if (one.occupied.count() == 0) one.occupied = world.occupied();
  }
  if (kind == ImageKind::surface_colour) return;
  sim::BitVolume judged = light.where->bits();
  judged.add(light.gaps->bits());
  for (Kind& one : kinds_) {
    one.lit = one.occupied;
    one.lit.keep(judged);
  }
}

sim::Colour VoxelColours::ambientAtFace(sim::Voxel voxel, std::uint8_t face) const {
  if (!lit_.first_pass) return light_.atFace(light_.sky, voxel, face) * render::firstPassLight().sky;
  const BouncedLight& bounced = *lit_.first_pass;
  return {bounced.ambientAtFace(voxel, face, 0), bounced.ambientAtFace(voxel, face, 1),
          bounced.ambientAtFace(voxel, face, 2)};
}

VoxelColours::Light VoxelColours::lightOf(sim::Voxel v) const {
  // What faces every way turns, in the mean, half of what the sun sees of it towards the sun.
  constexpr float kMeanSlant = 0.5f;
  const auto slantOf = [&](const sim::Vec3& normal) {
    return static_cast<float>(std::max(0.0, glm::dot(normal, to_sun_)));
  };
  const auto own = [&](float slant) -> Light {
    const std::size_t number = light_.where->number(v);
    const sim::Colour ambient = lit_.first_pass ? lit_.first_pass->ambientOf(number)
                                                : light_.sky.values[number] * render::firstPassLight().sky;
    return {ambient, slant * light_.sun_now.values[number]};
  };
  if (kinds_[0].occupied.at(v) && light_.where->has(v))
    return own(slantOf(sim::Vec3(light_.surfaces[light_.where->number(v)].surface.normal)));
  sim::Colour ambient(0.0f);
  float faces = 0.0f, sun = 0.0f, slants = 0.0f;
  for (std::uint8_t face = 0; face < sim::kFaces; ++face) {
    if (world_.occupied().at(v + sim::kFaceNormals[face])) continue;
    ambient += ambientAtFace(v, face);
    faces += 1.0f;
    const float slant = slantOf(sim::Vec3(sim::kFaceNormals[face]));
    if (slant > 0.0f) sun += slant * light_.atFace(light_.sun_now, v, face);
    slants += slant;
  }
  if (faces == 0.0f) return own(kMeanSlant);  // a leaf among leaves, with free space before these
  return {ambient / faces, slants > 0.0f ? kMeanSlant * sun / slants : 0.0f};
}

sim::Colour VoxelColours::at(sim::Voxel voxel, sim::PartKind kind) const {
  if (kind_ == ImageKind::surface_colour) {
    const auto occupied = sim::nearestSet(kinds_[static_cast<std::size_t>(kind)].occupied, voxel);
    return occupied ? world_.surfaceAt(*occupied)->colour : sim::Colour(0.0f);
  }
  const sim::Colour lit = lightAt(voxel, kind);
  const render::ToneCurve tone;
  return {tone(lit.r), tone(lit.g), tone(lit.b)};
}

sim::Colour VoxelColours::lightAt(sim::Voxel voxel, sim::PartKind kind) const {
  const Kind& own = kinds_[static_cast<std::size_t>(kind)];
  const auto occupied = sim::nearestSet(own.occupied, voxel);
  if (!occupied) return sim::Colour(0.0f);
  const sim::Colour colour = world_.surfaceAt(*occupied)->colour;
  const auto lit_at = sim::nearestSet(own.lit, *occupied);
  const Light light = lit_at ? lightOf(*lit_at) : Light();
  const sim::Colour emitted = lit_.emitted ? lit_.emitted->at(*occupied) : sim::Colour(0.0f);
  return emitted + colour * (light.ambient + light.sun * render::firstPassLight().sun);
}

}  // namespace espalier::scenes
