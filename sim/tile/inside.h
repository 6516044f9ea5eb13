#pragma once
#include "sim/base/bits.h"
#include "sim/base/frame.h"
#include "sim/tile/mesh.h"

namespace espalier::sim {

/// The voxels of a frame whose centres lie inside a mesh, as solids are filled: by vote, so that the mesh may
/// be inside out and have holes. Throws InputError where it reaches farther beyond the frame than can be
/// filled.
BitVolume insideOf(const Mesh& mesh, const Frame& frame);

}  // namespace espalier::sim
