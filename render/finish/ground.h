#pragma once
#include <vector>

#include "sim/tile/mesh.h"

namespace espalier::render {

/// The plane that carries on where a scene's floor ends, so that a picture of it does not look cut off.
struct Ground {
  double height_m = 0.0;
  sim::Colour colour{0.3f};
};

/// The height of the scene's widest level surface if that lies low and covers a good part of the scene, and
/// its mean colour; otherwise the scene's lowest point and a neutral grey.
Ground groundOf(const std::vector<const sim::Mesh*>& meshes, double voxel_m);

}  // namespace espalier::render
