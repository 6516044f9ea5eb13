// What comes back from the child that reads a mesh: a damaged file may have made anything of it. Unpacked,
// checked, placed and tiled.
#include "scenes/import/mesh_import.h"
#include "scenes/import/mesh_wire.h"
#include "scenes/inspect/looks.h"
#include "scenes/inspect/surface.h"
#include "sim/base/error.h"
#include "sim/tile/build_world.h"
#include "tests/fuzz/target.h"
#include "tests/support/meshes.h"

namespace espalier::fuzz {

std::vector<std::string> seeds() {
  sim::Mesh two = tests::boxMesh(sim::Vec3(-2.0), sim::Vec3(3.0, 1.0, 2.0));
  two.regions.push_back("other");
  two.materials.push_back({.name = "paint"});
  two.region.back() = two.material.back() = 1;
  two.degenerate_dropped = 2;
  return {scenes::packMesh(tests::boxMesh(sim::Vec3(0.0), sim::Vec3(1.0))),
          scenes::packMesh(two, {{{"mesh.obj", "mesh", 7}, {"paint.mtl", "mesh_part", 9}}, {}})};
}

}  // namespace espalier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace espalier;
  try {
    scenes::MeshSources read, again;
    sim::Mesh mesh = scenes::meshFromChild(fuzz::textOf(data, size), read);
    const std::string packed = scenes::packMesh(mesh, read);
    fuzz::require(scenes::packMesh(scenes::meshFromChild(packed, again), read) == packed,
                  "a mesh that is packed otherwise");
    mesh = scenes::placeMesh(std::move(mesh),
                             {.scale = 0.5, .rotate_deg = {0.0, 45.0, 0.0}, .translate_m = {0.25, 0.0, 0.0}});
    if (const scenes::MeshShape shape = scenes::shapeOf(mesh); scenes::isOfALength(shape)) {
      const scenes::Surface surface = scenes::surfaceOf(mesh);
      fuzz::require(surface.flipped <= mesh.triangles.size() && surface.duplicates < mesh.triangles.size() &&
                        std::isfinite(surface.winding),
                    "a surface that cannot be");
      scenes::unitOf(shape, scenes::upOf(shape, false).up, false);
    }
    sim::buildWorld({sim::Vec3(-3.5), 1.0, {8, 8, 8}}, {{mesh, size % 2 == 1}}, 1);
  } catch (const sim::InputError&) {
  }
  return 0;
}
