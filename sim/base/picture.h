#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace espalier::sim {

/// A picture that is laid on surfaces: on polygons, which are cut out where its alpha is below a half, or,
/// where it tiles, side by side on all of a surface. Rows from the top.
struct Picture {
  std::string name;  ///< of its kind or file, for people
  int width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 4>> texels;  ///< sRGB, and alpha that is not premultiplied
  std::string png;                                  ///< the same as a file's bytes
  bool tiles = false;                               ///< it goes on beyond its rims; opaque
};

}  // namespace espalier::sim
