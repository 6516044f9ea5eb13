#include "rules/front/guide.h"

#include <algorithm>
#include <cmath>

namespace espalier::rules {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

sim::Vec3 sampled(const GuideGrid& grid, sim::Vec3 at) {
  const sim::Vec3 in = (at - grid.low) / grid.apart;
  std::array<std::int32_t, 3> low{};
  sim::Vec3 share(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (!(in[axis] >= 0.0 && in[axis] <= grid.size[a] - 1)) return sim::Vec3(0.0);
    low[a] = std::min(static_cast<std::int32_t>(in[axis]), std::max(0, grid.size[a] - 2));
    share[axis] = in[axis] - low[a];
  }
  sim::Vec3 sum(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    std::size_t index = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const auto a = static_cast<std::size_t>(axis);
      const int up = corner >> axis & 1;
      weight *= up != 0 ? share[axis] : 1.0 - share[axis];
      index = index * static_cast<std::size_t>(grid.size[a]) +
              static_cast<std::size_t>(std::min(low[a] + up, grid.size[a] - 1));
    }
    if (weight > 0.0) sum += weight * grid.vectors[index];
  }
  return sum;
}

sim::Vec3 axisAt(const Guide& guide, const GuidePlace& place) {
  switch (guide.axis) {
    case GuideAxis::direction:
      return guide.direction;
    case GuideAxis::grid:
      return sampled(guide.grid, place.at);
    case GuideAxis::node_normal:
    case GuideAxis::attractor_normal:
      return place.normal;
  }
  return sim::Vec3(0.0);
}

struct Whorl {
  double angle_deg, strength;
};

/// What the points about a place make of a field.
Whorl whorlAt(const Guide& guide, sim::Vec3 at) {
  double sum = 0.0;
  Whorl there{0.0, 0.0};
  for (const GuidePoint& point : guide.points) {
    const double share = glm::length(at - point.at) / point.radius;
    if (!(share < 1.0)) continue;
    const double weight = (1.0 - share * share) * (1.0 - share * share);
    sum += weight;
    there.angle_deg += weight * point.angle_deg;
    there.strength += weight * point.strength;
  }
  if (sum == 0.0) return {guide.angle_deg, guide.strength};
  const double blend = std::min(1.0, sum);
  return {glm::mix(guide.angle_deg, there.angle_deg / sum, blend),
          glm::mix(guide.strength, there.strength / sum, blend)};
}

}  // namespace

bool GuideRegion::holds(sim::Vec3 at) const {
  const sim::Vec3 in = glm::floor((at - low) / apart + 0.5);
  std::size_t index = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (!(in[axis] >= 0.0 && in[axis] < size[a])) return false;
    index = index * static_cast<std::size_t>(size[a]) + static_cast<std::size_t>(in[axis]);
  }
  return (static_cast<std::uint64_t>(words[index / 64]) >> (index % 64) & 1u) != 0;
}

sim::Vec3 guideAt(const Guide& guide, const GuidePlace& place) {
  const sim::Vec3 none(0.0);
  if (place.order < guide.orders[0] || place.order > guide.orders[1]) return none;
  if (guide.box) {
    for (int axis = 0; axis < 3; ++axis) {
      if (place.at[axis] < (*guide.box)[0][axis] || place.at[axis] > (*guide.box)[1][axis]) return none;
    }
  }
  if (guide.region && !guide.region->holds(place.at)) return none;
  const Whorl whorl = whorlAt(guide, place.at);
  const sim::Vec3 axis = axisAt(guide, place);
  const double axis_length = glm::length(axis), away = glm::length(place.at - place.start);
  if (whorl.strength == 0.0 || axis_length == 0.0 || away == 0.0 || place.farthest <= 0.0) return none;
  const sim::Vec3 n = axis / axis_length;
  sim::Vec3 from_start = (place.at - place.start) / away;
  if (guide.axis == GuideAxis::node_normal || guide.axis == GuideAxis::attractor_normal) {
    from_start -= glm::dot(from_start, n) * n;
    const double left = glm::length(from_start);
    if (left < 1e-9) return none;
    from_start /= left;
  }
  const sim::Vec3 round = glm::cross(n, from_start) * (whorl.angle_deg * kDegree * away / place.farthest);
  return (guide.follows_normal ? whorl.strength * axis_length : whorl.strength) *
         glm::normalize(from_start + round);
}

sim::Vec3 guidedWay(sim::Vec3 pull, sim::Vec3 guide) {
  if (guide == sim::Vec3(0.0)) return pull;
  const sim::Vec3 sum = pull + guide;
  const double length = glm::length(sum);
  return length > 1e-9 ? sum / length : pull;
}

}  // namespace espalier::rules
