#pragma once
#include <vector>

#include "render/finish/ray_scene.h"
#include "sim/base/vec.h"

namespace espalier::render {

/// What a surface does with light at one point.
struct Look {
  sim::Colour albedo{0.5f};
  sim::Colour through{0.0f};  ///< share of the light from behind that comes through: thin blades only
  float gloss = 0.0f;         ///< strength of the waxy sheen
};

/// Smooth keyed noise in space, -1..1, repeating every 32 units: a small table, so that a look-up costs
/// little.
class Noise {
 public:
  Noise();
  float operator()(sim::Vec3f p) const;

 private:
  std::vector<float> table_;
};

/// Masonry: the material's colour, weathered a little.
Look stoneLook(const Noise& noise, sim::Colour base, sim::Vec3f p_m);
/// The ground that carries on, calm: grain and the faintest of stains.
Look groundLook(const Noise& noise, sim::Colour base, sim::Vec3f p_m);
/// Bark, greener towards young ends; p in metres.
Look barkLook(const Noise& noise, const ModelMesh& mesh, const SurfaceHit& hit, sim::Vec3f p_m);
/// Leaves by their pictures, and else in their colour with a pale midrib; each in its own tint. `pixel_m`:
/// how much of it a pixel spans.
Look bladeLook(const Surface& blade, const SurfaceHit& hit, float pixel_m);
/// A blade's normal as if its flat polygons were gently domed across and drooping at the tip. Not of unit
/// length.
sim::Vec3f bulgedNormal(const ModelMesh& mesh, const SurfaceHit& hit);

}  // namespace espalier::render
