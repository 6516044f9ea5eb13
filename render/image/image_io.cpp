#include "render/image/image_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "render/image/oiio.h"
#include "sim/base/error.h"

namespace espalier::render {
namespace {

void checkPixels(const Image& image) {
  const std::size_t expected = static_cast<std::size_t>(image.width) *
                               static_cast<std::size_t>(image.height) *
                               static_cast<std::size_t>(image.channels);
  if (expected == 0 || image.pixels.size() != expected) {
    throw sim::InputError(
        fmt::format("a picture of {} x {} pixels with {} channels needs {} values and has {}", image.width,
                    image.height, image.channels, expected, image.pixels.size()));
  }
  for (std::size_t i = 0; i < expected; ++i) {
    if (std::isfinite(image.pixels[i])) continue;
    const std::size_t pixel = i / static_cast<std::size_t>(image.channels);
    const std::size_t width = static_cast<std::size_t>(image.width);
    throw sim::InputError(
        fmt::format("pixel ({}, {}) of a picture is not a finite number", pixel % width, pixel / width));
  }
}

}  // namespace

Metadata textsOf(const sim::Provenance& made_by) {
  return {{"Software", made_by.software},
          {"espalier:seed", std::to_string(made_by.seed)},
          {"espalier:inputs", sim::listOf(made_by.inputs)}};
}

std::string encodePng(const Image& display, const Metadata& metadata) {
  checkPixels(display);
  if (display.channels != 1 && display.channels != 3 && display.channels != 4)
    throw sim::InputError(fmt::format("a PNG has 1, 3 or 4 channels, not {}", display.channels));
  std::vector<std::uint8_t> bytes(display.pixels.size());
  std::transform(display.pixels.begin(), display.pixels.end(), bytes.begin(), [](float v) {
    return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
  });
  return oiio().png(display, bytes.data(), metadata);
}

Image decodePng(const std::string& bytes) {
  constexpr int kMostSide = 1 << 16;
  const Texels texels = oiio().read_png(bytes, std::numeric_limits<int>::max(), kMostSide);
  Image display(texels.width, texels.height, 3);
  float* channel = display.pixels.data();
  for (const auto& rgba : texels.rgba) {
    for (std::size_t c = 0; c < 3; ++c) *channel++ = static_cast<float>(rgba[c]) / 255.0f;
  }
  return display;
}

std::string encodeExr(const Image& measured, const std::vector<std::string>& channel_names,
                      const Metadata& metadata) {
  checkPixels(measured);
  if (channel_names.size() != static_cast<std::size_t>(measured.channels)) {
    throw sim::InputError(
        fmt::format("{} names for the {} channels of an EXR", channel_names.size(), measured.channels));
  }
  return oiio().exr(measured, channel_names, metadata);
}

}  // namespace espalier::render
