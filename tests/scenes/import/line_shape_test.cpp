#include "scenes/import/line_shape.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/support/messages.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;

constexpr const char* kRail =
    "o rail\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 5\nl 1 2 3\ng knobs\np 4 -1\nusemtl iron\nl 1/1 -1\n";

TEST(LinesIn, AreThoseOfTheFileByGroupsOrMaterials) {
  const LineArt art = linesIn(kRail, RegionsFrom::group, "file");
  EXPECT_EQ(art.regions, (std::vector<std::string>{"rail", "knobs"}));
  ASSERT_EQ(art.lines.size(), 5u);
  EXPECT_EQ(art.lines[1].from_m, Vec3(1, 0, 0));
  EXPECT_EQ(art.lines[1].to_m, Vec3(1, 1, 0));
  EXPECT_EQ(art.lines[2].from_m, art.lines[2].to_m) << "a point";
  EXPECT_EQ(art.lines[3].from_m, Vec3(0, 0, 5));
  EXPECT_EQ(art.lines[4].region, 1u);
  EXPECT_EQ(linesIn(kRail, RegionsFrom::material, "file").regions,
            (std::vector<std::string>{"file", "iron"}));
}

TEST(LinesIn, BadOnesAreRefusedWithTheirLine) {
  const auto said = [](const std::string& obj) {
    return tests::messageOf([&] { linesIn(obj, RegionsFrom::group, "file"); });
  };
  EXPECT_NE(said("v 0 0 0\nl 1 2\n").find("line 2"), std::string::npos);
  EXPECT_EQ(said("v 0 0 0\nl 1\n"), "line 2: a line of fewer than two vertices");
  EXPECT_EQ(said("p\n"), "line 1: a point of no vertex");
  EXPECT_NE(said("v 0 zero 0\n").find("'zero' is not a finite number"), std::string::npos);
  EXPECT_NE(said("v 0 0 0\nl 0 1\n").find("line 2"), std::string::npos);
}

TEST(LineFile, IsOneWithoutFaces) {
  const tests::Scratch scratch;
  sim::InputFile read;
  EXPECT_TRUE(readLineFile(scratch.write("rail.obj", kRail), RegionsFrom::group, read));
  EXPECT_EQ(read.name, "rail.obj");
  EXPECT_FALSE(
      readLineFile(scratch.write("face.obj", std::string(kRail) + "f 1 2 3\n"), RegionsFrom::group, read));
  EXPECT_FALSE(readLineFile(scratch.write("dots.obj", "v 0 0 0\n"), RegionsFrom::group, read));
  const auto none = scratch.path("none.obj");
  EXPECT_TRUE(
      tests::messageOf([&] { readLineFile(none, RegionsFrom::group, read); }).starts_with(none.string()));
}

TEST(LineShape, IsPlacedAndClosedAroundItsLines) {
  SceneMesh spec;
  spec.name = "rail";
  spec.lines_m = {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 2, 0)}, {Vec3(0, 1, 0)}};
  spec.placement.scale = 2.0;
  spec.placement.translate_m = Vec3(0, 0, 7);
  spec.thickness_m = 0.1;
  spec.guide = true;
  const sim::TiledMesh tiled = lineShape(spec, linesOf(spec));
  EXPECT_TRUE(tiled.guide);
  ASSERT_EQ(tiled.lines.size(), 3u);
  EXPECT_EQ(tiled.lines[1].to_m, Vec3(2, 4, 7));
  EXPECT_EQ(tiled.lines[2].from_m, Vec3(0, 2, 7));
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : tiled.mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, times] : edges) {
    EXPECT_EQ(times, 1);
    EXPECT_EQ((edges[{edge.second, edge.first}]), 1)
        << "each edge once in either way: closed, and of one side";
  }
  double volume = 0.0;
  for (const auto& [a, b, c] : tiled.mesh.triangles) {
    const auto& v = tiled.mesh.vertices_m;
    volume += glm::dot(v[a], glm::cross(v[b], v[c])) / 6.0;
  }
  EXPECT_GT(volume, 0.0) << "faces look out";
}

}  // namespace
}  // namespace espalier::scenes
