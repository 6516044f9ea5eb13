#include "scenes/import/world_of.h"

#include <utility>
#include <vector>

#include "scenes/import/mesh_import.h"
#include "sim/tile/build_world.h"

namespace espalier::scenes {

sim::World worldOf(const std::filesystem::path& mesh, double voxel_m, double margin_m) {
  std::vector<sim::TiledMesh> meshes(1);
  meshes[0].mesh = importMesh(mesh, RegionsFrom::group);
  meshes[0].mesh.name = mesh.stem().string();
  return sim::buildWorld(sim::frameAround(meshes, voxel_m, margin_m), meshes, 0);
}

}  // namespace espalier::scenes
