#pragma once
// Internal to the room: the surface of a mesh as voxels.
#include <vector>

#include "sim/tile/mesh.h"
#include "sim/world/world.h"

namespace espalier::sim {

/// The voxels of the world that a mesh's triangles intersect, in (y, z, x) order. `vertices_vx` are the
/// mesh's vertices in voxel space; region r becomes part first_part + r.
std::vector<TiledVoxel> tileMesh(const Mesh& mesh, const std::vector<Vec3>& vertices_vx, Voxel size,
                                 PartId first_part);

}  // namespace espalier::sim
