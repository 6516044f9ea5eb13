#include "render/model/grid_faces.h"

namespace espalier::render {

std::span<const std::array<std::uint32_t, 3>> GridFaces::of(const LimbGrid& grid,
                                                            std::span<const std::uint32_t> vertices,
                                                            std::span<const sim::Vec3f> positions_m) {
  const auto sides = static_cast<std::size_t>(grid.sides);
  hole_.assign(sides * (grid.arcs_m.size() - 1), false);
  for (const Patch& patch : grid.patches) {
    for (int r = patch.row; r < patch.row + patch.rows; ++r) {
      for (int c = patch.column; c < patch.column + patch.columns; ++c)
        hole_[static_cast<std::size_t>(r * grid.sides + c % grid.sides)] = true;
    }
  }
  triangles_.clear();
  low_.clear();
  for (std::size_t c = 0; c < sides; ++c) low_.emplace_back(vertices[c], vertices[c + 1]);
  // Each column is a strip from corner to corner, on whichever of its sides the next one comes first. All
  // corners around a hole are there.
  for (std::size_t r = 0; r + 1 < grid.arcs_m.size(); ++r) {
    const std::uint32_t* const high = &vertices[(r + 1) * (sides + 1)];
    for (std::size_t c = 0; c < sides; ++c) {
      auto& [left, right] = low_[c];
      const bool on_left = high[c] != kNoVertex, on_right = high[c + 1] != kNoVertex;
      if (hole_[r * sides + c]) {
        left = high[c];
        right = high[c + 1];
      } else if (on_left && on_right) {
        // Along the shorter diagonal: the sharper one would show where a rim has moved corners.
        const sim::Vec3f rising = positions_m[high[c + 1]] - positions_m[left],
                         falling = positions_m[high[c]] - positions_m[right];
        if (glm::dot(rising, rising) <= glm::dot(falling, falling) * 1.0001f) {
          triangles_.push_back({left, right, high[c + 1]});
          triangles_.push_back({left, high[c + 1], high[c]});
        } else {
          triangles_.push_back({left, right, high[c]});
          triangles_.push_back({right, high[c + 1], high[c]});
        }
        left = high[c];
        right = high[c + 1];
      } else if (on_left) {
        triangles_.push_back({left, right, high[c]});
        left = high[c];
      } else if (on_right) {
        triangles_.push_back({left, right, high[c + 1]});
        right = high[c + 1];
      }
    }
  }
  return triangles_;
}

}  // namespace espalier::render
