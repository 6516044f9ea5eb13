#pragma once
#include <filesystem>

#include "sim/world/world.h"

namespace espalier::scenes {

/// The world of a mesh file on disk (scenes/import/mesh_import.h), its groups as regions, in voxels of
/// `voxel_m` metres, with `margin_m` of free space around it. Throws sim::InputError.
sim::World worldOf(const std::filesystem::path& mesh, double voxel_m, double margin_m = 0.0);

}  // namespace espalier::scenes
