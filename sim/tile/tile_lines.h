#pragma once
// Internal to the room: lines as voxels.
#include <vector>

#include "sim/tile/build_world.h"
#include "sim/world/world.h"

namespace espalier::sim {

/// The voxels of the world that the lines of a mesh pass, region by region and line by line, each once. Lines
/// are cut to the world. Region r becomes part first_part + r; the colour is that of the mesh's material.
std::vector<TiledVoxel> tileLines(const TiledMesh& lines, const Frame& frame, PartId first_part);

}  // namespace espalier::sim
