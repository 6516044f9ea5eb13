#pragma once
// Internal to sim/light/lighting.h: faces of voxels that are judged by themselves.
#include <cstdint>
#include <vector>

#include "sim/light/lighting.h"
#include "sim/light/surface.h"

namespace espalier::sim {

/// True if a face shows its voxel's surface.
bool belongs(const Surface& surface, std::uint8_t face);

Voxel voxelOfKey(std::uint64_t face_key, Voxel size);

/// Keys of the faces with a free voxel before them that belong to no surface, ascending.
std::vector<std::uint64_t> facesByThemselves(const World& world, const Lighting& light);

/// Adds receivers for faces after those that are there. Places are numbered anew.
void addFaces(SurfaceSensors& sensors, const std::vector<std::uint64_t>& faces, const BitVolume& opaque);

}  // namespace espalier::sim
