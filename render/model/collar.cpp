#include "render/model/collar.h"

#include <algorithm>
#include <numbers>

#include "sim/base/random.h"

namespace espalier::render {

using sim::Vec3;

Collar::Collar(const Limb& host, const Foot& foot, const Section& ring)
    : host_(host), foot_(foot), ring_(ring), middle_(sectionAt(host, foot.arc_m).surface(foot.angle)) {}

Vec3 Collar::at(double turn, double share) const {
  constexpr double kMostFlare = 0.8;
  const glm::dvec2 circle = sim::unitCircle(turn / (2.0 * std::numbers::pi));
  const Section on_host = sectionAt(host_, foot_.arc_m + foot_.half_arc_m * circle.x);
  const double angle = foot_.angle - foot_.half_angle * circle.y;
  const Vec3 out = on_host.out(angle), from = on_host.centre_m + on_host.radius_m * out,
             to = ring_.surface(turn);
  const double wide = glm::distance(middle_, from);
  const double flare = std::clamp(2.0 * (wide - ring_.radius_m) / std::max(wide, 1e-12), 0.0, kMostFlare);
  const Vec3 third = (to - from) / 3.0;
  const Vec3 left = from + third - flare * std::max(glm::dot(third, out), 0.0) * out;
  const Vec3 comes = to - std::max(glm::dot(third, ring_.frame.along), 0.0) * ring_.frame.along;
  const double s = share, q = 1.0 - share;  // Bezier's
  return q * q * q * from + 3.0 * q * q * s * left + 3.0 * q * s * s * comes + s * s * s * to;
}

}  // namespace espalier::render
