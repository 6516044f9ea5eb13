#pragma once
#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace espalier::sim {

/// Heights on a lattice in plan: rows along x, one after the other along z.
struct HeightRaster {
  glm::dvec2 low_m{0.0};  ///< the first sample's x and z
  double spacing_m = 1.0;
  int wide = 0, deep = 0;  ///< samples along x and z
  std::vector<float> height_m;

  std::size_t index(int x, int z) const {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(wide) + static_cast<std::size_t>(x);
  }
  glm::dvec2 place(int x, int z) const { return low_m + spacing_m * glm::dvec2(x, z); }
  bool holds(glm::ivec2 at) const { return at.x >= 0 && at.y >= 0 && at.x < wide && at.y < deep; }
  /// The nearest sample of a place, which may lie outside.
  glm::ivec2 nearest(glm::dvec2 at_m) const;
};

}  // namespace espalier::sim
