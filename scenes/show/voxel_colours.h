#pragma once
#include <array>

#include "scenes/scene.h"
#include "scenes/show/bounced_light.h"
#include "sim/base/bits.h"
#include "sim/light/lighting.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// One colour for each voxel of a world, for models that are diced to it (render/model/diced.h): linear,
/// 0..1.
class VoxelColours {
 public:
  /// `kind`: surface_colour, as the voxel has it; or first_pass, lit and brought into 0..1 as the picture of
  /// that kind shows it, by what the voxel's own surface receives, or where it has none, as stems and leaves,
  /// by the mean of its open faces. Then `light` must know sun_now of `to_sun`. A voxel without open faces,
  /// among leaves, is lit as the nearest one that has some. `bare`: what the scene alone occupies. Borrows
  /// the world and both lights.
  VoxelColours(const sim::World& world, const sim::BitVolume& bare, const sim::Lighting& light,
               const PictureLight& lit, ImageKind kind, sim::Vec3 to_sun);

  /// For what lies in a voxel of the world and is of that kind of part: the voxel's colour, where such a part
  /// occupies it; else that of the nearest voxel where one does. A leaf in a stem's voxel is no less green.
  /// Where no such part has any voxel, everything's.
  sim::Colour at(sim::Voxel voxel, sim::PartKind kind) const;
  /// The light that falls onto what an eye sees of it, of first_pass: as much as onto the cubes that stand
  /// there, onto whose faces the sun falls slanting.
  sim::Colour lightSeen(sim::Vec3 to_eye, sim::Voxel voxel, sim::PartKind kind) const;
  /// What it sends on of such a light, linear, with what it sends out by itself.
  sim::Colour sentOn(const sim::Colour& light, sim::Voxel voxel, sim::PartKind kind) const;

 private:
  struct Light {
    sim::Colour ambient{0.0f};  // all but the sun's
    float sun = 0.0f;           // as render::firstPass has it
  };
  Light lightOf(sim::Voxel lit, const sim::Vec3* to_eye) const;
  sim::Colour lightOnto(sim::Voxel voxel, sim::PartKind kind, const sim::Vec3* to_eye) const;
  sim::Colour ambientAtFace(sim::Voxel voxel, std::uint8_t face) const;

  const sim::World& world_;
  const sim::Lighting& light_;
  const PictureLight& lit_;
  ImageKind kind_;
  sim::Vec3 to_sun_;
  struct Kind {
    sim::BitVolume occupied, lit;
  };
  std::array<Kind, 3> kinds_;  // scene, stems and elements; of these what has light
};

}  // namespace espalier::scenes
