#pragma once
#include <memory>

#include "render/voxels/panels.h"
#include "scenes/show/pictures.h"

namespace espalier::scenes {

/// Whether any is one of a volume.
bool drawsVolumes(const std::vector<ImageSpec>& images);

/// Images of kind volume: the voxels of first passes, each lit as its own surface is, with opacity
/// accumulated along the camera's rays.
class VolumePictures {
 public:
  /// Borrows what is finished, which must have an occupancy, and whose light must know sun_now of `to_sun`.
  VolumePictures(const Finished& finished, sim::Vec3 to_sun);
  ~VolumePictures();

  /// Display values for the eye, and linear light times opacity, R, G, B, with opacity, A. Throws
  /// sim::InputError where there is not the memory for it.
  render::PanelPicture draw(const render::Camera& camera, int width_px, int height_px);

 private:
  struct Lit;
  const Finished& finished_;
  sim::Vec3 to_sun_;
  std::unique_ptr<const Lit> lit_;  // the same for all cameras
};

}  // namespace espalier::scenes
