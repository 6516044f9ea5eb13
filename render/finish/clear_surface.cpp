#include "render/finish/clear_surface.h"

#include <algorithm>

namespace espalier::render {

float filmMirror(float facing) {
  constexpr float kOnce = 0.02f;  // ((1.33 - 1) / (1.33 + 1))^2
  const float grazing = 1.0f - std::clamp(facing, 0.0f, 1.0f);
  const float squared = grazing * grazing;
  const float face = kOnce + (1.0f - kOnce) * squared * squared * grazing;
  return 2.0f * face / (1.0f + face);
}

sim::Colour mirroredIn(const Daylight& light, sim::Colour ground, sim::Vec3f direction) {
  constexpr float kHorizon = 4.0f;  // how soon it is all ground below it
  const sim::Colour sky = skySeen(light, direction);
  return glm::mix(sky, ground, std::clamp(-kHorizon * direction.y, 0.0f, 1.0f));
}

float sunGlint(sim::Vec3f reflected, sim::Vec3f to_sun) {
  constexpr int kSquared = 10;  // a lobe of cos^1024: two degrees, as of a surface that is nearly smooth
  constexpr float kStrength = 4.0f;
  float lobe = std::max(0.0f, glm::dot(reflected, to_sun));
  for (int i = 0; i < kSquared; ++i) lobe *= lobe;
  return kStrength * lobe;
}

}  // namespace espalier::render
