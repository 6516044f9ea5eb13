#pragma once
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "render/image/image.h"

namespace espalier::render {

/// A trial of a walk in a plane of voxels: from a to b, voxel coordinates (a voxel's centre is at whole
/// numbers, y up).
struct Attempt {
  glm::dvec2 a{0.0}, b{0.0};
  bool taken = false;  ///< it became a segment of the plant
};

struct AttemptsLook {
  glm::ivec2 size{0};  ///< voxels across and up, from voxel (0, 0)
  int frame_width_px = 600;
};

/// Two frames side by side (Greene 1989, figure 2). Left: the voxels taken, and every trial, those taken dark
/// and those rejected light. Right: the skeleton alone. Display values.
Image drawAttempts(std::span<const Attempt> attempts, std::span<const glm::ivec2> occupied,
                   const AttemptsLook& look);

}  // namespace espalier::render
