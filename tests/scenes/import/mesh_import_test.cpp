#include "scenes/import/mesh_import.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "sim/base/hasher.h"
#include "tests/scenes/import/mesh_files.h"

namespace espalier::scenes {
namespace {

using tests::binarySquarePly;
using tests::binaryStl;
using tests::glb;
using tests::gltfBuffer;
using tests::gltfDocument;
using tests::kPaintMtl;
using tests::kSquareObj;
using tests::kSquarePly;
using Names = std::vector<std::string>;
class MeshImport : public tests::MeshFiles {};

double areaOf(const sim::Mesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto& p = mesh.vertices_m;
    area += 0.5 * glm::length(glm::cross(p[b] - p[a], p[c] - p[a]));
  }
  return area;
}

std::array<sim::Vec3, 2> boundsOf(const sim::Mesh& mesh) {
  sim::Vec3 low(1e30);
  sim::Vec3 high(-1e30);
  for (const auto& p : mesh.vertices_m) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return {low, high};
}

std::vector<std::string> regionNames(const sim::Mesh& mesh) {
  std::vector<std::string> names;
  for (const auto r : mesh.region) names.push_back(mesh.regions.at(r));
  return names;
}

void expectNear(const sim::Vec3& found, const sim::Vec3& expected, double within = 1e-6) {
  EXPECT_NEAR(glm::distance(found, expected), 0.0, within)
      << found.x << ' ' << found.y << ' ' << found.z << " is not " << expected.x << ' ' << expected.y << ' '
      << expected.z;
}

TEST_F(MeshImport, ObjGroupsMaterialsAndDisplayColoursMadeLinear) {
  write("paint.mtl", kPaintMtl);
  const auto mesh = importMesh(write("square.obj", kSquareObj), RegionsFrom::group);
  EXPECT_EQ(mesh.name, "square");
  EXPECT_EQ(regionNames(mesh), (Names{"lower right", "upper"}));
  EXPECT_NEAR(areaOf(mesh), 1.0, 1e-12);
  ASSERT_EQ(mesh.materials.size(), 2u);
  EXPECT_EQ(mesh.materials[mesh.material[0]].name, "red");
  const sim::Colour red = mesh.materials[mesh.material[0]].colour;
  EXPECT_EQ(red, sim::Colour(1, 0, 0));
  EXPECT_NEAR(mesh.materials[mesh.material[1]].colour.g, 0.21404f, 1e-5f);  // what sRGB 0.5 means as light
}

TEST_F(MeshImport, ObjNumbersInAllTheirWritings) {
  const auto mesh = importMesh(
      write("n.obj", "v -.5 +.5 1.\nv +5 -5e-1 1E+1\nv ,5 -,25 1,5\nv 1e-50 -0 5e-324\nf 1 2 3\nf 2 3 4\n"),
      RegionsFrom::group);
  ASSERT_EQ(mesh.vertices_m.size(), 6u);  // each polygon has corners of its own
  const sim::Vec3 expected[] = {{-.5, .5, 1}, {5, -.5, 10},    {.5, -.25, 1.5},
                                {5, -.5, 10}, {.5, -.25, 1.5}, {0, 0, 0}};
  for (std::size_t i = 0; i < 6; ++i) expectNear(mesh.vertices_m[i], expected[i]);
}

TEST_F(MeshImport, TellsTheHashOfEveryFileThatWasRead) {
  write("paint.mtl", kPaintMtl);
  MeshSources sources;
  importMesh(write("s.obj", kSquareObj), RegionsFrom::group, std::nullopt, &sources);
  EXPECT_EQ(sources.files, (std::vector<sim::InputFile>{{"s.obj", "mesh", sim::hashOf(kSquareObj)},
                                                        {"paint.mtl", "mesh_part", sim::hashOf(kPaintMtl)}}));
  auto document = gltfDocument();
  document["buffers"][0]["uri"] = "data.bin";
  write("data.bin", gltfBuffer());
  importMesh(write("t.gltf", document.dump()), RegionsFrom::group, std::nullopt, &sources);
  EXPECT_EQ(sources.files,
            (std::vector<sim::InputFile>{{"t.gltf", "mesh", sim::hashOf(document.dump())},
                                         {"data.bin", "mesh_part", sim::hashOf(gltfBuffer())}}));
}

TEST_F(MeshImport, ObjRegionsFromMaterials) {
  write("paint.mtl", kPaintMtl);
  EXPECT_EQ(regionNames(importMesh(write("square.obj", kSquareObj), RegionsFrom::material)),
            (Names{"red", "grey"}));
}

TEST_F(MeshImport, ObjObjectsAreGroupsAlsoWhenTakenUpAgain) {
  const auto mesh = importMesh(write("o.obj",
                                     "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no south wall\nf 1 2 3\no b\nf 1 "
                                     "2 3\no south wall\nf 1 2 3\n"),
                               RegionsFrom::group);
  auto names = regionNames(mesh);
  EXPECT_EQ(names, (Names{"o", "south wall", "b", "south wall"}));  // the nameless one after the file
}

TEST_F(MeshImport, WithoutGroupsMaterialsStandInAndThenTheFile) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(importMesh(write("a.obj", triangle + "usemtl wood\nf 1 2 3\n"), RegionsFrom::group).regions,
            (Names{"wood"}));
  EXPECT_EQ(importMesh(write("fence.obj", triangle + "f 1 2 3\n"), RegionsFrom::group).regions,
            (Names{"fence"}));
  EXPECT_EQ(importMesh(write("fence.obj", triangle + "f 1 2 3\n"), RegionsFrom::material).regions,
            (Names{"fence"}));
}

TEST_F(MeshImport, NamesBecomeValidText) {
  const auto mesh =
      importMesh(write("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng m\xc3\xbcr\nf 1 2 3\ng a\xff\x01z\nf 1 2 3\n"),
                 RegionsFrom::group);
  EXPECT_EQ(mesh.regions, (Names{"m\xc3\xbcr", "a\xef\xbf\xbd z"}));
}

TEST_F(MeshImport, GltfNodeTransformsNamesAndLinearColour) {
  for (const bool binary : {true, false}) {
    auto document = gltfDocument();
    if (!binary) {
      document["buffers"][0]["uri"] = "data.bin";
      write("data.bin", gltfBuffer());
    }
    const auto file = binary ? write("t.glb", glb(document, gltfBuffer())) : write("t.gltf", document.dump());
    const auto mesh = importMesh(file, RegionsFrom::group);
    EXPECT_EQ(regionNames(mesh), (Names{"turned", "leaf"}));  // the nameless node goes by its mesh
    ASSERT_EQ(mesh.triangles.size(), 2u);
    const auto corner = [&](std::size_t t, std::size_t c) { return mesh.vertices_m[mesh.triangles[t][c]]; };
    expectNear(corner(0, 0), {0, 10, 0});
    expectNear(corner(0, 1), {0, 11, 0});
    expectNear(corner(0, 2), {-1, 10, 0});
    expectNear(corner(1, 1), {2, 10, 0});
    expectNear(corner(1, 2), {0, 12, 0});
    EXPECT_EQ(mesh.materials.at(0).name, "paint");
    EXPECT_EQ(mesh.materials[0].colour, sim::Colour(0.25f, 0.5f, 1.0f));
    EXPECT_EQ(importMesh(file, RegionsFrom::material).regions, (Names{"paint"}));
  }
}

TEST_F(MeshImport, GltfMeshOfTwoPrimitivesIsOneRegion) {
  auto document = gltfDocument();
  auto& primitives = document["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[1].erase("material");
  const auto mesh = importMesh(write("t.glb", glb(document, gltfBuffer())), RegionsFrom::group);
  EXPECT_EQ(mesh.regions, (Names{"turned", "leaf"}));
  EXPECT_EQ(mesh.triangles.size(), 4u);
  ASSERT_EQ(mesh.materials.size(), 2u);
  EXPECT_EQ(mesh.materials[1].colour, sim::Material{}.colour);  // a primitive without a material
}

TEST_F(MeshImport, PlyInTextAndBinary) {
  for (const auto& file : {write("text.ply", kSquarePly), write("binary.ply", binarySquarePly())}) {
    const auto mesh = importMesh(file, RegionsFrom::group);
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_NEAR(areaOf(mesh), 1.0, 1e-12);
    EXPECT_EQ(mesh.regions, (Names{file.stem().string()}));
    EXPECT_EQ(mesh.materials.at(0).colour, sim::Material{}.colour);
  }
}

TEST_F(MeshImport, StlInTextAndBinary) {
  EXPECT_EQ(importMesh(write("b.stl", binaryStl(3)), RegionsFrom::group).triangles.size(), 3u);
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const auto mesh =
      importMesh(write("a.stl", "solid gate\n" + facet + "endsolid gate\n"), RegionsFrom::group);
  EXPECT_EQ(regionNames(mesh), (Names{"gate"}));
}

TEST_F(MeshImport, PolygonsAreTriangulatedAlsoWhereTheyBendInwards) {
  const auto mesh =
      importMesh(write("l.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n"),
                 RegionsFrom::group);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_NEAR(areaOf(mesh), 3.0, 1e-12);
}

TEST_F(MeshImport, DegenerateTrianglesAreDroppedAndCounted) {
  const auto mesh = importMesh(write("d.obj",
                                     "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.1 0.1 0\nv 0.2 0.2 0\nv 0.3 0.3 0\n"
                                     "g good\nf 1 2 3\ng thin\nf 1 1 2\nf 4 5 6\ng also\nf 1 3 2\n"),
                               RegionsFrom::group);
  EXPECT_EQ(mesh.degenerate_dropped, 2u);
  EXPECT_EQ(regionNames(mesh), (Names{"good", "also"}));
}

TEST_F(MeshImport, ACubeOfOneMillimetreKeepsItsTwelveTriangles) {
  for (const int exponent : {-3, -6, 3}) {
    const double edge = std::pow(10.0, exponent);
    std::string obj;
    for (int corner = 0; corner < 8; ++corner) {
      const auto at = [&](int bit) { return (corner & bit) != 0 ? 1 : 0; };
      obj += fmt::format("v {1}e{0} {2}e{0} {3}e{0}\n", exponent, at(1), at(2), at(4));
    }
    obj += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    const auto mesh = importMesh(write("cube.obj", obj), RegionsFrom::group);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_EQ(mesh.degenerate_dropped, 0u);
    EXPECT_NEAR(areaOf(mesh) / (6 * edge * edge), 1.0, 1e-5);
  }
}

TEST_F(MeshImport, PlacingScalesTurnsAboutXThenYThenZAndMoves) {
  const auto mesh = importMesh(write("t.obj", "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"), RegionsFrom::group);
  const auto quarter =
      placeMesh(mesh, {.scale = 2.0, .rotate_deg = {90, 90, 0}, .translate_m = {10, 20, 30}});
  EXPECT_EQ(quarter.vertices_m[0], sim::Vec3(10, 20, 28));  // x stays x, then becomes -z: exactly
  EXPECT_EQ(quarter.vertices_m[1], sim::Vec3(12, 20, 30));  // y becomes z, then x
  EXPECT_EQ(quarter.vertices_m[2], sim::Vec3(10, 18, 30));  // z becomes -y
  const auto slanted = placeMesh(mesh, {.rotate_deg = {0, 0, 30}});
  expectNear(slanted.vertices_m[0], {std::sqrt(3.0) / 2, 0.5, 0}, 1e-7);
  for (const double turn : {-270.0, 450.0, 810.0}) {
    EXPECT_EQ(placeMesh(mesh, {.rotate_deg = {0, 0, turn}}).vertices_m,
              placeMesh(mesh, {.rotate_deg = {0, 0, 90}}).vertices_m);
  }
  EXPECT_NEAR(glm::length(placeMesh(mesh, {.rotate_deg = {11, 22, 33}}).vertices_m[0]), 1.0, 1e-15);
}

TEST_F(MeshImport, UnitsBecomeMetresExactlyAndBeforeAnythingElse) {
  const auto mesh = importMesh(write("t.obj", "v 4 0 0\nv 0 -7 0\nv 0 0 12\nf 1 2 3\n"), RegionsFrom::group);
  const std::vector<std::pair<LengthUnit, sim::Vec3>> known = {{LengthUnit::m, {4, -7, 12}},
                                                               {LengthUnit::cm, {0.04, -0.07, 0.12}},
                                                               {LengthUnit::mm, {0.004, -0.007, 0.012}},
                                                               {LengthUnit::in, {0.1016, -0.1778, 0.3048}},
                                                               {LengthUnit::ft, {1.2192, -2.1336, 3.6576}}};
  for (const auto& [unit, metres] : known) {
    const auto placed = placeMesh(mesh, {.unit = unit});
    EXPECT_EQ(placed.vertices_m[0].x, metres.x) << nameOf(unit);
    EXPECT_EQ(placed.vertices_m[1].y, metres.y) << nameOf(unit);
    EXPECT_EQ(placed.vertices_m[2].z, metres.z) << nameOf(unit);
  }
  const auto all = placeMesh(mesh, {.unit = LengthUnit::cm, .scale = 2.0, .translate_m = {1, 0, 0}});
  EXPECT_EQ(all.vertices_m[0], sim::Vec3(1.08, 0, 0));
}

TEST_F(MeshImport, WhatIsUpInTheFileBecomesYWithoutAMirror) {
  const auto mesh = importMesh(write("t.obj", "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"), RegionsFrom::group);
  EXPECT_EQ(placeMesh(mesh, {.up = UpAxis::y}).vertices_m, mesh.vertices_m);
  const auto up = placeMesh(mesh, {.up = UpAxis::z}).vertices_m;
  EXPECT_EQ(up[0], sim::Vec3(1, 0, 0));
  EXPECT_EQ(up[1], sim::Vec3(0, 0, -1));
  EXPECT_EQ(up[2], sim::Vec3(0, 1, 0));
  EXPECT_EQ(glm::dot(glm::cross(up[0], up[1]), up[2]), 1.0);
  // Turned about y, which is z in the file.
  const auto turned = placeMesh(mesh, {.up = UpAxis::z, .rotate_deg = {0, 90, 0}}).vertices_m;
  EXPECT_EQ(turned[2], sim::Vec3(0, 1, 0));
  EXPECT_EQ(turned[0], sim::Vec3(0, 0, -1));
}

struct RealMesh {
  const char* file;
  std::size_t triangles;
  sim::Vec3 size_m;
};
void PrintTo(const RealMesh& mesh, std::ostream* out) {
  *out << mesh.file;
}

class RealMeshes : public ::testing::TestWithParam<RealMesh> {};

TEST_P(RealMeshes, AreReadWhole) {
  const auto file = std::filesystem::path(ESPALIER_SHARED_MESHES) / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  const auto mesh = importMesh(file, RegionsFrom::group);
  EXPECT_EQ(mesh.triangles.size() + mesh.degenerate_dropped, GetParam().triangles);
  const auto [low, high] = boundsOf(mesh);
  expectNear(high - low, GetParam().size_m, 0.007 * glm::length(GetParam().size_m));
}

INSTANTIATE_TEST_SUITE_P(All, RealMeshes,
                         ::testing::Values(RealMesh{"house_3.obj", 1632, {8.8, 6.1, 5.8}},
                                           RealMesh{"house_walls.obj", 239, {19, 3, 11.4}},
                                           RealMesh{"ruin_wall.glb", 2794, {8, 4, 1.3}},
                                           RealMesh{"bunny.obj", 69451, {0.156, 0.154, 0.121}}),
                         [](const auto& instance) {
                           return std::filesystem::path(instance.param.file).stem().string();
                         });

}  // namespace
}  // namespace espalier::scenes
