#include "scenes/show/voxel_colours.h"

#include <algorithm>
#include <cmath>
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

/// How slanting the sun falls on the faces of cubes along a surface, in the mean over what an eye sees of
/// them. Along every axis the surface has as much of them as its normal has of the axis. Those that look away
/// hide a part of the others, from the eye as from the sun: both from the same edges on, so that of what they
/// hide along an axis the smaller part lies in the larger.
float slantOfCubes(const sim::Vec3& normal, const sim::Vec3& to_eye, const sim::Vec3& to_sun) {
  double seen = 0.0, sunny = 0.0, both = 0.0;
  sim::Vec3 hidden(0.0), dark(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const double area = std::abs(normal[axis]), side = normal[axis] > 0.0 ? 1.0 : -1.0;
    const double eye = side * to_eye[axis], sun = side * to_sun[axis];
    seen += area * std::max(0.0, eye);
    sunny += area * std::max(0.0, sun);
    both += area * std::max(0.0, eye) * std::max(0.0, sun);
    hidden[axis] = area * std::max(0.0, -eye);
    dark[axis] = area * std::max(0.0, -sun);
  }
  const double turned = glm::dot(normal, to_eye), own = std::max(0.0, glm::dot(normal, to_sun));
  if (turned <= 0.0 || own <= 0.0) return static_cast<float>(own);
  double dark_seen = 0.0;  // share of what the eye sees
  for (int axis = 0; axis < 3; ++axis) {
    const double unseen = hidden[axis] / seen;
    dark_seen += std::max(0.0, dark[axis] / sunny - unseen) / (1.0 - unseen);
  }
  return static_cast<float>(both / seen * std::max(0.0, 1.0 - dark_seen));
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

VoxelColours::Light VoxelColours::lightOf(sim::Voxel v, const sim::Vec3* to_eye) const {
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
  if (kinds_[0].occupied.at(v) && light_.where->has(v)) {
    const sim::Vec3 normal(light_.surfaces[light_.where->number(v)].surface.normal);
    return own(to_eye != nullptr ? slantOfCubes(normal, *to_eye, to_sun_) : slantOf(normal));
  }
  sim::Colour ambient(0.0f);
  float faces = 0.0f, sun = 0.0f, slants = 0.0f;
  float seen = 0.0f, seen_sun = 0.0f;
  for (std::uint8_t face = 0; face < sim::kFaces; ++face) {
    if (world_.occupied().at(v + sim::kFaceNormals[face])) continue;
    ambient += ambientAtFace(v, face);
    faces += 1.0f;
    const float slant = slantOf(sim::Vec3(sim::kFaceNormals[face]));
    const float sunlit = slant > 0.0f ? slant * light_.atFace(light_.sun_now, v, face) : 0.0f;
    sun += sunlit;
    slants += slant;
    if (to_eye == nullptr) continue;
    const auto turned =
        static_cast<float>(std::max(0.0, glm::dot(sim::Vec3(sim::kFaceNormals[face]), *to_eye)));
    seen += turned;
    seen_sun += turned * sunlit;
  }
  if (seen > 0.0f) return {ambient / faces, seen_sun / seen};
  if (faces == 0.0f) return own(kMeanSlant);  // a leaf among leaves, with free space before these
  return {ambient / faces, slants > 0.0f ? kMeanSlant * sun / slants : 0.0f};
}

sim::Colour VoxelColours::lightOnto(sim::Voxel voxel, sim::PartKind kind, const sim::Vec3* to_eye) const {
  const Kind& own = kinds_[static_cast<std::size_t>(kind)];
  const auto occupied = sim::nearestSet(own.occupied, voxel);
  const auto lit_at = occupied ? sim::nearestSet(own.lit, *occupied) : std::nullopt;
  const Light light = lit_at ? lightOf(*lit_at, to_eye) : Light();
  return light.ambient + light.sun * render::firstPassLight().sun;
}

sim::Colour VoxelColours::lightSeen(sim::Vec3 to_eye, sim::Voxel voxel, sim::PartKind kind) const {
  return lightOnto(voxel, kind, &to_eye);
}

sim::Colour VoxelColours::sentOn(const sim::Colour& light, sim::Voxel voxel, sim::PartKind kind) const {
  const auto occupied = sim::nearestSet(kinds_[static_cast<std::size_t>(kind)].occupied, voxel);
  if (!occupied) return sim::Colour(0.0f);
  const sim::Colour emitted = lit_.emitted ? lit_.emitted->at(*occupied) : sim::Colour(0.0f);
  return emitted + world_.surfaceAt(*occupied)->colour * light;
}

sim::Colour VoxelColours::at(sim::Voxel voxel, sim::PartKind kind) const {
  if (kind_ == ImageKind::surface_colour) {
    const auto occupied = sim::nearestSet(kinds_[static_cast<std::size_t>(kind)].occupied, voxel);
    return occupied ? world_.surfaceAt(*occupied)->colour : sim::Colour(0.0f);
  }
  const sim::Colour lit = sentOn(lightOnto(voxel, kind, nullptr), voxel, kind);
  const render::ToneCurve tone;
  return {tone(lit.r), tone(lit.g), tone(lit.b)};
}

}  // namespace espalier::scenes
