#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "sim/tile/build_world.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// How the world of a mesh file is made.
struct MeshWorld {
  double voxel_m = 0.1;                           ///< edge of a voxel
  std::optional<double> margin_m = std::nullopt;  ///< free space around the mesh, as for worldAround
  /// Fill the mesh's inside, or leave it hollow and its faces as they are wound. Unset: it is filled where it
  /// is closed, and faces turn to the light (scenes/import/facing.h).
  std::optional<bool> solid = std::nullopt;
};

/// The world of a mesh file on disk (scenes/import/mesh_import.h), its groups as regions. Throws
/// sim::InputError.
sim::World worldOf(const std::filesystem::path& mesh, const MeshWorld& made);

/// A world around meshes with `margin_m` of free space on every side: with three voxels of it where the world
/// would be thinner than that, as that of a wall without thickness, or leave room for light before no surface
/// at all. Without a margin it has three voxels at the sides and above, so that all that is seen from there
/// can be lit, and none below, where no light comes from. `layers`: how many boundary layers a world with
/// this frame has. `fills`: as for sim::buildWorld. Throws sim::InputError.
sim::World worldAround(const std::vector<sim::TiledMesh>& meshes, double voxel_m,
                       std::optional<double> margin_m, const std::function<int(const sim::Frame&)>& layers,
                       std::vector<sim::FillReport>* fills = nullptr);

}  // namespace espalier::scenes
