#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "render/image/camera.h"
#include "sim/base/bits.h"
#include "sim/base/faces.h"
#include "sim/base/frame.h"
#include "sim/base/vec.h"
#include "sim/world/ray.h"

namespace espalier::render {

/// In place of a face: where nothing is hit.
inline constexpr std::uint8_t kSky = sim::kFaces;

/// What one or more samples of a pixel see alike: a face of an occupied voxel, or the sky.
struct Fragment {
  sim::Voxel voxel{0};
  /// Mean of the samples' places on the face, from the voxel's centre, -0.5..0.5, along the two axes that
  /// follow the face's own axis (y, z for x; z, x for y; x, y for z).
  glm::vec2 at{0.0f};
  std::uint8_t face = kSky;
  std::uint8_t samples = 1;
};

/// What a camera sees of a world, found once and shared by every picture of it. Pixels whose neighbours see
/// other faces hold several samples, merged into fragments; the others hold one.
struct Visibility {
  int width = 0;
  int height = 0;
  sim::Frame frame;
  CameraRays rays;
  std::vector<std::size_t> starts;  ///< of each pixel's fragments, rows from the top; one more than pixels
  std::vector<Fragment> fragments;

  std::span<const Fragment> pixel(std::size_t index) const {
    return std::span(fragments).subspan(starts[index], starts[index + 1] - starts[index]);
  }
};

/// Throws InputError where the camera stands inside an occupied voxel, the size is not positive, or the
/// pixels see more than `most` fragments, which bounds what it takes of memory.
Visibility see(const sim::Frame& frame, const sim::BitVolume& occupied, const sim::Bricks& bricks,
               const Camera& camera, int width_px, int height_px,
               std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace espalier::render
