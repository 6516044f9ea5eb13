#include "render/image/colour_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "render/image/oiio.h"
#include "sim/base/error.h"

namespace espalier::render {
namespace {

constexpr std::array<const char*, 5> kNames = {"inferno", "viridis", "magma", "plasma", "turbo"};
constexpr int kEntries = 1025;

}  // namespace

ColourMap::ColourMap(const std::string& name) {
  if (std::find(kNames.begin(), kNames.end(), name) == kNames.end()) {
    throw sim::InputError(
        fmt::format("unknown colour map '{}'; expected one of {}", name, fmt::join(kNames, ", ")));
  }
  table_ = oiio().colour_map(name, kEntries);
}

sim::Colour ColourMap::operator()(float value) const {
  const float place = std::clamp(value, 0.0f, 1.0f) * (kEntries - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(kEntries - 2));
  return glm::mix(table_[i], table_[i + 1], place - static_cast<float>(i));
}

}  // namespace espalier::render
