#pragma once
#include <functional>
#include <optional>
#include <string>

#include <glm/vec2.hpp>

#include "render/image/image.h"
#include "sim/base/vec.h"

namespace espalier::render {

/// Voxels of a cut as squares of colour (display values) on paper, with thin lines between them. `colour` is
/// asked for each, (0, 0) being the lower left one; one that has none stays paper. The height follows from
/// the width and `size`, voxels across and up. Throws InputError where any of these is below 1.
Image drawCells(glm::ivec2 size, int width_px,
                const std::function<std::optional<sim::Colour>(glm::ivec2)>& colour);

/// What a voxel of a cut shows.
struct Cut {
  bool occupied = false;
  int layer = 0;             ///< 1..layers of a free voxel in a boundary layer; 0 beyond them
  sim::Colour colour{0.2f};  ///< linear, of an occupied voxel
};

struct SectionLook {
  glm::ivec2 size{0};  ///< voxels across and down
  int layers = 0;      ///< boundary layers to tint and to name in the legend
  int width_px = 960;  ///< of the picture; its height follows
  std::string title = "boundary layers";
};

/// A cut through a world at right angles to an axis (Greene 1989, figure 3A): what is occupied in its own
/// dark colours, the boundary layers in graded tints, free space near white, thin lines between voxels. `cut`
/// is asked for each voxel of the picture, (0, 0) being the lower left one. Display values.
Image drawSection(const std::function<Cut(glm::ivec2)>& cut, const SectionLook& look);

}  // namespace espalier::render
