#include "render/image/camera.h"

#include <cmath>
#include <numbers>

namespace espalier::render {

CameraRays::CameraRays(const Camera& camera, double aspect) : eye_m_(camera.eye_m) {
  const sim::Vec3 forward = glm::normalize(camera.target_m - camera.eye_m);
  // Looking straight up or down, "up" in the image is -z.
  const bool vertical = std::abs(forward.y) > 0.999999;
  const sim::Vec3 right =
      glm::normalize(glm::cross(forward, vertical ? sim::Vec3(0, 0, -1) : sim::Vec3(0, 1, 0)));
  const sim::Vec3 up = glm::cross(right, forward);
  const double half_height = std::tan(camera.fov_deg * std::numbers::pi / 360.0);
  right_ = right * (2.0 * half_height * aspect);
  down_ = up * (-2.0 * half_height);
  corner_ = forward - 0.5 * right_ - 0.5 * down_;
}

sim::Vec3 CameraRays::direction(double x, double y) const {
  return glm::normalize(corner_ + x * right_ + y * down_);
}

}  // namespace espalier::render
