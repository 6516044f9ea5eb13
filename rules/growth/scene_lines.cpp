#include "rules/growth/scene_lines.h"

#include <algorithm>

#include "rules/growth/nearest_among.h"

namespace espalier::rules {
namespace {

constexpr const char *kFrom = "from", *kTo = "to";

sim::Vec3 nearestOn(const LineEnds& line, sim::Vec3 at_vx) {
  const sim::Vec3 way = line.second - line.first;
  const double square = glm::dot(way, way);
  if (square == 0.0) return line.first;  // a point
  return line.first + std::clamp(glm::dot(at_vx - line.first, way) / square, 0.0, 1.0) * way;
}

}  // namespace

sim::Columns columnsOf(std::span<const LineEnds> lines_vx) {
  sim::Columns columns;
  auto& from = sim::column<sim::Vec3>(columns, kFrom);
  auto& to = sim::column<sim::Vec3>(columns, kTo);
  for (const auto& [first, last] : lines_vx) {
    from.push_back(first);
    to.push_back(last);
  }
  return columns;
}

LinesNear::LinesNear(const sim::Commons& commons, sim::Vec3 about_vx, double reach_vx) {
  const auto known = commons.find(kSceneLines);
  if (known == commons.end()) return;
  const auto& from = sim::column<sim::Vec3>(known->second, kFrom);
  const auto& to = sim::column<sim::Vec3>(known->second, kTo);
  for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i) {
    const LineEnds line(from[i], to[i]);
    if (glm::distance(nearestOn(line, about_vx), about_vx) < reach_vx) lines_.push_back(line);
  }
}

std::optional<sim::Vec3> LinesNear::nearest(sim::Vec3 at_vx, double within_vx) const {
  return nearestAmong(lines_, at_vx, within_vx, nearestOn);
}

}  // namespace espalier::rules
