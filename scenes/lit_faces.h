#pragma once
// Internal to scenes/lighting.h: faces of voxels that are judged by themselves.
#include <cstdint>
#include <vector>

#include "scenes/lighting.h"
#include "sim/light/surface.h"

namespace espalier::scenes {

inline constexpr std::uint8_t kFaces = 6;

/// True if a face shows its voxel's surface.
bool belongs(const sim::Surface& surface, std::uint8_t face);

sim::Voxel voxelOfKey(std::uint64_t face_key, sim::Voxel size);

/// Keys of the faces with a free voxel before them that belong to no surface, ascending.
std::vector<std::uint64_t> facesByThemselves(const sim::World& world, const Lighting& light);

/// Adds receivers for faces after those that are there. Places are numbered anew.
void addFaces(sim::SurfaceSensors& sensors, const std::vector<std::uint64_t>& faces,
              const sim::BitVolume& opaque);

}  // namespace espalier::scenes
