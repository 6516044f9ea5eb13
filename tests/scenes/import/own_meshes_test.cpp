#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>

#include "scenes/import/mesh_import.h"
#include "scenes/inspect/surface.h"
#include "tests/scenes/import/mesh_files.h"

/// The meshes in scenes/meshes. After a change to one of the scripts there: python3
/// scenes/meshes/make_<name>.py
namespace espalier::scenes {
namespace {

using Names = std::vector<std::string>;
namespace fs = std::filesystem;
const fs::path kMeshes = fs::path(ESPALIER_SOURCE_DIR) / "scenes/meshes";

class OwnMeshes : public tests::MeshFiles {};

TEST_F(OwnMeshes, HaveTheRegionsThatScenesName) {
  const auto wall = importMesh(kMeshes / "garden_wall.obj", RegionsFrom::group);
  EXPECT_EQ(wall.regions, (Names{"wall", "coping", "window", "paving", "bed", "kerb"}));
  EXPECT_LT(wall.triangles.size(), 60000u);
  EXPECT_EQ(wall.degenerate_dropped, 0u);
  for (const auto& p : wall.vertices_m) {
    ASSERT_TRUE(std::abs(p.x) <= 3.3001 && p.y >= -0.2001 && p.y < 3.7 && std::abs(p.z) <= 3.9001);
  }
  EXPECT_EQ(importMesh(kMeshes / "courtyard.obj", RegionsFrom::group).regions,
            (Names{"wall", "coping", "window", "bed", "kerb", "paving", "turf"}));
  EXPECT_EQ(importMesh(kMeshes / "column.obj", RegionsFrom::group).regions, (Names{"plinth", "column"}));
  EXPECT_EQ(importMesh(kMeshes / "maze_walls.obj", RegionsFrom::group).regions, (Names{"frame", "bars"}));
  EXPECT_EQ(importMesh(kMeshes / "street.obj", RegionsFrom::group).regions,
            (Names{"arcade", "facade_south", "facade_north", "facade_east", "facade_west", "roofs", "tower",
                   "street", "square", "pavement"}));
  EXPECT_EQ(importMesh(kMeshes / "lean_to.obj", RegionsFrom::group).regions,
            (Names{"wall", "coping", "roof", "timber", "bed", "paving"}));
  EXPECT_EQ(importMesh(kMeshes / "ruin.obj", RegionsFrom::group).regions,
            (Names{"wall", "window", "tracery", "fallen", "turf"}));
}

/// As meshes of others come: no two faces share a corner, and there are rims.
TEST_F(OwnMeshes, TheRuinIsOpenAndUnwelded) {
  const auto ruin = importMesh(kMeshes / "ruin.obj", RegionsFrom::group);
  std::vector<std::size_t> uses(ruin.vertices_m.size());
  for (const auto& corners : ruin.triangles) {
    for (const auto k : corners) ++uses[k];
  }
  // A face of four corners is two triangles that share two of them.
  EXPECT_LE(*std::max_element(uses.begin(), uses.end()), 6u);
  EXPECT_GT(surfaceOf(ruin).open_edges, 500u);
}

TEST_F(OwnMeshes, BodiesAreClosed) {
  for (const char* name : {"sphere", "wren", "cut_earth", "lawn"}) {
    const auto body = importMesh(kMeshes / (std::string(name) + ".obj"), RegionsFrom::group);
    using Place = std::array<double, 3>;
    std::map<std::pair<Place, Place>, int> ways;  // along an edge, one way and back
    for (const auto& corners : body.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto place = [&](std::size_t k) {
          const sim::Vec3 at = body.vertices_m[corners[k % 3]];
          return Place{at.x, at.y, at.z};
        };
        const Place a = place(i), b = place(i + 1);
        ways[std::minmax(a, b)] += a < b ? 1 : -1;
      }
    }
    for (const auto& [edge, way] : ways) ASSERT_EQ(way, 0) << name;
  }
}

TEST_F(OwnMeshes, AreWhatTheirScriptMakes) {
  if (std::system("python3 --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "python3 is not here";
  for (const char* script :
       {"masonry.py", "make_garden_wall.py", "make_courtyard.py", "make_street.py", "make_lean_to.py",
        "make_ruin.py", "make_arch.py", "make_shapes.py", "make_storm.py"}) {  // all use the first
    fs::copy_file(kMeshes / script, folder_ / script);
    ASSERT_EQ(std::system(("python3 '" + (folder_ / script).string() + "' >/dev/null").c_str()), 0);
  }
  for (const char* name :
       {"garden_wall", "courtyard", "column", "maze_walls", "street", "lean_to", "ruin", "arch_cm", "sphere",
        "wren", "lawn", "cut_earth", "storm_land", "storm_windows", "storm_cloud"}) {
    for (const char* ending : {".obj", ".mtl"}) {
      const auto made = folder_ / (std::string(name) + ending);
      EXPECT_TRUE(tests::readAll(made) == tests::readAll(kMeshes / made.filename())) << made.filename();
    }
  }
}

}  // namespace
}  // namespace espalier::scenes
