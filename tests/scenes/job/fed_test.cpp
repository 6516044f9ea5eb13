#include "scenes/job/fed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "render/image/image_io.h"
#include "scenes/job/check.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "tests/scenes/job/changed_scene.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;

/// A wall with a vine on it, and a picture of it.
constexpr const char* kWall = R"(espalier: scene
meshes:
  - {file: plot.obj, name: plot}
world: {voxel: 10 cm, margin: 20 cm}
sky: {directions: 24}
plants:
  - {name: vine, rules: {random_tree: {trials: {min: 4, max: 20}}}, seeds: [[-0.4, 0.25, 0.25]]}
iterations: 5
image: {width: 24, height: 16}
cameras:
  main: {eye: [2.2, 1.6, 3.2], target: [0, 0.5, 0]}
images:
  - {kind: vines, name: view}
  - {kind: cut_out, name: sheet, mesh: plot}
)";

/// Something on what another scene makes.
constexpr const char* kOnIt = R"(espalier: scene
meshes:
  - {from: wall.yaml, product: plant, scale: 1.5}
world: {voxel: 15 cm, margin: 40 cm}
sky: {directions: 24}
plants:
  - {name: shoot, rules: {random_tree: {trials: {min: 4, max: 20}}}, seeds: [[-1, 0.4, 0.9]]}
iterations: 5
)";

class Fed : public testing::Test {
 protected:
  void SetUp() override {
    scratch_.write("plot.obj", tests::kChangedMesh);
    scratch_.write("paint.mtl", "newmtl stone\nKd 0.5 0.5 0.5\nnewmtl brick\nKd 0.6 0.2 0.1\n");
    scratch_.write("wall.yaml", kWall);
  }

  Scene scene(const std::string& name, const std::string& text) const {
    auto read = readScene(scratch_.write(name, text));
    EXPECT_TRUE(read) << format(read.problems());
    return *read;
  }

  /// What was done to other scenes while this one ran.
  std::vector<std::string> grow(const std::string& text, const std::string& folder = "out") {
    std::vector<std::string> of_others;
    RunOptions options;
    options.folder = scratch_.path(folder);
    options.pictures = false;
    options.on_stage = [&](const std::string& stage) {
      if (stage.find(" of ") != stage.npos) of_others.push_back(stage);
    };
    report_ = runScene(scene("scene.yaml", text), options);
    return of_others;
  }

  std::string wrong(const std::string& name, const std::string& text) const {
    return scratch_.shown(readScene(scratch_.write(name, text)).problems());
  }

  /// The folders of what other scenes made.
  std::vector<std::string> madeIn(const std::string& folder = "out") const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(scratch_.path(folder) / kFedFolder))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  static std::string with(std::string text, const std::string& from, const std::string& to) {
    EXPECT_NE(text.find(from), text.npos) << from;
    return text.replace(text.find(from), from.size(), to);
  }

  tests::Scratch scratch_;
  Report report_;
};

TEST_F(Fed, AMeshIsTakenAsIfItsFileWereNamed) {
  EXPECT_FALSE(grow(kOnIt).empty());
  const std::uint64_t hash = report_.growth->state_hash;
  RunOptions options;
  options.folder = scratch_.path("wall");
  options.pictures = false;
  runScene(*readScene(scratch_.path("wall.yaml")), options);
  EXPECT_TRUE(
      grow(with(kOnIt, "from: wall.yaml, product: plant", "file: wall/plant.glb, name: plant"), "by_file")
          .empty());
  EXPECT_EQ(report_.growth->state_hash, hash);
  EXPECT_GT(report_.growth->plants.at(0).segments, 3u);
  // What reports name it by, and nothing of the machine.
  const auto report = nlohmann::json::parse(tests::fileText(scratch_.path("out/report.json")));
  EXPECT_EQ(report.at("inputs").at(1).at("file"), "wall.yaml/plant.glb");
}

TEST_F(Fed, IsMadeOnceUntilSomethingThatItWasMadeFromChanges) {
  EXPECT_FALSE(grow(kOnIt).empty());
  const auto first = madeIn();
  ASSERT_EQ(first.size(), 1u);
  EXPECT_TRUE(grow(kOnIt).empty());
  EXPECT_TRUE(grow(with(kOnIt, "iterations: 5", "iterations: 6")).empty()) << "it does not hang on who asks";
  scratch_.write("paint.mtl", "newmtl stone\nKd 0.1 0.5 0.5\nnewmtl brick\nKd 0.6 0.2 0.1\n");
  EXPECT_FALSE(grow(kOnIt).empty()) << "a file that only the mesh file names";
  EXPECT_EQ(madeIn(), first);
  fs::resize_file(scratch_.path("out") / kFedFolder / first[0] / "plant.glb", 100);
  EXPECT_FALSE(grow(kOnIt).empty()) << "somebody cut the product";
  EXPECT_TRUE(grow(kOnIt).empty());
  scratch_.write("wall.yaml", with(kWall, "iterations: 5", "iterations: 3"));
  EXPECT_FALSE(grow(kOnIt).empty());
  EXPECT_EQ(madeIn().size(), 1u) << "the older one goes";
  EXPECT_NE(madeIn(), first);
}

TEST_F(Fed, ScenesInARowFeedEachOther) {
  scratch_.write("middle.yaml", kOnIt);
  const std::string last = with(with(kOnIt, "from: wall.yaml", "from: middle.yaml"),
                                "seeds: [[-1, 0.4, 0.9]]", "seeds: [[-2, 0.8, 1.5]]");
  EXPECT_FALSE(grow(last).empty());
  EXPECT_EQ(madeIn().size(), 2u);
  EXPECT_TRUE(grow(last).empty());
  scratch_.write("wall.yaml", with(kWall, "[[-0.4, 0.25, 0.25]]", "[[-0.4, 0.25, 0.55]]"));
  const auto stages = grow(last);
  const auto of = [&](const std::string& name) {
    return std::count_if(stages.begin(), stages.end(), [&](const auto& s) { return s.ends_with(name); });
  };
  EXPECT_GT(of("wall.yaml"), 0);
  EXPECT_GT(of("middle.yaml"), 0) << "what it was made from is another now";
}

/// Another run in the same folder would remove what this one took, as its scene asks for another state of it.
TEST_F(Fed, WhatALivingRunTakesStays) {
  const FedScene has = fed(scene("scene.yaml", kOnIt), scratch_.path("out"), {});
  const fs::path mesh = has.scene.meshes.at(0).file;
  ASSERT_TRUE(fs::exists(mesh));
  scratch_.write("wall.yaml", with(kWall, "[[-0.4, 0.25, 0.25]]", "[[-0.4, 0.25, 0.55]]"));
  EXPECT_THROW(fed(scene("scene.yaml", kOnIt), scratch_.path("out"), {}), sim::InputError);
  EXPECT_TRUE(fs::exists(mesh));
}

TEST_F(Fed, APictureIsPaintedOnElements) {
  const std::string leaves =
      "elements: [{name: leaf, from: wall.yaml, product: sheet, size: 0.4}], random_tree";
  const Scene asks = scene("scene.yaml", with(kWall, "random_tree", leaves));
  EXPECT_EQ(asks.plants[0].rules->elements[0].picture, nullptr);
  RunOptions options;
  const Scene has = fed(asks, scratch_.path("out"), options).scene;
  const rules::Element& leaf = has.plants[0].rules->elements[0];
  ASSERT_NE(leaf.picture, nullptr);
  const auto drawn =
      render::decodePng(tests::fileText(scratch_.path("out") / kFedFolder / madeIn()[0] / "sheet.png"));
  EXPECT_EQ(leaf.picture->width, drawn.width);
  EXPECT_EQ(leaf.picture->height, drawn.height);
  EXPECT_FALSE(leaf.polygons.empty());
  EXPECT_NE(leaf.colour, rules::Element().colour) << "the picture's";
  EXPECT_FALSE(fs::exists(scratch_.path("out") / kFedFolder / madeIn()[0] / "view.png")) << "nobody asked";
  const Scene own =
      fed(scene("scene.yaml", with(kWall, "random_tree", with(leaves, "size", "colour: \"#102030\", size"))),
          scratch_.path("out"), options)
          .scene;
  EXPECT_NE(own.plants[0].rules->elements[0].colour, leaf.colour);
  EXPECT_EQ(grow(with(kWall, "random_tree", leaves)).size(), 0u);
  EXPECT_GT(report_.growth->plants.at(0).elements, 0u);
}

TEST_F(Fed, SkeletonsAreThoseThatGrewThere) {
  grow(kWall, "wall");
  const std::size_t segments = report_.growth->plants.at(0).segments;
  grow(with(kWall, "seeds: [[-0.4, 0.25, 0.25]]", "skeleton: {from: wall.yaml}"), "again");
  ASSERT_EQ(report_.growth->plants.size(), 1u);
  EXPECT_TRUE(report_.growth->plants[0].given);
  EXPECT_EQ(report_.growth->plants[0].segments, segments);
}

/// Heights are written as EXR by this very process, and read again in a child of it.
TEST_F(Fed, APictureSaysWhereAttractorsAreDense) {
  scratch_.write("land.yaml", R"(espalier: scene
world: {voxel: 1 m, bounds: {min: [-20, -2, -20], max: [20, 2, 20]}, layers: 0}
sky: {directions: 24}
attractors: {land: {box: [38, 1, 38], at: [0, -0.5, 0], count: 60}}
plants: [{name: rivers, rules: drainage, seeds: [[0, 0, 19]]}]
heights: {land: {plants: rivers, spacing: 1 m, base: 1 m}}
iterations: 100
)");
  grow(R"(espalier: scene
world: {voxel: 1 m, bounds: {min: [-20, -2, -20], max: [20, 9, 20]}}
sky: {directions: 24}
attractors:
  high:
    picture: {from: land.yaml, product: land, top_left: [-20, 2, -20], top_right: [20, 2, -20], bottom_left: [-20, 2, 20]}
    count: 200
plants:
  - {name: tree, rules: {propagate: colonization, colonization: {attractors: high}}, seeds: [[0, 0.2, 0]]}
iterations: 100
)");
  EXPECT_GT(report_.growth->plants.at(0).segments, 50u);
}

TEST_F(Fed, TheSameBytesOnAnyNumberOfThreads) {
  std::vector<std::string> models;
  for (const int threads : {1, 5}) {
    const std::string folder = "out_" + std::to_string(threads);
    sim::onThreads(threads, [&] { grow(kOnIt, folder); });
    models.push_back(tests::fileText(scratch_.path(folder + "/plant.glb")));
  }
  EXPECT_EQ(models[0], models[1]);
}

TEST_F(Fed, WhatIsWrongIsSaidWithItsPlace) {
  const auto asks = [](const std::string& mesh) {
    return "espalier: scene\nmeshes:\n  - " + mesh + "\nworld: {voxel: 15 cm}\n";
  };
  EXPECT_EQ(wrong("a.yaml", asks("{from: wal.yaml, product: plant}")),
            "a.yaml:3:12: there is no scene file wal.yaml; expected one");
  EXPECT_EQ(wrong("a.yaml", asks("{from: wall.yaml, product: plent}")),
            "a.yaml:3:12: the scene wall.yaml makes no mesh 'plent'; expected one of plant; did you mean "
            "'plant'?");
  EXPECT_EQ(wrong("a.yaml", asks("{product: plant, file: plot.obj}")),
            "a.yaml:3:15: product means nothing without from; expected from: SCENE.yaml beside it");
  EXPECT_EQ(wrong("a.yaml", asks("{from: wall.yaml, file: plot.obj}")),
            "a.yaml:3:29: file means nothing beside from; expected one of them");
  scratch_.write("bare.yaml", "espalier: scene\nmeshes: [{file: plot.obj}]\nworld: {voxel: 15 cm}\n");
  EXPECT_EQ(wrong("a.yaml", asks("{from: bare.yaml}")),
            "a.yaml:3:12: the scene bare.yaml makes no mesh; expected one that does");
  const std::string leaf = with(kWall, "random_tree", "elements: [{from: wall.yaml}], random_tree");
  EXPECT_EQ(wrong("a.yaml", leaf),
            "a.yaml:7:44: the scene wall.yaml makes more than one picture; expected product: with one of "
            "view, sheet");
  scratch_.write("wall.yaml", with(kWall, "voxel: 10 cm", "voxel: 10 parsec"));
  const std::string inside = wrong("a.yaml", asks("{from: wall.yaml}"));
  EXPECT_TRUE(inside.starts_with("wall.yaml:4:16: ")) << inside;
}

TEST_F(Fed, NoSceneIsMadeFromItself) {
  EXPECT_EQ(
      wrong("scene.yaml", with(kOnIt, "wall.yaml", "scene.yaml")),
      "scene.yaml:3:12: scenes that feed each other in a circle: scene.yaml -> scene.yaml; expected one of "
      "them to do without the other's product");
  scratch_.write("b.yaml", with(kOnIt, "wall.yaml", "a.yaml"));
  EXPECT_EQ(
      wrong("a.yaml", with(kOnIt, "wall.yaml", "b.yaml")),
      "b.yaml:3:12: scenes that feed each other in a circle: a.yaml -> b.yaml -> a.yaml; expected one of "
      "them to do without the other's product");
  // By way of a rule file.
  scratch_.write("leaf.yaml", "espalier: rules\nelements: [{name: leaf, from: wall.yaml, product: view}]\n");
  const std::string round = wrong("wall.yaml", with(kWall, "{random_tree", "{base: leaf.yaml, random_tree"));
  EXPECT_NE(round.find("leaf.yaml:2:31: scenes that feed each other in a circle"), round.npos) << round;
}

TEST_F(Fed, CheckingLeavesNothingBehind) {
  const fs::path temporary = scratch_.path("tmp");
  fs::create_directories(temporary);
  const std::string before = fs::temp_directory_path().string();
  setenv("TMPDIR", temporary.c_str(), 1);
  const Checked checked = checkFile(scratch_.write("scene.yaml", kOnIt), CheckDepth::site, {});
  setenv("TMPDIR", before.c_str(), 1);
  EXPECT_TRUE(checked.errors.empty()) << format(checked.errors);
  EXPECT_TRUE(checked.foretold.has_value());
  EXPECT_TRUE(fs::is_empty(temporary));
  // What is wrong with the site that the product makes is found.
  const Checked in_wall = checkFile(
      scratch_.write("scene.yaml", with(kOnIt, "[[-1, 0.4, 0.9]]", "[[-1, 40, 0.9]]")), CheckDepth::site, {});
  EXPECT_FALSE(in_wall.errors.empty());
}

TEST_F(Fed, WhatIsMissingThereIsMissingHere) {
  scratch_.write("wall.yaml", with(kWall, "{file: plot.obj,", "{file: none.obj, optional: true,"));
  RunOptions options;
  options.folder = scratch_.path("out");
  EXPECT_THROW(runScene(scene("scene.yaml", kOnIt), options), MeshMissing);
}

}  // namespace
}  // namespace espalier::scenes
