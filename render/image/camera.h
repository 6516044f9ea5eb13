#pragma once
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

}  // namespace espalier::render
