#include "scenes/made/heights.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "render/image/image_io.h"
#include "scenes/import/mesh_import.h"
#include "scenes/job/run.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

/// A small land: lines that drain a square of 80 m from the middle of its lower side.
constexpr const char* kLand = R"(espalier: scene
world: {voxel: 1 m, bounds: {min: [-40, -2, -40], max: [40, 2, 40]}, layers: 0}
sky: {directions: 24}
attractors:
  land: {box: [78, 1, 78], at: [0, -0.5, 0], count: 150}
plants:
  - {name: rivers, rules: drainage, seeds: [[0, 0, 39]]}
heights:
  land:
    plants: rivers
    spacing: 1 m
    base: 10 m
    grade: 0.4
    slope: 0.8
    width: 0.5 m
    noise: {amplitude: 1 m, scale: 9 m}
    cover:
      meadow: {colour: "#65743f"}
      snow: {colour: "#f2f4f7", above: 22 m}
      water: {colour: "#41647c", on_lines: true}
iterations: 200
seed: 4
image: {width: 48, height: 36}
cameras:
  main: {eye: [0, 90, 110], target: [0, 15, 0], fov: 40}
images:
  - {kind: vines, name: view, show: [heights]}
)";

class HeightsInScenes : public testing::Test {
 protected:
  Scene scene(const std::string& text) const {
    auto read = readScene(scratch_.write("scene.yaml", text));
    EXPECT_TRUE(read) << format(read.problems());
    return *read;
  }
  Report run(const std::string& text, bool pictures = false) const {
    RunOptions options;
    options.folder = scratch_.path("out");
    options.pictures = pictures;
    return runScene(scene(text), options, {.keep = false});
  }
  std::string failure(const std::string& text) const {
    try {
      run(text);
    } catch (const PlacedError& error) {
      return scratch_.shown(error.problems());
    }
    return "";
  }
  std::string wrong(const std::string& text) const {
    return scratch_.shown(readScene(scratch_.write("scene.yaml", text)).problems());
  }
  std::string written(const std::string& file) const { return tests::fileText(scratch_.path("out/" + file)); }

  static std::string with(std::string text, const std::string& from, const std::string& to) {
    EXPECT_NE(text.find(from), text.npos) << from;
    return text.replace(text.find(from), from.size(), to);
  }

  tests::Scratch scratch_;
};

/// Goes down over the mesh from everywhere to the outlet, also with another seed and at another resolution.
TEST_F(HeightsInScenes, AreAMeshOverWhichWaterRunsDown) {
  for (const std::string& text : {std::string(kLand), with(kLand, "seed: 4", "seed: 9"),
                                  with(kLand, "spacing: 1 m", "spacing: 1.4 m")}) {
    run(text);
    const sim::Mesh mesh = importMesh(scratch_.path("out/land.glb"), RegionsFrom::group);
    EXPECT_EQ(std::set<std::string>(mesh.regions.begin(), mesh.regions.end()),
              (std::set<std::string>{"meadow", "snow", "water"}));
    ASSERT_FALSE(mesh.materials.empty());
    EXPECT_NE(mesh.materials[0].texture, nullptr);
    EXPECT_EQ(mesh.uvs.size(), mesh.vertices_m.size());
    // Regions have vertices of their own: places tell them apart.
    std::map<std::pair<double, double>, std::set<std::pair<double, double>>> beside;
    std::map<std::pair<double, double>, double> height;
    for (const auto& triangle : mesh.triangles) {
      for (int i = 0; i < 3; ++i) {
        const sim::Vec3 a = mesh.vertices_m[triangle[static_cast<std::size_t>(i)]],
                        b = mesh.vertices_m[triangle[static_cast<std::size_t>((i + 1) % 3)]];
        height[{a.x, a.z}] = a.y;
        beside[{a.x, a.z}].insert({b.x, b.z});
        beside[{b.x, b.z}].insert({a.x, a.z});
      }
    }
    int pits = 0;
    for (const auto& [place, its] : height)
      pits += std::none_of(beside[place].begin(), beside[place].end(),
                           [&, its = its](const auto& other) { return height[other] < its; });
    EXPECT_EQ(pits, 1) << "the outlet";
  }
}

TEST_F(HeightsInScenes, AreAPictureOfFloatsThatSaysWhereItLies) {
  run(kLand);
  const std::string exr = written("land.exr");
  for (const char* said : {"espalier:spacing_m", "espalier:first_x_m", "metres"})
    EXPECT_NE(exr.find(said), exr.npos) << said;
  const sim::Mesh mesh = importMesh(scratch_.path("out/land.glb"), RegionsFrom::group);
  double low = 1e9, high = -1e9;
  for (const sim::Vec3& vertex : mesh.vertices_m) {
    low = std::min(low, vertex.y);
    high = std::max(high, vertex.y);
  }
  EXPECT_NEAR(low, 10.0, 0.2) << "the outlet's";
  EXPECT_GT(high, 22.0);
}

TEST_F(HeightsInScenes, GrowWithTheirIterations) {
  run(with(kLand, "spacing: 1 m", "spacing: 1 m\n    iteration: 4"));
  const std::string early = written("land.glb");
  run(kLand);
  const auto whole = importMesh(scratch_.path("out/land.glb"), RegionsFrom::group).vertices_m;
  EXPECT_NE(written("land.glb"), early);
  run(with(kLand, "spacing: 1 m", "spacing: 1 m\n    iteration: 5000"));
  EXPECT_EQ(importMesh(scratch_.path("out/land.glb"), RegionsFrom::group).vertices_m, whole) << "at the end";
}

TEST_F(HeightsInScenes, AreSeenInPictures) {
  run(kLand, true);
  const render::Image seen = render::decodePng(written("view.png"));
  run(with(kLand, "above: 22 m", "above: 12 m"), true);
  EXPECT_NE(render::decodePng(written("view.png")).pixels, seen.pixels);
}

TEST_F(HeightsInScenes, NeverChangeWhatGrows) {
  const Report with_land = run(kLand);
  std::string bare(kLand);
  const auto from = bare.find("heights:"), to = bare.find("iterations:");
  bare.erase(from, to - from);
  bare.erase(bare.find("images:"));
  EXPECT_EQ(run(bare).growth->state_hash, with_land.growth->state_hash);
}

TEST_F(HeightsInScenes, WhatIsWrongIsSaidWithItsPlace) {
  EXPECT_NE(wrong(with(kLand, "plants: rivers\n", "plants: river\n")).find("no plant is called 'river'"),
            std::string::npos);
  EXPECT_NE(wrong(with(kLand, "above: 22 m", "above: 22 m, below: 20 m"))
                .find("nothing lies above the one and below"),
            std::string::npos);
  EXPECT_NE(
      wrong(with(kLand, "show: [heights]", "show: [heights], heights: lake")).find("no heights is called"),
      std::string::npos);
  const std::string away =
      failure(with(kLand, "spacing: 1 m", "spacing: 1 m\n    over: [[500, 500], [600, 600]]"));
  EXPECT_NE(away.find("water would have no outlet"), std::string::npos) << away;
  EXPECT_TRUE(away.starts_with("scene.yaml:9:")) << away;
  const std::string vast = failure(with(kLand, "spacing: 1 m", "spacing: 0.00001 m"));
  EXPECT_NE(vast.find("expected a spacing of at least"), std::string::npos) << vast;
  const std::string none = failure(with(kLand, "iterations: 200", "iterations: 0"));
  EXPECT_NE(none.find("have no line after all iterations"), std::string::npos) << none;
}

}  // namespace
}  // namespace espalier::scenes
