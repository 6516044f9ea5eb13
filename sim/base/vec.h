#pragma once
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <tuple>

namespace espalier::sim {

/// A continuous point or vector. Names say the space: `_m` for world metres, `_vx` for voxel widths.
using Vec3 = glm::dvec3;
/// A direction, normal or small quantity where float precision is plenty.
using Vec3f = glm::vec3;
/// Integer voxel coordinates. A voxel's centre is at integer coordinates; y is up.
using Voxel = glm::ivec3;
/// Linear RGB, 0..1 for surfaces.
using Colour = glm::vec3;

/// The order in which voxels are stored and listed: rows along x, rows by z, slices by y.
inline bool beforeInRows(Voxel a, Voxel b) {
  return std::tie(a.y, a.z, a.x) < std::tie(b.y, b.z, b.x);
}

}  // namespace espalier::sim
