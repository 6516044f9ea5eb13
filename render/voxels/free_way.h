#pragma once
#include <vector>

#include <glm/vec2.hpp>

#include "render/image/camera.h"
#include "sim/base/bits.h"
#include "sim/base/vec.h"

namespace espalier::render {

/// How far a camera's rays surely run through free space, told from what the rays around them met: spares
/// sim::firstHit the way there.
///
/// A voxel that a ray meets covers a part of the picture that is convex and holds the disc of the ball inside
/// the voxel. Where that disc is at least as wide as pixels of a grid lie apart, some pixel of the grid that
/// is near the ray lies in the part as well, and its own ray met the voxel, or something before it: no voxel
/// can be nearer than the nearest of what those pixels met, less a voxel's diagonal.
class FreeWay {
 public:
  FreeWay(const Camera& camera, int width_px, int height_px, sim::Vec3 eye_vx,
          const sim::BitVolume& occupied);

  /// What the ray through a pixel's middle met, at a distance in voxel widths; infinity: nothing. Pixels of a
  /// grid may be told at the same time.
  void tell(glm::ivec2 pixel, double distance_vx) { met_vx_[index(pixel)] = static_cast<float>(distance_vx); }
  /// Voxel widths that are free for a ray through a point of the picture, in pixels. All pixels whose two
  /// numbers are multiples of `apart` must have been told.
  double of(glm::dvec2 at_px, int apart) const;

 private:
  std::size_t index(glm::ivec2 pixel) const {
    return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(size_.x) +
           static_cast<std::size_t>(pixel.x);
  }

  glm::ivec2 size_;
  int around_ = 0;               // how many pixels of a grid to either side are asked; 0: nothing can be told
  double disc_one_px_vx_ = 0.0;  // up to here a voxel's disc is wide enough for pixels that are neighbours
  std::vector<float> met_vx_;    // by pixel
};

}  // namespace espalier::render
