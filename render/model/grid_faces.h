#pragma once
// Internal to the wing.
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "render/model/limb_grid.h"

namespace espalier::render {

/// In place of a vertex where a grid has no corner.
inline constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

/// The triangles of a grid's surface. Kept from limb to limb, it allocates no more than the largest takes.
class GridFaces {
 public:
  /// `vertices`: of the corners, sides + 1 a ring, for the first stands at a seam twice.
  std::span<const std::array<std::uint32_t, 3>> of(const LimbGrid& grid,
                                                   std::span<const std::uint32_t> vertices,
                                                   std::span<const sim::Vec3f> positions_m);

 private:
  std::vector<bool> hole_;                                    // quads
  std::vector<std::pair<std::uint32_t, std::uint32_t>> low_;  // of each column: reached to the left and right
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace espalier::render
