#include "scenes/made/pieces_made.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "scenes/import/mesh_import.h"
#include "scenes/job/run.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "tests/support/messages.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

/// A block, and a stick before it that is swept through: it cuts it three parts to seven.
constexpr const char* kBlock =
    "g block\nv 0 0 0\nv 1 0 0\nv 1 0 0.4\nv 0 0 0.4\nv 0 0.5 0\nv 1 0.5 0\nv 1 0.5 0.4\nv 0 0.5 0.4\n"
    "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
constexpr const char* kScene = R"(espalier: scene
meshes: [{file: block.obj, name: block}]
world: {voxel: 4 cm, margin: 20 cm}
sky: {directions: 24}
plants:
  - {name: stick, skeleton: {file: stick.obj}, rules: {}}
pieces:
  parts: {of: block, by: [stick], kerf: 4 cm, sweep: [0, 0, -1], voxel: 1 cm}
iterations: 3
image: {width: 48, height: 36}
cameras:
  main: {eye: [1.5, 1.5, 2], target: [0.5, 0.25, 0.2]}
images:
  - {kind: vines, name: whole, show: [scene, pieces]}
  - {kind: vines, name: apart, show: [scene, pieces], apart: 0.5}
  - {kind: vines, name: plain, show: [scene]}
)";

class PiecesInScenes : public testing::Test {
 protected:
  void SetUp() override {
    scratch_.write("block.obj", kBlock);
    scratch_.write("stick.obj", "v 0.3 -0.1 0.5\nv 0.3 0.6 0.5\nl 1 2\n");
    scratch_.write("short.obj", "v 0.3 0.3 0.5\nv 0.3 0.6 0.5\nl 1 2\n");
  }

  Report run(const std::string& text, bool pictures = false, bool strict = false) {
    const auto scene = readScene(scratch_.write("scene.yaml", text));
    EXPECT_TRUE(scene) << format(scene.problems());
    RunOptions options;
    options.folder = scratch_.path("out");
    options.pictures = pictures;
    options.strict = strict;
    return runScene(*scene, options);
  }
  std::string written(const std::string& file) const { return tests::fileText(scratch_.path("out/" + file)); }

  static std::string edited(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, text.npos);
    return text.replace(at, from.size(), to);
  }

  tests::Scratch scratch_;
};

/// By region the edges that have not two triangles, corners in one place being one; and what it encloses.
struct Region {
  std::size_t odd = 0;
  double volume_m3 = 0.0;
};
std::map<std::string, Region> regionsOf(const sim::Mesh& mesh) {
  std::map<std::string, Region> regions;
  std::map<std::tuple<std::uint32_t, std::array<double, 3>, std::array<double, 3>>, int> edges;
  const auto place = [&](std::uint32_t v) {
    const sim::Vec3& p = mesh.vertices_m[v];
    return std::array<double, 3>{p.x, p.y, p.z};
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    regions[mesh.regions[mesh.region[t]]].volume_m3 +=
        glm::dot(mesh.vertices_m[a], glm::cross(mesh.vertices_m[b], mesh.vertices_m[c])) / 6.0;
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}})
      ++edges[{mesh.region[t], std::min(place(from), place(to)), std::max(place(from), place(to))}];
  }
  for (const auto& [edge, count] : edges) regions[mesh.regions[std::get<0>(edge)]].odd += count != 2;
  return regions;
}

TEST_F(PiecesInScenes, AreNodesOfAModelThatAnotherSceneReads) {
  const Report report = run(kScene);
  ASSERT_EQ(report.pieces.size(), 1u);
  const Report::Pieces& told = report.pieces[0];
  EXPECT_NEAR(told.solid_m3, 0.2, 0.002);
  ASSERT_EQ(told.pieces.size(), 2u);
  EXPECT_NEAR(told.pieces[0].volume_m3, 0.2 * 0.68, 0.002);
  EXPECT_NEAR(told.pieces[1].volume_m3, 0.2 * 0.28, 0.002);
  EXPECT_TRUE(report.warnings.empty());

  const auto regions = regionsOf(importMesh(scratch_.path("out/parts.glb"), RegionsFrom::group));
  ASSERT_EQ(regions.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Region& region = regions.at(told.pieces[i].name);
    EXPECT_EQ(region.odd, 0u);
    EXPECT_NEAR(region.volume_m3, told.pieces[i].volume_m3, 1e-5);
  }
  const auto json = nlohmann::json::parse(written("report.json"));
  EXPECT_EQ(json["pieces"][0]["pieces"][1]["name"], "parts_2");
  scratch_.write("cut.yaml", kScene);
  EXPECT_EQ(run("espalier: scene\nmeshes: [{from: cut.yaml, product: parts}]\nworld: {voxel: 4 cm}\n"
                "plants: [{rules: {}, seeds: [[0.5, 0.6, 0.2]]}]\niterations: 0\n")
                .warnings.size(),
            0u);
}

TEST_F(PiecesInScenes, AreTheSameOnAnyNumberOfThreadsAndChangeNoGrowth) {
  std::set<std::string> models;
  const std::string rough = edited(kScene, "kerf: 4 cm", "kerf: 4 cm, rough: {amplitude: 1 cm, over: 20 cm}");
  std::uint64_t grown = 0;
  for (const int threads : {1, 2, 5}) {
    sim::onThreads(threads, [&] { grown = run(rough).growth->state_hash; });
    models.insert(written("parts.glb"));
  }
  EXPECT_EQ(models.size(), 1u);
  run(rough + "seed: 9\n");
  EXPECT_FALSE(models.contains(written("parts.glb")));
  std::string without = edited(
      kScene, "pieces:\n  parts: {of: block, by: [stick], kerf: 4 cm, sweep: [0, 0, -1], voxel: 1 cm}\n", "");
  without = without.substr(0, without.find("images:"));
  EXPECT_EQ(run(without).growth->state_hash, grown);
}

TEST_F(PiecesInScenes, StandInPlaceOfTheirMeshInPictures) {
  run(kScene, true);
  const std::set<std::string> pictures{written("whole.png"), written("apart.png"), written("plain.png")};
  EXPECT_EQ(pictures.size(), 3u);
  const auto scene = readScene(scratch_.path("scene.yaml"));
  RunOptions options;
  options.folder = scratch_.path("again");
  renderScene(*scene, scratch_.path("out"), options);
  EXPECT_EQ(tests::fileText(scratch_.path("again/apart.png")), written("apart.png"));
}

TEST_F(PiecesInScenes, WhatStaysInOnePieceIsTold) {
  const std::string text = edited(kScene, "stick.obj", "short.obj");
  const Report report = run(text);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("1 limb cuts 'block', and it stays in one piece"), std::string::npos)
      << report.warnings[0];
  EXPECT_EQ(report.pieces[0].pieces.size(), 1u);
  EXPECT_NE(tests::messageOf([&] { run(text, false, true); }).find("it stays in one piece"),
            std::string::npos);
  const Report none =
      run(edited(kScene, "skeleton: {file: stick.obj}", "seeds: [[0.5, 0.6, 0.2]]") + "seed: 1\n");
  EXPECT_FALSE(none.warnings.empty());
}

TEST_F(PiecesInScenes, WhatCannotBeCutIsToldBeforeAnythingGrows) {
  scratch_.write("block.obj", std::string(kBlock).substr(0, std::string(kBlock).rfind("f 4")));
  EXPECT_NE(tests::messageOf([&] {
              run(kScene);
            }).find("scene.yaml:8:3: mesh 'block': is not closed: 4 edges of it have no neighbour"),
            std::string::npos)
      << tests::messageOf([&] { run(kScene); });
}

/// The library's boulder falls apart whatever the seed, in larger voxels too, and so does a ball in its
/// place.
TEST(PiecesOfTheLibrary, ComeApart) {
  const auto read = readScene(ESPALIER_SOURCE_DIR "/scenes/library/split_boulder.yaml");
  ASSERT_TRUE(read);
  const tests::Scratch scratch;
  RunOptions options;
  options.folder = scratch.path("out");
  options.pictures = false;
  for (const int change : {0, 1, 2}) {
    Scene scene = *read;
    scene.pieces[0].voxel_m = 0.03;
    scene.pieces[0].kerf_m = 0.07;
    if (change == 0) scene.seed = 7;
    scene.world.voxel_m = change == 1 ? 0.05 / 0.7 : 0.05;
    if (change == 2) {
      scene.meshes[0].file = ESPALIER_SOURCE_DIR "/scenes/meshes/sphere.obj";
      scene.meshes[0].placement.translate_m.y = 0.5;
    }
    const Report report = runScene(scene, options);
    EXPECT_GE(report.pieces[0].pieces.size(), 3u) << change;
    EXPECT_TRUE(report.warnings.empty());
    for (const auto& [name, region] :
         regionsOf(importMesh(scratch.path("out/boulder_parts.glb"), RegionsFrom::group)))
      EXPECT_EQ(region.odd, 0u) << name;
  }
}

/// Others' meshes: what is closed is cut into closed pieces, what is not is refused.
TEST(PiecesOfStrangersMeshes, AreClosed) {
  const std::filesystem::path folder = ESPALIER_SHARED_MESHES;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".obj" || entry.path().extension() == ".glb") files.insert(entry.path());
  for (const auto& file : files) {
    SCOPED_TRACE(file.filename().string());
    const sim::Mesh mesh = importMesh(file, RegionsFrom::group);
    sim::Vec3 low(INFINITY), high(-INFINITY);
    for (const sim::Vec3& p : mesh.vertices_m) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    const sim::Vec3 size = high - low;
    const double longest = std::max({size.x, size.y, size.z});
    sim::CutSettings settings;
    settings.voxel_m = longest / 60.0;
    settings.kerf_m = 2.5 * settings.voxel_m;
    settings.sweep_m = {0.0, 0.0, 2.0 * size.z};
    const sim::Vec3 middle = 0.5 * (low + high);
    const std::vector<sim::CutLine> lines = {
        {{middle.x - 0.03 * size.x, low.y - size.y, low.z - 0.5 * size.z},
         {middle.x, middle.y, low.z - 0.5 * size.z}},
        {{middle.x, middle.y, low.z - 0.5 * size.z},
         {middle.x + 0.1 * size.x, high.y + size.y, low.z - 0.5 * size.z}}};
    try {
      sim::requireCuttable(mesh, settings);
    } catch (const sim::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("is not closed"), std::string::npos) << error.what();
      continue;
    }
    const sim::Pieces cut = sim::cutSolid(mesh, lines, settings);
    EXPECT_GE(cut.pieces.size(), 2u);
    double sum_m3 = cut.crumbs_m3;
    for (const sim::Piece& piece : cut.pieces) {
      for (const auto& [name, region] : regionsOf(piece.mesh)) EXPECT_EQ(region.odd, 0u) << name;
      sum_m3 += piece.volume_m3;
    }
    EXPECT_LT(sum_m3, cut.solid_m3);
    EXPECT_GT(sum_m3, 0.8 * cut.solid_m3);
  }
}

}  // namespace
}  // namespace espalier::scenes
