#pragma once
#include <cstddef>
#include <vector>

namespace espalier::render {

/// A picture: rows from the top, pixels from the left, channels side by side. Whether its values are linear
/// light, display values (sRGB, 0..1) or a measured quantity is said where it is made.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> pixels;

  Image() = default;
  Image(int width_px, int height_px, int channel_count, float value = 0.0f)
      : width(width_px),
        height(height_px),
        channels(channel_count),
        pixels(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) *
                   static_cast<std::size_t>(channel_count),
               value) {}

  /// The first channel of a pixel, which must lie inside.
  float* at(int x, int y) { return pixels.data() + offset(x, y); }
  const float* at(int x, int y) const { return pixels.data() + offset(x, y); }

 private:
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(channels);
  }
};

}  // namespace espalier::render
