#include "render/model/meeting_limbs.h"

#include <algorithm>
#include <cmath>

#include "render/model/box_pairs.h"

namespace espalier::render {
namespace {

using sim::Vec3;
using sim::Vec3f;

/// A stretch of a limb between two stations.
struct Stretch {
  std::uint32_t limb, station;
};

/// How near two straight lines come to each other, and where on each, 0..1.
struct Nearest {
  double distance, on_a, on_b;
};
Nearest nearest(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), uw = glm::dot(u, w),
               vw = glm::dot(v, w);
  const double area = uu * vv - uv * uv;
  double s = area > 1e-12 * uu * vv ? std::clamp((uv * vw - vv * uw) / area, 0.0, 1.0) : 0.0;
  const double t = std::clamp((uv * s + vw) / vv, 0.0, 1.0);
  s = std::clamp((uv * t - uw) / uu, 0.0, 1.0);
  return {glm::distance(a + s * u, c + t * v), s, t};
}

/// Whether two limbs run into each other at two of their stretches, other than where one leaves the other.
bool meet(const std::vector<Limb>& limbs, Stretch p, Stretch q) {
  const Limb &a = limbs[p.limb], &b = limbs[q.limb];
  const Nearest at = nearest(a.line[p.station].centre_m, a.line[p.station + 1].centre_m,
                             b.line[q.station].centre_m, b.line[q.station + 1].centre_m);
  const auto radius = [](const Limb& limb, std::size_t i, double share) {
    return glm::mix(limb.line[i].radius_m, limb.line[i + 1].radius_m, share);
  };
  const auto arc = [](const Limb& limb, std::size_t i, double share) {
    return glm::mix(limb.arcs_m[i], limb.arcs_m[i + 1], share);
  };
  const double thick = radius(a, p.station, at.on_a) + radius(b, q.station, at.on_b);
  if (at.distance >= thick) return false;
  const double along_a = arc(a, p.station, at.on_a), along_b = arc(b, q.station, at.on_b);
  if (p.limb == q.limb) return std::abs(along_a - along_b) > 4.0 * thick;
  if (b.host == static_cast<std::int32_t>(p.limb)) return along_b > 2.0 * thick;
  if (a.host == static_cast<std::int32_t>(q.limb)) return along_a > 2.0 * thick;
  return true;
}

}  // namespace

std::size_t meetingLimbs(const std::vector<Limb>& limbs) {
  std::vector<std::size_t> begins{0};  // of each limb's stretches
  for (const Limb& limb : limbs)
    begins.push_back(begins.back() + std::max<std::size_t>(limb.line.size(), 1) - 1);
  std::vector<Stretch> stretches(begins.back());
  std::vector<Box> boxes(begins.back());
  sim::parallelFor(limbs.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t l = begin; l < end; ++l) {
      for (std::size_t i = 0; i < begins[l + 1] - begins[l]; ++i) {
        const TubeStation &a = limbs[l].line[i], &b = limbs[l].line[i + 1];
        const Vec3 thick(std::max(a.radius_m, b.radius_m));
        stretches[begins[l] + i] = {static_cast<std::uint32_t>(l), static_cast<std::uint32_t>(i)};
        boxes[begins[l] + i] = {Vec3f(glm::min(a.centre_m, b.centre_m) - thick),
                                Vec3f(glm::max(a.centre_m, b.centre_m) + thick)};
      }
    }
  });
  if (boxes.empty()) return 0;
  return Boxes(std::move(boxes))
      .count([&](std::uint32_t a, std::uint32_t b) { return meet(limbs, stretches[a], stretches[b]); },
             [&](std::uint32_t a) { return stretches[a].limb; })
      .size();
}

}  // namespace espalier::render
