#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace espalier::sim {

/// A picture that is laid on polygons, which are cut out where its alpha is below a half. Rows from the top.
struct Picture {
  std::string name;  ///< of its kind or file, for people
  int width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 4>> texels;  ///< sRGB, and alpha that is not premultiplied
  std::string png;                                  ///< the same as a file's bytes
};

}  // namespace espalier::sim
