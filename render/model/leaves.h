#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/model/leaf_tint.h"
#include "render/model/model_mesh.h"
#include "sim/base/frame.h"
#include "sim/grow/plant.h"

namespace espalier::render {

/// A fan about corner 0, as the polygon is tiled (sim/tile/tiling.h), or about an added centre (index =
/// corners.size()) where that fan would leave a concave polygon. Facing the same way as the corners' order.
/// Empty for fewer than three corners or no area.
struct Fan {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool with_centre = false;
};
Fan fanOf(std::span<const sim::Vec3> corners);

/// The mean of the corners: where a fan with a centre has it.
sim::Vec3 centreOf(std::span<const sim::Vec3> corners);

/// Where a shape's blade begins: the corner nearest to the point of attachment. The origin if the shape is
/// empty.
sim::Vec3 bladeBase(const sim::ElementShape& shape);

/// Appends a placed element's polygons. Flat normals on the shape's face (+z) side; UVs span the shape's own
/// x and y extent, v along its growth; of a polygon that faces x rather than z, u spans the extent in z.
void appendElement(ModelMesh& mesh, const sim::PlacedElement& element, const sim::ElementShape& shape,
                   const sim::Frame& frame, const LeafPlace& place, std::uint32_t piece);

}  // namespace espalier::render
