#pragma once
#include <functional>
#include <span>
#include <vector>

#include "sim/base/frame.h"
#include "sim/base/vec.h"
#include "sim/tile/build_world.h"

namespace espalier::sim {

/// What a voxel's surface sends out by itself.
struct EmittingVoxel {
  Voxel voxel;
  Colour light{0.0f};  ///< linear, mean over the surface in it
};

/// The voxels of triangles whose materials emit, in (y, z, x) order, with the light that they send out. Where
/// a part only of what lies in a voxel emits, the voxel's light is less by as much: `covered` gives the area
/// of all that lies in a voxel, over that of a face. Guides send nothing.
std::vector<EmittingVoxel> emissionOf(const Frame& frame, std::span<const TiledMesh> meshes,
                                      const std::function<float(Voxel)>& covered);

}  // namespace espalier::sim
