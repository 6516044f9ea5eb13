#include "render/image/noise.h"

#include <Random123/philox.h>

#include <array>
#include <cstdint>

namespace espalier::render {
namespace {

constexpr int kSide = Noise::kPeriod;
constexpr std::uint32_t kNoiseKey = 0x5e5e;

}  // namespace

Noise::Noise() : table_(static_cast<std::size_t>(kSide) * kSide * kSide) {
  r123::Philox4x32 philox;
  for (std::uint32_t i = 0; i < table_.size(); i += 4) {
    const auto bits = philox({{i, 0, 0, 0}}, {{kNoiseKey, 0}});
    for (std::uint32_t k = 0; k < 4; ++k)
      table_[i + k] = 2.0f * (static_cast<float>(bits[k] >> 8) * 0x1p-24f) - 1.0f;
  }
}

template <class Wrap>
float Noise::between(sim::Vec3f p, const Wrap& wrap) const {
  std::array<std::array<std::size_t, 2>, 3> corner;  // of the cell, wrapped
  sim::Vec3f f;
  for (int axis = 0; axis < 3; ++axis) {
    int low = static_cast<int>(p[axis]);
    if (p[axis] < static_cast<float>(low)) --low;
    const float t = p[axis] - static_cast<float>(low);
    f[axis] = t * t * (3.0f - 2.0f * t);
    for (int side = 0; side < 2; ++side) {
      corner[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)] =
          static_cast<std::size_t>(wrap(low + side, axis));
    }
  }
  const auto row = [&](std::size_t y, std::size_t z) {
    const float* const along = table_.data() + (corner[1][y] * kSide + corner[2][z]) * kSide;
    return glm::mix(along[corner[0][0]], along[corner[0][1]], f.x);
  };
  return glm::mix(glm::mix(row(0, 0), row(0, 1), f.z), glm::mix(row(1, 0), row(1, 1), f.z), f.y);
}

float Noise::operator()(sim::Vec3f p) const {
  return between(p, [](int i, int) { return i & (kSide - 1); });
}

float Noise::tiled(sim::Vec3f p, glm::ivec3 period) const {
  return between(p, [&](int i, int axis) { return (i % period[axis] + period[axis]) % period[axis]; });
}

}  // namespace espalier::render
