#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/model/radii.h"
#include "render/model/stem_curves.h"
#include "sim/grow/plant.h"

namespace espalier::test {

/// Forks of a plant as they are drawn: the angle between two daughters over three radii of the stem that
/// forks, and what Murray's law asks of their radii (the formula is written anew here), both in degrees.
struct DrawnForks {
  std::vector<double> drawn_deg, asked_deg;
  std::size_t crowded = 0;  ///< more than two daughters at one node

  double meanDeviation() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < drawn_deg.size(); ++i) sum += std::abs(drawn_deg[i] - asked_deg[i]);
    return sum / static_cast<double>(drawn_deg.size());
  }
};

/// The place so far along a curve from a parameter on, voxel widths; its end where it is shorter.
inline sim::Vec3 alongCurve(const render::StemLine& curve, double from, double distance) {
  constexpr double kStep = 1.0 / 256.0;
  sim::Vec3 at = curve.position(from);
  double gone = 0.0;
  for (double t = from + kStep; t <= curve.last() && gone < distance; t += kStep) {
    const sim::Vec3 next = curve.position(t);
    gone += glm::distance(at, next);
    at = next;
  }
  return at;
}

inline DrawnForks drawnForks(const sim::Plant& plant) {
  const sim::Skeleton& s = plant.skeleton;
  const std::vector<float> radii = render::stemRadii(s, plant.girth);
  const render::StemCurves curves = render::stemCurves(s, radii);
  std::vector<std::vector<sim::NodeId>> children(s.parent.size());
  for (sim::NodeId n = 0; n < s.size(); ++n) {
    if (s.parent[static_cast<std::size_t>(n)] != sim::kNoNode)
      children[static_cast<std::size_t>(s.parent[static_cast<std::size_t>(n)])].push_back(n);
  }
  DrawnForks forks;
  for (std::size_t n = 0; n < children.size(); ++n) {
    if (s.parent[n] == sim::kNoNode || children[n].size() < 2) continue;
    if (children[n].size() > 2) ++forks.crowded;
    const double r0 = radii[n];
    std::vector<sim::Vec3> ways;
    std::vector<double> r;
    for (const sim::NodeId child : children[n]) {
      const auto c = static_cast<std::size_t>(child);
      const auto stem = static_cast<std::size_t>(curves.stem_of[c]);
      const double start = curves.stem_of[n] == curves.stem_of[c] ? curves.parameter_of[n] : 0.0;
      const sim::Vec3 end = alongCurve(curves.stems[stem].curve, start, 3.0 * r0);
      ways.push_back(glm::normalize(end - s.position_vx[n]));
      r.push_back(radii[c]);
    }
    const double cosine =
        (std::pow(r0, 4) - std::pow(r[0], 4) - std::pow(r[1], 4)) / (2.0 * r[0] * r[0] * r[1] * r[1]);
    constexpr double kDegrees = 180.0 / std::numbers::pi;
    forks.asked_deg.push_back(kDegrees * std::acos(std::clamp(cosine, -1.0, 1.0)));
    forks.drawn_deg.push_back(kDegrees * std::acos(std::clamp(glm::dot(ways[0], ways[1]), -1.0, 1.0)));
  }
  return forks;
}

}  // namespace espalier::test
