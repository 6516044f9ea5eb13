// Meshes as they are found in the wild, through the program.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "tests/support/meshes.h"
#include "tests/support/process.h"
#include "tests/support/scratch.h"

namespace espalier {
namespace {

using nlohmann::json;

constexpr const char* kWall = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\n";
constexpr const char* kCorner =
    "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 1\nv 2 0 1\ng wall\nusemtl brick\nf 1 2 3 4\ng floor\nf 1 5 6 "
    "2\n";

class Meshes : public testing::Test {
 protected:
  tests::Ran run(const std::string& command, const std::string& mesh, const std::string& more = "",
                 const std::string& world = "{voxel: 10 cm}") {
    scratch_.write("scene.yaml", "espalier: scene\nname: wild\nmeshes: [" + mesh + "]\nworld: " + world +
                                     "\nsky: {weighting: cosine, directions: 16}\n");
    return tests::espalier(command + " " + scratch_.path("scene.yaml").string() + " -o " +
                           scratch_.path("out").string() + " --no-pictures " + more);
  }
  json report() { return json::parse(tests::fileText(scratch_.path("out/report.json"))); }

  tests::Scratch scratch_;
};

TEST_F(Meshes, AnObjWithoutItsMtlIsGreyWithAWarning) {
  scratch_.write("corner.obj", std::string("mtllib lost.mtl\n") + kCorner);
  const std::string warning = "corner.obj:1:8: warning: the MTL file 'lost.mtl' is not there";
  for (const std::string command : {"grow", "expose"}) {
    const auto ran = run(command, "corner.obj");
    EXPECT_EQ(ran.status, 0) << ran.output;
    EXPECT_NE(ran.output.find(warning), std::string::npos) << ran.output;
    ASSERT_EQ(report()["warnings"].size(), 1u);
    EXPECT_TRUE(
        report()["warnings"][0].get<std::string>().starts_with("corner.obj:1:8: the MTL file 'lost.mtl'"));
  }
  const auto strict = run("grow", "corner.obj", "--strict");
  EXPECT_EQ(strict.status, 2) << strict.output;
  EXPECT_NE(strict.output.find("corner.obj:1:8: the MTL file 'lost.mtl' is not there"), std::string::npos)
      << strict.output;
  scratch_.write("lost.mtl", "newmtl brick\nKd 0.5 0.2 0.1\n");
  EXPECT_EQ(run("grow", "corner.obj", "--strict").status, 0);
}

TEST_F(Meshes, AColourOfTheScenesMakesUpForIt) {
  scratch_.write("corner.obj", std::string("mtllib lost.mtl\n") + kCorner);
  const auto ran = run("grow", "{file: corner.obj, colour: '#804020'}", "--strict");
  EXPECT_EQ(ran.status, 0) << ran.output;
  EXPECT_TRUE(report()["warnings"].empty());
}

TEST_F(Meshes, AWallWithoutThicknessAndMarginIsLit) {
  scratch_.write("wall.obj", std::string(kWall) + "f 4 3 2 1\n");
  const auto ran = run("expose", "wall.obj");
  EXPECT_EQ(ran.status, 0) << ran.output;
  EXPECT_NE(ran.output.find("wild: 27 x 14 x 7 voxels"), std::string::npos) << ran.output;
  const json table = json::parse(tests::fileText(scratch_.path("out/exposure.json")));
  EXPECT_NEAR(table["total"]["sky_exposure"]["mean"].get<double>(), 0.5, 0.02);  // half of the sky
  EXPECT_EQ(run("grow", "wall.obj").status, 0);
}

TEST_F(Meshes, WhatWasFoundOfAStrangersMeshIsTold) {
  std::string obj = tests::kCubeObj;  // inside out
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{{"f 1 2 3 4", "f 4 3 2 1"},
                                                                                 {"f 5 8 7 6", "f 6 7 8 5"},
                                                                                 {"f 1 5 6 2", "f 2 6 5 1"},
                                                                                 {"f 2 6 7 3", "f 3 7 6 2"},
                                                                                 {"f 3 7 8 4", "f 4 8 7 3"},
                                                                                 {"f 4 8 5 1", "f 1 5 8 4"}})
    obj.replace(obj.find(from), from.size(), to);
  scratch_.write("house.obj", obj);
  const auto ran = run("expose", "house.obj");
  EXPECT_EQ(ran.status, 0) << ran.output;
  for (const char* said : {"note: 12 triangles of 'house', 100 % of its area, face the other way",
                           "note: 'house' is closed, or nearly, and was filled"})
    EXPECT_NE(ran.output.find(said), std::string::npos) << said << '\n' << ran.output;
  const json world = json::parse(tests::fileText(scratch_.path("out/report.json")))["world"];
  EXPECT_EQ(world["turned"][0]["turned_triangles"], 12);
  EXPECT_EQ(world["fills"][0]["found"], true);
  const json table = json::parse(tests::fileText(scratch_.path("out/exposure.json")));
  EXPECT_GT(table["total"]["sky_exposure"]["mean"].get<double>(), 0.4);  // not black
}

TEST_F(Meshes, BoundsThatLeaveNoRoomAreTold) {
  scratch_.write("wall.obj", std::string(kWall) + "f 4 3 2 1\n");
  const auto ran =
      run("expose", "wall.obj", "", "{voxel: 10 cm, bounds: {min: [0, 0, 0], max: [2, 1, 0.1]}}");
  EXPECT_EQ(ran.status, 2);
  EXPECT_NE(ran.output.find("expected a mesh that has a side and free space before it within world.bounds"),
            std::string::npos)
      << ran.output;
}

TEST_F(Meshes, AGltfFileThatPromisesTooMuchIsRefusedByName) {
  scratch_.write(
      "big.gltf",
      R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 1073741824, "uri": "big.bin"}]})");
  scratch_.write("big.bin", "four");
  const auto ran = run("expose", "big.gltf");
  EXPECT_EQ(ran.status, 2);
  EXPECT_NE(ran.output.find("big.gltf: buffer 0: it promises 1073741824 bytes, and has 4\n"),
            std::string::npos)
      << ran.output;
}

TEST_F(Meshes, OfManyRegionsTheLargestAreListed) {
  std::string obj;
  for (int i = 0; i < 300; ++i) {
    const double x = 0.5 * (i % 20), z = 0.5 * (i / 20), edge = i == 7 ? 0.3 : 0.2;
    obj += fmt::format("v {} 0 {}\nv {} 0 {}\nv {} 0 {}\nv {} 0 {}\ng part {}\nf -4 -3 -2 -1\n", x, z, x,
                       z + edge, x + edge, z + edge, x + edge, z, i);
  }
  scratch_.write("many.obj", obj);
  const auto ran = run("expose", "many.obj", "", "{voxel: 10 cm, margin: 30 cm}");
  EXPECT_EQ(ran.status, 0) << ran.output;
  EXPECT_LT(std::count(ran.output.begin(), ran.output.end(), '\n'), 80) << ran.output;
  EXPECT_NE(ran.output.find("part 7 "), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("and 260 smaller regions, in exposure.csv\n"), std::string::npos) << ran.output;
  EXPECT_EQ(json::parse(tests::fileText(scratch_.path("out/exposure.json")))["regions"].size(), 300u);
}

}  // namespace
}  // namespace espalier
