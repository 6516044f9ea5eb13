#pragma once
#include <glm/vec2.hpp>

#include "sim/base/vec.h"

namespace espalier::render {

/// A pinhole camera in world space; y is up.
struct Camera {
  sim::Vec3 eye_m{0.0, 1.6, 5.0};
  sim::Vec3 target_m{0.0};
  double fov_deg = 40.0;  ///< vertical field of view; 0 < fov < 180
};

/// A camera made ready for an image of given shape: the unit direction through image point (x, y), both 0..1
/// from the upper left corner.
class CameraRays {
 public:
  CameraRays(const Camera& camera, double aspect);
  sim::Vec3 eye_m() const { return eye_m_; }
  sim::Vec3 direction(double x, double y) const;

 private:
  sim::Vec3 eye_m_{0.0}, corner_{0.0}, right_{0.0}, down_{0.0};
};

/// The other way round: where a place lies in a picture of so many pixels.
class Projection {
 public:
  Projection(const Camera& camera, int width_px, int height_px);

  /// How far before the eye a place is, along the way in which the camera looks; not above 0 behind it.
  double depth_m(sim::Vec3 place_m) const { return glm::dot(place_m - eye_m_, forward_); }
  /// In pixels from the upper left corner; of a place before the eye.
  glm::vec2 pixel(sim::Vec3 place_m) const;
  /// How many pixels a metre takes up at such a depth, above 0.
  double pixelsAt(double depth_m) const { return pixels_ / depth_m; }

 private:
  sim::Vec3 eye_m_{0.0}, forward_{0.0}, right_{0.0}, up_{0.0};
  glm::dvec2 middle_{0.0};
  double pixels_ = 1.0;
};

}  // namespace espalier::render
