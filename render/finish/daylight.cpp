#include "render/finish/daylight.h"

#include <algorithm>
#include <cmath>

namespace espalier::render {

using sim::Vec3;
using sim::Vec3f;

Daylight daylightOf(Vec3 to_sun, const DaylightShare& share) {
  Daylight light;
  light.to_sun = Vec3f(glm::normalize(to_sun));
  light.sun *= light.to_sun.y > 0.0f ? share.sun : sim::Colour(0.0f);
  for (sim::Colour* of_sky : {&light.zenith_light, &light.side_light, &light.horizon, &light.zenith})
    *of_sky *= share.sky;
  return light;
}

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
  sim::Voxel low(p_vx);
  low -= sim::Voxel(p_vx.x < low.x, p_vx.y < low.y, p_vx.z < low.z);
  const Vec3f above(p_vx - Vec3(low)), below = 1.0f - above;
  const sim::Voxel first = glm::clamp(low, sim::Voxel(0), frame_.size - 1),
                   second = glm::clamp(low + 1, sim::Voxel(0), frame_.size - 1);
  float sum = 0.0f, weights = 0.0f;
  const auto addRow = [&](int y, int z, float weight) {
    const std::uint64_t* const taken = occupied_.row(y, z);
    float row_sum = 0.0f, row_weights = 0.0f;
    const auto add = [&](int x, float share) {
      if (((taken[x >> 6] >> (x & 63)) & 1u) != 0) return;
      row_sum += share * static_cast<float>(sky_.values[sky_.index({x, y, z})]);
      row_weights += share;
    };
    add(first.x, below.x);
    add(second.x, above.x);
    sum += weight * row_sum;
    weights += weight * row_weights;
  };
  addRow(first.y, first.z, below.y * below.z);
  addRow(second.y, first.z, above.y * below.z);
  addRow(first.y, second.z, below.y * above.z);
  addRow(second.y, second.z, above.y * above.z);
  if (weights < 0.02f) return false;
  exposure = sum / (weights * sim::ExposureField::kWhole);
  return true;
}

float SkyView::at(Vec3 p_m, Vec3f normal) const {
  const Vec3 p = sim::voxelFromWorld(frame_, p_m);
  // Beyond the world's edge nothing is known. A place far out sees over what stands near the edge, as one
  // that is as far up does; and it eases to an open sky over the world's own size.
  const Vec3 inside = glm::clamp(p, Vec3(0.0), last_);
  const double beyond = p == inside ? 0.0 : glm::distance(p, inside);
  const Vec3 known = glm::clamp(inside + Vec3(0.0, beyond, 0.0), Vec3(0.0), last_);
  float exposure = 0.0f;
  bool found = false;
  for (const double step : {1.0, 1.7, 2.5, 0.3}) {
    found = amongFree(known + step * Vec3(normal), exposure);
    if (found) break;
  }
  if (!found) return 0.05f;  // buried in foliage
  const float open = std::min(1.0f, static_cast<float>(beyond / open_at_vx_));
  return exposure + (1.0f - exposure) * open * (2.0f - open);
}

}  // namespace espalier::render
