#include "rules/language/colour.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::rules {
namespace {

// Float libm, as sim::linearFromSrgb.
float srgb(float l) {
  return l <= 0.0031308f ? l * 12.92f : 1.055f * powf(l, 1.0f / 2.4f) - 0.055f;
}
long byte(float s) {
  return std::lround(std::clamp(s, 0.0f, 1.0f) * 255.0f);
}

}  // namespace

sim::Colour srgbFromLinear(sim::Colour c) {
  return {srgb(c.r), srgb(c.g), srgb(c.b)};
}

std::string hexFromLinear(sim::Colour c) {
  const auto s = srgbFromLinear(c);
  return fmt::format("#{:02x}{:02x}{:02x}", byte(s.r), byte(s.g), byte(s.b));
}

}  // namespace espalier::rules
