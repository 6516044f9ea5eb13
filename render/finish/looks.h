#pragma once
#include "render/finish/ray_scene.h"
#include "render/image/noise.h"
#include "sim/base/vec.h"

namespace espalier::render {

/// What a surface does with light at one point.
struct Look {
  sim::Colour albedo{0.5f};
  sim::Colour through{0.0f};  ///< share of the light from behind that comes through: thin blades only
  float gloss = 0.0f;         ///< strength of the waxy sheen
  sim::Colour emits{0.0f};    ///< light of its own
  float alpha = 1.0f;         ///< how much of what is behind it it hides
};

/// A scene's surface: by its texture where it has one, else in its material's colour, weathered a little. p
/// in metres. `pixel_m`: how much of it a pixel spans.
Look sceneLook(const Noise& noise, const Surface& surface, const SurfaceHit& hit, sim::Vec3f p_m,
               float pixel_m);
/// The ground that carries on, calm: grain and the faintest of stains.
Look groundLook(const Noise& noise, sim::Colour base, sim::Vec3f p_m);
/// Bark by its picture, else in its colour with a few streaks; greener towards young ends. p in metres.
/// `pixel_m`: how much of it a pixel spans.
Look barkLook(const Noise& noise, const Surface& stem, const SurfaceHit& hit, sim::Vec3f p_m, float pixel_m);
/// Bodies that were laid or placed, such as stones: by their pictures, else in their colour, weathered as a
/// scene's surfaces are; each in its own tint. p in metres.
Look bodyLook(const Noise& noise, const Surface& body, const SurfaceHit& hit, sim::Vec3f p_m, float pixel_m);
/// Leaves by their pictures, and else in their colour with a pale midrib; each in its own tint. `pixel_m`:
/// how much of it a pixel spans.
Look bladeLook(const Surface& blade, const SurfaceHit& hit, float pixel_m);
/// A blade's normal as if its flat polygons were gently domed across and drooping at the tip. Not of unit
/// length.
sim::Vec3f bulgedNormal(const ModelMesh& mesh, const SurfaceHit& hit);
/// A place of a facet as high as the smooth surface is for which it stands: on the mean between the planes
/// that touch that at the corners (Hanika, Hacking the shadow terminator, Ray Tracing Gems II, 2021). Shadows
/// that began on facets would end along their edges.
sim::Vec3f raised(const ModelMesh& mesh, const SurfaceHit& hit, sim::Vec3f p_m);
sim::Vec3f raised(const sim::Mesh& mesh, const SurfaceHit& hit, sim::Vec3f p_m);

}  // namespace espalier::render
