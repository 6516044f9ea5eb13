#include "render/image/colour_map.h"

#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

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
  OIIO::ImageBuf ramp(OIIO::ImageSpec(kEntries, 1, 1, OIIO::TypeDesc::FLOAT));
  for (int i = 0; i < kEntries; ++i) {
    const float value = static_cast<float>(i) / (kEntries - 1);
    ramp.setpixel(i, 0, OIIO::cspan<float>(value));
  }
  const OIIO::ImageBuf mapped = OIIO::ImageBufAlgo::color_map(ramp, 0, name, {}, 1);
  if (mapped.has_error()) throw sim::InputError(fmt::format("colour map '{}': {}", name, mapped.geterror()));
  table_.resize(kEntries);
  for (int i = 0; i < kEntries; ++i) {
    std::array<float, 3> rgb{};
    mapped.getpixel(i, 0, rgb.data(), 3);
    // note: the maps are published as display values; OpenImageIO gives them back linear.
    table_[static_cast<std::size_t>(i)] = sim::Colour(rgb[0], rgb[1], rgb[2]);
  }
}

sim::Colour ColourMap::operator()(float value) const {
  const float place = std::clamp(value, 0.0f, 1.0f) * (kEntries - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(kEntries - 2));
  return glm::mix(table_[i], table_[i + 1], place - static_cast<float>(i));
}

}  // namespace espalier::render
