#include "render/finish/daylight.h"

#include <algorithm>
#include <cmath>

namespace espalier::render {

using sim::Vec3;
using sim::Vec3f;

sim::Colour skySeen(const Daylight& light, Vec3f direction) {
  const float height = std::clamp(direction.y, 0.0f, 1.0f);
  const float veil = expf(-5.5f * height);  // haze thins out quickly above the horizon
  const sim::Colour base = glm::mix(light.zenith, light.horizon, veil);
  const float toward_sun = std::max(0.0f, glm::dot(direction, light.to_sun));
  const float halo = toward_sun * toward_sun * toward_sun * toward_sun;
  return base + 0.10f * halo * (1.0f - height) * light.sun;
}

/// The mean of the free voxels among the eight around a point; false where all are occupied.
bool SkyView::amongFree(Vec3 p_vx, float& exposure) const {
  const Vec3 low = glm::floor(p_vx);
  const Vec3f f(p_vx - low);
  const sim::Voxel corner(low);
  float sum = 0.0f, weights = 0.0f;
  for (int k = 0; k < 8; ++k) {
    const sim::Voxel step(k & 1, (k >> 1) & 1, k >> 2);
    const sim::Voxel v = glm::clamp(corner + step, sim::Voxel(0), frame_.size - 1);
    if (occupied_.at(v)) continue;
    const float weight =
        (step.x ? f.x : 1.0f - f.x) * (step.y ? f.y : 1.0f - f.y) * (step.z ? f.z : 1.0f - f.z);
    sum += weight * sky_.at(v);
    weights += weight;
  }
  if (weights < 0.02f) return false;
  exposure = sum / weights;
  return true;
}

float SkyView::at(Vec3 p_m, Vec3f normal) const {
  const Vec3 p = sim::voxelFromWorld(frame_, p_m);
  const Vec3 last(frame_.size - 1);
  // Beyond the world's edge nothing is known. A place far out sees over what stands near the edge, as one
  // that is as far up does; and it eases to an open sky over the world's own size.
  const Vec3 inside = glm::clamp(p, Vec3(0.0), last);
  const double beyond = glm::distance(p, inside);
  const Vec3 known = glm::clamp(inside + Vec3(0.0, beyond, 0.0), Vec3(0.0), last);
  float exposure = 0.0f;
  bool found = false;
  for (const double step : {1.0, 1.7, 2.5, 0.3}) {
    found = amongFree(known + step * Vec3(normal), exposure);
    if (found) break;
  }
  if (!found) return 0.05f;  // buried in foliage
  const float open = std::min(1.0f, static_cast<float>(beyond / (0.5 * glm::length(last))));
  return exposure + (1.0f - exposure) * open * (2.0f - open);
}

}  // namespace espalier::render
