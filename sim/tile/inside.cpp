#include "sim/tile/inside.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/tile/fill.h"

namespace espalier::sim {

BitVolume insideOf(const Mesh& mesh, const Frame& frame) {
  Triangles triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    triangles.push_back({voxelFromWorld(frame, mesh.vertices_m[t[0]]),
                         voxelFromWorld(frame, mesh.vertices_m[t[1]]),
                         voxelFromWorld(frame, mesh.vertices_m[t[2]])});
    for (const Vec3& p : triangles.back()) {
      if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < kFarthestCorner) continue;
      throw InputError(
          fmt::format("mesh '{}': too large to know its inside, it reaches {} voxels beyond the "
                      "world; expected larger voxels, or a smaller mesh",
                      mesh.name, kFarthestCorner));
    }
  }
  return fillMesh(triangles, BitVolume(frame.size), true).inside;
}

}  // namespace espalier::sim
