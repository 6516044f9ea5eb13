#pragma once
#include "render/voxels/panels.h"
#include "scenes/show/pictures.h"

namespace espalier::scenes {

/// Whether any is one of a volume.
bool drawsVolumes(const std::vector<ImageSpec>& images);

/// An image of kind volume: the voxels of first passes, with opacity accumulated along the camera's rays.
/// What is finished must have an occupancy, and its light know sun_now of `to_sun`. Display values for the
/// eye, and linear light times opacity, R, G, B, with opacity, A. Throws sim::InputError where there is not
/// the memory for it.
render::PanelPicture volumePicture(const Finished& finished, sim::Vec3 to_sun, const render::Camera& camera,
                                   int width_px, int height_px);

}  // namespace espalier::scenes
