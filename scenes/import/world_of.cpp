#include "scenes/import/world_of.h"

#include <algorithm>

#include "scenes/import/facing.h"
#include "scenes/import/mesh_import.h"
#include "sim/light/surface.h"

namespace espalier::scenes {

sim::World worldOf(const std::filesystem::path& mesh, const MeshWorld& made) {
  std::vector<sim::TiledMesh> meshes(1);
  meshes[0].mesh = importMesh(mesh, RegionsFrom::group);
  meshes[0].mesh.name = mesh.stem().string();
  meshes[0].solid = made.solid.value_or(false);
  meshes[0].where_closed = !made.solid;
  findFacing(meshes);
  return worldAround(meshes, made.voxel_m, made.margin_m, [](const sim::Frame&) { return 0; });
}

sim::World worldAround(const std::vector<sim::TiledMesh>& meshes, double voxel_m,
                       std::optional<double> margin_m, const std::function<int(const sim::Frame&)>& layers,
                       std::vector<sim::FillReport>* fills) {
  constexpr int kRoom_vx = 3;  // so far before a surface light is looked for
  const double room_m = kRoom_vx * voxel_m;
  const auto build = [&](const sim::Frame& frame) {
    if (fills != nullptr) fills->clear();
    return sim::buildWorld(frame, meshes, layers(frame), fills);
  };
  if (!margin_m) {
    sim::Frame frame = sim::frameAround(meshes, voxel_m, 0.0);
    frame.origin_m -= sim::Vec3(room_m, 0.0, room_m);
    frame.size += sim::Voxel(2 * kRoom_vx, kRoom_vx, 2 * kRoom_vx);
    return build(frame);
  }
  const sim::Frame frame = sim::frameAround(meshes, voxel_m, *margin_m);
  if (std::min({frame.size.x, frame.size.y, frame.size.z}) >= kRoom_vx) {
    sim::World world = build(frame);
    if (*margin_m >= room_m || sim::anyCanBeLit(world)) return world;
  }
  return build(sim::frameAround(meshes, voxel_m, std::max(*margin_m, room_m)));
}

}  // namespace espalier::scenes
