#include "render/form/stretch.h"

#include <algorithm>

#include "sim/tile/tiling.h"

namespace espalier::render {

using sim::NodeId;
using sim::Vec3;

Vec3 Stretch::at(double arc) const {
  if (arc <= 0.0) return points.front();
  if (arc >= length()) return points.back();
  const auto next = static_cast<std::size_t>(std::upper_bound(arcs.begin(), arcs.end(), arc) - arcs.begin());
  const double width = arcs[next] - arcs[next - 1];
  return glm::mix(points[next - 1], points[next], (arc - arcs[next - 1]) / width);
}

std::vector<Stretch> stretchesOf(const sim::Skeleton& skeleton) {
  const std::size_t count = skeleton.parent.size();
  std::vector<int> children(count, 0);
  for (const NodeId parent : skeleton.parent) {
    if (parent != sim::kNoNode) ++children[static_cast<std::size_t>(parent)];
  }
  std::vector<Stretch> stretches;
  std::vector<std::size_t> stretch_of(count, 0);
  for (std::size_t n = 0; n < count; ++n) {
    if (skeleton.parent[n] == sim::kNoNode) continue;
    const auto parent = static_cast<std::size_t>(skeleton.parent[n]);
    const Vec3 place = skeleton.position_vx[n];
    if (skeleton.parent[parent] == sim::kNoNode || children[parent] != 1) {
      stretch_of[n] = stretches.size();
      stretches.push_back({skeleton.parent[n], {}, {skeleton.position_vx[parent]}, {0.0}});
    } else {
      stretch_of[n] = stretch_of[parent];
    }
    Stretch& stretch = stretches[stretch_of[n]];
    stretch.arcs.push_back(stretch.length() + glm::distance(stretch.points.back(), place));
    stretch.points.push_back(place);
    stretch.nodes.push_back(static_cast<NodeId>(n));
  }
  return stretches;
}

bool enters(Vec3 from_vx, Vec3 to_vx, const KeptFree& blocked) {
  std::vector<sim::Voxel> voxels;
  sim::tileSegment(from_vx, to_vx, voxels);
  return std::any_of(voxels.begin(), voxels.end(), [&](sim::Voxel v) { return blocked(v); });
}

std::vector<Reshaped> asGrown(const sim::Skeleton& skeleton) {
  std::vector<Reshaped> ways;
  for (const Vec3 place : skeleton.position_vx) ways.push_back({std::nullopt, {place}, {1.0}});
  return ways;
}

}  // namespace espalier::render
