#include "sim/base/random.h"

#include <Random123/philox.h>

#include <cmath>

namespace espalier::sim {

// Bits 12 to 31 of the last counter word tell purpose and trial apart, the lower ones count blocks of four
// numbers.
Draws::Draws(const RandomKey& key, Purpose purpose, std::uint32_t trial)
    : counter_{key.plant, key.agent, key.iteration,
               (static_cast<std::uint32_t>(purpose) << 28) | ((trial & 0xffffu) << 12)},
      key_{static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32)} {}

void Draws::refill() {
  const r123::Philox4x32::ctr_type counter{{counter_[0], counter_[1], counter_[2], counter_[3]}};
  const r123::Philox4x32::key_type key{{key_[0], key_[1]}};
  const auto block = r123::Philox4x32()(counter, key);
  for (std::size_t i = 0; i < 4; ++i) buffer_[i] = block[i];
  ++counter_[3];
  used_ = 0;
}

int Draws::whole(int low, int high) {
  const auto span = static_cast<std::uint64_t>(high - low) + 1;
  return low + static_cast<int>((bits() * span) >> 32);
}

// By rejection from the disc, so that no trigonometry is needed whose last bit differs between processors.
Vec3 Draws::onSphere() {
  return inCone(Vec3(0, 1, 0), -1.0);
}

Vec3 Draws::inCone(Vec3 axis, double cos_half_angle) {
  double x = 0, y = 0, r2 = 0;
  do {
    x = uniform(-1.0, 1.0);
    y = uniform(-1.0, 1.0);
    r2 = x * x + y * y;
  } while (r2 >= 1.0 || r2 == 0.0);
  // r2 is even in [0, 1), and so is the height of an even point on the sphere (Archimedes).
  const double along = 1.0 - r2 * (1.0 - cos_half_angle);
  const double across = std::sqrt(std::max(0.0, 1.0 - along * along) / r2);
  const Vec3 u = perpendicular(axis);
  const Vec3 v = glm::cross(axis, u);
  return along * axis + across * (x * u + y * v);
}

Vec3 perpendicular(Vec3 unit) {
  const Vec3 a = glm::abs(unit);
  const Vec3 helper = a.x <= a.y && a.x <= a.z ? Vec3(1, 0, 0) : a.y <= a.z ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  return glm::normalize(glm::cross(unit, helper));
}

}  // namespace espalier::sim
