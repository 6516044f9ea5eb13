#include "sim/tile/tile_lines.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "sim/base/stop.h"
#include "sim/tile/tiling.h"

namespace espalier::sim {
namespace {

/// The part of a line that lies within a voxel of the world; nothing if none does.
std::optional<std::pair<Vec3, Vec3>> cut(Vec3 from, Vec3 to, Voxel size) {
  constexpr double kBeyond = 1.5;  // the half of the outermost voxels, and one
  double first = 0.0, last = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = -kBeyond, high = size[axis] - 1 + kBeyond, along = to[axis] - from[axis];
    if (along == 0.0) {
      if (from[axis] < low || from[axis] > high) return std::nullopt;
      continue;
    }
    const double a = (low - from[axis]) / along, b = (high - from[axis]) / along;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  if (first > last) return std::nullopt;
  // Ends that lie inside stay as they are, to the last bit.
  return std::pair(first > 0.0 ? glm::mix(from, to, first) : from,
                   last < 1.0 ? glm::mix(from, to, last) : to);
}

}  // namespace

std::vector<TiledVoxel> tileLines(const TiledMesh& lines, const Frame& frame, PartId first_part) {
  const Colour colour = lines.mesh.materials.empty() ? Material{}.colour : lines.mesh.materials[0].colour;
  std::vector<Line> in_order = lines.lines;
  std::stable_sort(in_order.begin(), in_order.end(),
                   [](const Line& a, const Line& b) { return a.region < b.region; });
  BitVolume seen(frame.size);
  std::vector<TiledVoxel> tiled;
  std::vector<Voxel> passed;
  for (const Line& line : in_order) {
    throwIfStopped();
    const auto inside = cut(voxelFromWorld(frame, line.from_m), voxelFromWorld(frame, line.to_m), frame.size);
    if (!inside) continue;
    passed.clear();
    tileSegment(inside->first, inside->second, passed);
    for (const Voxel v : passed) {
      if (!contains(frame.size, v) || seen.at(v)) continue;
      seen.set(v);
      tiled.push_back({v, {first_part + static_cast<PartId>(line.region), colour, 1.0f, Vec3f(0.0f)}});
    }
  }
  return tiled;
}

}  // namespace espalier::sim
