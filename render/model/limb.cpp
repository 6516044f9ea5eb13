#include "render/model/limb.h"

#include <algorithm>
#include <cmath>

#include "sim/base/random.h"

namespace espalier::render {

using sim::Vec3;

namespace {

constexpr double kThin = 0.15;   // errors: a radius that hardly shows
constexpr double kFlat = 0.85;   // errors that a ring's sides may be off ..
constexpr double kRound = 0.04;  // .. or radii: what shows in no picture

/// A stretch between two stations, and how much of it lies before a place.
struct Place {
  std::size_t stretch;
  double share;
};

Place placeOn(const Limb& limb, double arc_m) {
  const std::vector<double>& arcs = limb.arcs_m;
  const auto above = std::upper_bound(arcs.begin() + 1, arcs.end() - 1, arc_m);
  const auto i = static_cast<std::size_t>(above - arcs.begin()) - 1;
  return {i, std::clamp((arc_m - arcs[i]) / (arcs[i + 1] - arcs[i]), 0.0, 1.0)};
}

NearLine onStretch(const Limb& limb, std::size_t stretch, Vec3 p) {
  const TubeStation &a = limb.line[stretch], &b = limb.line[stretch + 1];
  const Vec3 step = b.centre_m - a.centre_m;
  const double share = std::clamp(glm::dot(p - a.centre_m, step) / glm::dot(step, step), 0.0, 1.0);
  const Vec3 centre = a.centre_m + share * step;
  return {stretch, share, centre, glm::distance(p, centre), a.radius_m + share * (b.radius_m - a.radius_m)};
}

}  // namespace

NearLine nearestOn(const Limb& limb, std::size_t stretch, Vec3 p) {
  NearLine best = onStretch(limb, stretch, p);
  for (const int way : {1, -1}) {
    for (std::size_t i = best.stretch; way > 0 ? i + 2 < limb.line.size() : i > 0;) {
      i += static_cast<std::size_t>(way);
      const NearLine next = onStretch(limb, i, p);
      if (!(next.distance_m < best.distance_m)) break;
      best = next;
    }
  }
  return best;
}

double arcOf(const Limb& limb, const NearLine& place) {
  return limb.arcs_m[place.stretch] +
         place.share * (limb.arcs_m[place.stretch + 1] - limb.arcs_m[place.stretch]);
}

std::size_t stretchAt(const Limb& limb, double param) {
  const std::vector<double>& params = limb.params;
  return static_cast<std::size_t>(std::upper_bound(params.begin() + 1, params.end() - 1, param) -
                                  params.begin()) -
         1;
}

int sidesFor(double radius_m, double error_m) {
  // A prism of three or four sides is far wider in one view than in another.
  const int least = radius_m < kThin * error_m ? 3 : 5;
  error_m = std::max(kFlat * error_m, kRound * radius_m);
  if (!(error_m < 0.5 * radius_m)) return least;
  return std::clamp(static_cast<int>(std::ceil(kPi / std::acos(1.0 - error_m / radius_m) - 0.05)), least, 48);
}

Vec3 Section::out(double angle) const {
  const glm::dvec2 circle = sim::unitCircle(angle / (2.0 * kPi));
  return circle.x * frame.across + circle.y * frame.up;
}

TubeStation mixed(const TubeStation& a, const TubeStation& b, double share) {
  const auto part = static_cast<float>(share);
  return {glm::mix(a.centre_m, b.centre_m, share), glm::mix(a.radius_m, b.radius_m, share),
          glm::mix(a.exposure, b.exposure, part), glm::mix(a.youth, b.youth, part)};
}

TubeStation stationOn(const Limb& limb, double arc_m) {
  const auto [i, share] = placeOn(limb, arc_m);
  return mixed(limb.line[i], limb.line[i + 1], share);
}

Section sectionAt(const Limb& limb, double arc_m) {
  const auto [i, share] = placeOn(limb, arc_m);
  const TubeFrame &f = limb.frames[i], &g = limb.frames[i + 1];
  const TubeStation station = mixed(limb.line[i], limb.line[i + 1], share);
  Section section{station.centre_m, station.radius_m, {}, station.exposure, station.youth};
  if (share == 0.0 || share == 1.0) {
    section.frame = share == 0.0 ? f : g;
    return section;
  }
  // Between opposite ways (a hairpin) there is no mean: then the first of the two.
  const Vec3 along = glm::mix(f.along, g.along, share), across = glm::mix(f.across, g.across, share);
  section.frame = f;
  if (glm::length(along) < 0.1 || glm::length(glm::cross(along, across)) < 0.01) return section;
  section.frame.along = glm::normalize(along);
  section.frame.across = glm::normalize(across - glm::dot(across, section.frame.along) * section.frame.along);
  section.frame.up = glm::cross(section.frame.along, section.frame.across);
  return section;
}

}  // namespace espalier::render
