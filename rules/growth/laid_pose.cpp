#include "rules/growth/laid_pose.h"

#include <algorithm>

#include "sim/base/random.h"

namespace espalier::rules {
namespace {

/// The stance's +y as far as it is square to another normal.
sim::Vec3 squareTo(sim::Vec3 normal, const Stance& stance) {
  const sim::Vec3 x = sim::perpendicular(normal);
  return facing(Stance{stance.at_vx, x, glm::cross(normal, x), normal}, stance.y).y;
}

}  // namespace

void poseOn(const Stance& stance, Pose pose, sim::Vec3 light, Tilt tilt, sim::PlacedElement& element) {
  const auto upright = [&](sim::Vec3 up) {
    element.y = up;
    element.z = squareTo(up, stance);
  };
  const auto facingOut = [&](sim::Vec3 out) {
    element.z = out;
    element.y = squareTo(out, stance);
  };
  switch (pose) {
    case Pose::surface:
    case Pose::aside:
      facingOut(stance.normal);
      break;
    case Pose::light:
      facingOut(light == sim::Vec3(0.0) ? stance.normal : light);
      break;
    case Pose::stand:
      upright({0, 1, 0});
      break;
    case Pose::hang:
      upright({0, -1, 0});
      break;
    case Pose::free:
      upright(stance.normal);
      break;
  }
  const glm::dvec2 lean = sim::unitCircle(tilt.degrees / 360.0), side = sim::unitCircle(tilt.side);
  const sim::Vec3 about = side.x * stance.x + side.y * stance.y;
  const auto leaning = [&](sim::Vec3 v) {
    const sim::Vec3 along = glm::dot(v, about) * about;
    return along + lean.x * (v - along) + lean.y * glm::cross(about, v);
  };
  element.y = glm::normalize(leaning(element.y));
  element.z = leaning(element.z);
  element.z = glm::normalize(element.z - glm::dot(element.z, element.y) * element.y);
  element.x = glm::cross(element.y, element.z);
}

void liftOnto(const Stance& stance, const Element& rule, sim::PlacedElement& element) {
  constexpr double kHair_vx = 0.03;  // or a leaf would lie in the very plane of the ground
  double lowest = kNoLimit;
  for (const auto& polygon : rule.polygons) {
    for (const sim::Vec3 corner : polygon)
      lowest = std::min(lowest, glm::dot(sim::placed(element, corner) - stance.at_vx, stance.normal));
  }
  if (!(lowest < kNoLimit)) return;
  const double lift = (rule.body ? 0.0 : kHair_vx) - lowest;
  // What is modelled above its foot, as a shingle's lower end, stays there.
  if (lift > 0.0) element.position_vx += lift * stance.normal;
}

}  // namespace espalier::rules
