#include "render/image/camera.h"

#include <cmath>
#include <numbers>

namespace espalier::render {

namespace {

/// The picture's axes in the world, of unit length.
struct Axes {
  sim::Vec3 forward, right, up;
};
Axes axesOf(const Camera& camera) {
  const sim::Vec3 forward = glm::normalize(camera.target_m - camera.eye_m);
  // Looking straight up or down, "up" in the image is -z.
  const bool vertical = std::abs(forward.y) > 0.999999;
  const sim::Vec3 right =
      glm::normalize(glm::cross(forward, vertical ? sim::Vec3(0, 0, -1) : sim::Vec3(0, 1, 0)));
  return {forward, right, glm::cross(right, forward)};
}

/// Of a picture at a distance of 1.
double halfHeight(const Camera& camera) {
  return std::tan(camera.fov_deg * std::numbers::pi / 360.0);
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, double aspect) : eye_m_(camera.eye_m) {
  const auto [forward, right, up] = axesOf(camera);
  right_ = right * (2.0 * halfHeight(camera) * aspect);
  down_ = up * (-2.0 * halfHeight(camera));
  corner_ = forward - 0.5 * right_ - 0.5 * down_;
}

sim::Vec3 CameraRays::direction(double x, double y) const {
  return glm::normalize(corner_ + x * right_ + y * down_);
}

Projection::Projection(const Camera& camera, int width_px, int height_px)
    : eye_m_(camera.eye_m),
      middle_(0.5 * width_px, 0.5 * height_px),
      pixels_(0.5 * height_px / halfHeight(camera)) {
  const Axes axes = axesOf(camera);
  forward_ = axes.forward;
  right_ = axes.right;
  up_ = axes.up;
}

glm::vec2 Projection::pixel(sim::Vec3 place_m) const {
  const sim::Vec3 from_eye = place_m - eye_m_;
  const double scale = pixelsAt(glm::dot(from_eye, forward_));
  return {middle_ + scale * glm::dvec2(glm::dot(from_eye, right_), -glm::dot(from_eye, up_))};
}

}  // namespace espalier::render
