#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace espalier::render {

/// A picture that is laid on blades, which are cut out where its alpha is below kCutout. Rows from the top;
/// across it UVs go from 0 to 1, v upwards.
struct LeafPicture {
  std::string name;  ///< of its kind or file, for people
  int width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 4>> texels;  ///< sRGB, and alpha that is not premultiplied
  std::string png;                                  ///< the same as a file's bytes
};

inline constexpr float kCutout = 0.5f;

}  // namespace espalier::render
