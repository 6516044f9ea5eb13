#pragma once
#include <functional>
#include <vector>

#include "render/files/gltf.h"
#include "render/finish/daylight.h"
#include "render/finish/ray_scene.h"
#include "render/image/camera.h"
#include "render/image/image.h"
#include "sim/base/bits.h"
#include "sim/base/frame.h"
#include "sim/world/field.h"

namespace espalier::render {

/// Light that a finished picture has: of the whole sky on level ground, of the ground all around on what
/// looks down to it alone, and of the sun on what is square to it.
struct OutdoorLight {
  sim::Colour sky, ground, sun;
};
OutdoorLight outdoorLight(const std::vector<const sim::Mesh*>& meshes, double voxel_m, sim::Vec3 to_sun,
                          const DaylightShare& share = {});

/// What the finished picture is made of. Borrowed: everything must outlive the call.
struct FinishedScene {
  ModelScene model;
  KnownPictures pictures;  ///< of textures of the model's meshes: the others are in their materials' colours
  sim::Frame frame;
  const sim::BitVolume* occupied = nullptr;  ///< scene and plants, as tiled
  const sim::ExposureField* sky = nullptr;   ///< sky_exposure of every free voxel
  /// Light that has bounced and falls onto a place with a unit normal, outdoorLight's ground included;
  /// without it a guess.
  std::function<sim::Colour(sim::Vec3 p_m, sim::Vec3f normal)> bounced = {};
  sim::Vec3 to_sun{0.4, 0.75, 0.5};  ///< need not be of unit length; below the horizon there is no sun
  DaylightShare daylight;            ///< how much of it there is
};

/// The plant itself in daylight: the model diced to the voxel grid, each fragment lit by its voxel (Greene
/// 1989, section 5), with sharp sunlight, a floor that carries on into haze, and a sky behind. Linear light,
/// RGB; made for the default ToneCurve. The same scene gives the same picture on any thread count. Throws
/// InputError where something is missing or of another size than the frame.
Image finishedPicture(const FinishedScene& scene, const Camera& camera, int width, int height);

}  // namespace espalier::render
