// States that are whole, and hold what nobody has grown.
#include "scenes/job/saved_growth.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "render/image/image_io.h"
#include "rules/growth/front_memory.h"
#include "scenes/job/run.h"
#include "scenes/prepare/plantings.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "tests/support/messages.h"
#include "tests/support/scratch.h"
#include "tests/support/volumes.h"

namespace espalier::scenes {
namespace {

constexpr const char* kPlot = R"(espalier: scene
world: {voxel: 10 cm, bounds: {min: [0, 0, 0], max: [2, 2, 2]}}
sky: {directions: 16}
plants:
  - {seeds: [[1, 0.3, 1], [0.4, 0.3, 0.4]], rules: {random_tree: {trials: {min: 2, max: 9}}}}
iterations: 8
)";

class KeptMemory : public testing::Test {
 protected:
  void SetUp() override {
    auto read = readScene(scratch_.write("scene.yaml", kPlot));
    ASSERT_TRUE(read);
    scene_ = *read;
    options_.folder = scratch_.path("out");
    options_.pictures = false;
  }

  /// What a run says that goes on from a state in which something of what buds remember is another.
  std::string goesOn(const std::function<void(sim::Columns&)>& change) {
    Scene half = scene_;
    half.iterations = 4;
    runScene(half, options_);
    Site site = makeSite(half);
    const sim::BitVolume bare = site.world.occupied();
    sim::Growth growth = takeUp(*readKept(options_.folder), options_.folder, half, site,
                                makePlantings(half, site), Same::everything);
    change(growth.stands.at(0).memory);
    scratch_.write("out/growth.state", sim::stateBytes(inputsOf(half, site), site.world, bare, growth));
    try {
      runScene(scene_, options_, {.resume = true});
    } catch (const sim::InputError& error) {
      return error.what();
    }
    return "";
  }

  tests::Scratch scratch_;
  Scene scene_;
  RunOptions options_;
};

TEST_F(KeptMemory, ThatIsNoneIsADamagedState) {
  using Numbers = std::vector<std::int32_t>;
  const auto buds = [](sim::Columns& memory, const char* name) -> Numbers& {
    return sim::column<std::int32_t>(memory, name);
  };
  EXPECT_EQ(goesOn([](sim::Columns&) {}), "");
  const std::string file = (options_.folder / kStateFile).string();
  const auto damaged = [&](const std::function<void(sim::Columns&)>& change) {
    const std::string said = goesOn(change);
    EXPECT_TRUE(said.starts_with(file + ": the state is damaged: ")) << said;
  };
  damaged([&](sim::Columns& m) { buds(m, "bud_node").back() = 9999; });
  damaged([&](sim::Columns& m) { buds(m, "bud_plant").back() = -1; });
  damaged([&](sim::Columns& m) { buds(m, "bud_due").pop_back(); });
  damaged([&](sim::Columns& m) { buds(m, "bud_number").back() = std::numeric_limits<std::int32_t>::max(); });
  damaged([&](sim::Columns& m) { m["bud_plant"] = std::vector<double>(3); });
  damaged([&](sim::Columns& m) {
    for (const char* name : {"bud_plant", "bud_node", "bud_number", "bud_due"})
      buds(m, name).push_back(buds(m, name).back());
  });
  damaged([&](sim::Columns& m) {  // of which nothing would show before it is due
    buds(m, "bud_node").back() = 9999;
    buds(m, "bud_due").back() = 7;
  });
}

/// What a run says that goes on from half of another.
std::string goesOnWith(const tests::Scratch& scratch, const std::string& first, const std::string& second) {
  const std::string half =
      std::string(kPlot).replace(std::string(kPlot).find("iterations: 8"), 13, "iterations: 4");
  RunOptions options;
  options.folder = scratch.path("out");
  options.pictures = false;
  const auto read = [&](const std::string& text) {
    auto scene = readScene(scratch.write("scene.yaml", text));
    EXPECT_TRUE(scene) << format(scene.problems());
    return *scene;
  };
  runScene(read(half + first), options);
  scratch.write("points.csv", "1,1.5,1\n0.5,1,1\n");
  try {
    runScene(read(kPlot + second), options, {.resume = true});
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(KeptAttractors, AreThoseThatItGoesOnWith) {
  const tests::Scratch scratch;
  const std::string dome = "attractors: {crown: {dome: 60 cm, at: [1, 1, 1], count: 30}}\n";
  const std::string more = "attractors: {crown: {dome: 60 cm, at: [1, 1, 1], count: 31}}\n";
  const std::string table = "attractors: {crown: {points: points.csv}}\n";
  EXPECT_EQ(goesOnWith(scratch, dome, dome), "");
  EXPECT_NE(goesOnWith(scratch, dome, more).find("attractors.crown.count is '31', was '30'"),
            std::string::npos);
  EXPECT_NE(goesOnWith(scratch, "", dome).find("grown from something else"), std::string::npos);
  EXPECT_EQ(goesOnWith(scratch, "", ""), "");
  scratch.write("points.csv", "1,1.5,1\n0.5,1,1\n");
  EXPECT_EQ(goesOnWith(scratch, table, table), "");
  scratch.write("points.csv", "1,1.5,1\n");
  EXPECT_NE(goesOnWith(scratch, table, table).find("attractors.crown.contents are others"),
            std::string::npos);
}

/// A plant with leaves of that picture, which is a file beside the scene, and how its stem is painted.
std::string paintedPlot(const std::string& stem) {
  std::string text = kPlot;
  text.insert(text.find("random_tree"),
              "stem: {texture: " + stem +
                  "}, elements: [{texture: leaf.png, size: 0.4, phyllotaxis: {spacing: 0.9}}], ");
  return text;
}

std::string pngOf(float alpha) {
  render::Image image(4, 4, 4, 1.0f);
  image.pixels[3] = alpha;
  return render::encodePng(image);
}

TEST(KeptPictures, AreThoseThatItGoesOnWith) {
  const tests::Scratch scratch;
  RunOptions options;
  options.folder = scratch.path("out");
  options.pictures = false;
  const auto goOn = [&](const std::string& stem, float alpha) {
    const auto read = [&](std::string text, const char* iterations) {
      text.replace(text.find("iterations: 8"), 13, iterations);
      auto scene = readScene(scratch.write("scene.yaml", text));
      EXPECT_TRUE(scene) << format(scene.problems());
      return *scene;
    };
    scratch.write("leaf.png", pngOf(1.0f));
    runScene(read(paintedPlot("bark"), "iterations: 4"), options);
    scratch.write("leaf.png", pngOf(alpha));
    return tests::messageOf(
        [&] { runScene(read(paintedPlot(stem), "iterations: 8"), options, {.resume = true}); });
  };
  EXPECT_EQ(goOn("bark", 1.0f), "no error");
  EXPECT_EQ(goOn("./leaf.png", 1.0f), "no error") << "what is painted on stems is for models alone";
  EXPECT_NE(goOn("bark", 0.0f).find("pictures.leaf.png.contents are others"), std::string::npos)
      << goOn("bark", 0.0f);
}

/// What a state does not hold, such as bark and glow, is as the rules have it.
TEST(KeptLooks, OfPlantsThatWentOnAreThoseOfOneRun) {
  const tests::Scratch scratch;
  scratch.write("leaf.png", pngOf(1.0f));
  const auto run = [&](const char* folder, const char* iterations, bool resume, double opacity) {
    std::string text =
        paintedPlot(fmt::format("bark, opacity: {}, emits: {{colour: \"#80ff80\", strength: 3}}", opacity));
    text.replace(text.find("size: 0.4"), 9, "size: 0.4, emits: \"#ff8080\"");
    text.replace(text.find("iterations: 8"), 13, iterations);
    auto scene = readScene(scratch.write("scene.yaml", text));
    ASSERT_TRUE(scene) << format(scene.problems());
    RunOptions options;
    options.folder = scratch.path(folder);
    options.pictures = false;
    runScene(*scene, options, {.resume = resume});
  };
  run("at_once", "iterations: 8", false, 0.5);
  run("in_two", "iterations: 4", false, 0.9);
  run("in_two", "iterations: 8", true, 0.5);
  const std::string model = tests::fileText(scratch.path("at_once/plant.glb"));
  EXPECT_NE(model.find("KHR_materials_emissive_strength"), std::string::npos);
  EXPECT_NE(model.find("BLEND"), std::string::npos);
  EXPECT_TRUE(model == tests::fileText(scratch.path("in_two/plant.glb")));
}

TEST(KeptFront, ThatIsNoneIsADamagedStateToRunsAndPictures) {
  const tests::Scratch scratch;
  const std::string text =
      "espalier: scene\nworld: {voxel: 10 cm, bounds: {min: [0, 0, 0], max: [2, 2, 2]}}\n"
      "plants: [{seeds: [[1, 0.1, 1]], rules: {propagate: colonization, "
      "colonization: {crown: {sphere: 70 cm, trunk: 40 cm, count: 40}}}}]\n"
      "cameras: {main: {eye: [4, 1, 4], target: [1, 1, 1]}}\nimages: [points]\n"
      "image: {width: 32, height: 32}\niterations: ";
  const auto read = [&](const std::string& iterations) {
    auto scene = readScene(scratch.write("scene.yaml", text + iterations + "\n"));
    EXPECT_TRUE(scene) << format(scene.problems());
    return *scene;
  };
  RunOptions options;
  options.folder = scratch.path("out");
  const Scene half = read("3");
  const std::string crown = rules::attractorsNamed("crown of plant_1");
  const auto said = [&](const std::function<void(sim::Commons&)>& change, bool pictures) {
    runScene(half, options, {.keep = true});
    Site site = makeSite(half);
    const sim::BitVolume bare = site.world.occupied();
    sim::Growth growth = takeUp(*readKept(options.folder), options.folder, half, site,
                                makePlantings(half, site), Same::everything);
    change(growth.commons);
    scratch.write("out/growth.state", sim::stateBytes(inputsOf(half, site), site.world, bare, growth));
    try {
      if (pictures) {
        renderScene(half, options.folder, options);
      } else {
        runScene(read("6"), options, {.resume = true});
      }
    } catch (const sim::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const bool pictures : {false, true}) {
    EXPECT_EQ(said([](sim::Commons&) {}, pictures), "");
    for (const char* name : {"front_number", "front_fate", "front_nearest", "node_tried"}) {
      const std::string told = said(
          [&](sim::Commons& commons) { sim::column<std::int32_t>(commons.at(crown), name)[0] = 999'999; },
          pictures);
      EXPECT_NE(told.find("growth.state: the state is damaged: "), std::string::npos) << name << ": " << told;
    }
  }
  const std::string lacking = said([&](sim::Commons& commons) { commons.erase(crown); }, false);
  EXPECT_NE(lacking.find("growth.state: the state is damaged: "), std::string::npos) << lacking;
}

TEST(KeptFront, OfPlantsThatGrowToOneAttractorInTwoWaysGoesOn) {
  const tests::Scratch scratch;
  const auto read = [&](int iterations) {
    auto scene = readScene(scratch.write(
        "scene.yaml",
        "espalier: scene\nworld: {voxel: 10 cm, bounds: {min: [0, 0, 0], max: [2, 2, 2]}}\n"
        "attractors: {one: {sphere: 10 cm, at: [1, 1.5, 1], count: 1}}\nplants:\n"
        "  - {seeds: [[0.7, 0.3, 1]], rules: {propagate: colonization, colonization: {attractors: one, "
        "acts: on_nearest_node, step: 15 cm, influence: 2 m, kill: 5 cm}}}\n"
        "  - {seeds: [[1.3, 0.3, 1]], rules: {propagate: colonization, colonization: {attractors: one, "
        "acts: on_every_node, step: 15 cm, influence: 2 m, kill: 5 cm}}}\n" +
            fmt::format("iterations: {}\n", iterations)));
    EXPECT_TRUE(scene) << format(scene.problems());
    return *scene;
  };
  RunOptions at_once, in_parts;
  at_once.folder = scratch.path("at_once");
  in_parts.folder = scratch.path("in_parts");
  const Report whole = runScene(read(6), at_once, {.keep = true});
  runScene(read(3), in_parts, {.keep = true});
  const Report resumed = runScene(read(6), in_parts, {.resume = true});
  ASSERT_EQ(whole.growth->plants.size(), 2u);
  for (const auto& plant : whole.growth->plants) EXPECT_GT(plant.segments, 3);
  EXPECT_EQ(resumed.growth->plants[0].segments, whole.growth->plants[0].segments);
  EXPECT_EQ(resumed.growth->plants[1].segments, whole.growth->plants[1].segments);
}

constexpr const char* kTree =
    "attractors: {crown: {dome: 60 cm, at: [1, 1, 1], count: 300}}\n"
    "fields: {whorl: {angle: 360, strength: 2, axis: grid, file: winds.vdb, within: ball}}\n"
    "meshes: [{file: ball.obj, tiled: false}]\n";
constexpr const char* kTreeRules =
    "rules: {propagate: colonization, colonization: {attractors: crown, fields: [whorl]}}";

/// A tree in whose crown a field holds in part.
class KeptFields : public testing::Test {
 protected:
  KeptFields() {
    // A cube about the lower half of the crown.
    scratch_.write("ball.obj",
                   "v 0 0.5 0\nv 2 0.5 0\nv 2 0.5 2\nv 0 0.5 2\nv 0 1.3 0\nv 2 1.3 0\nv 2 1.3 2\nv 0 1.3 2\n"
                   "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
    writeWinds({0, 1, 0});
  }
  void writeWinds(sim::Vec3 vector) {
    tests::writeVolume(scratch_.path("winds.vdb"), {tests::vectorGrid("wind", 0.5, {0, 0, 0}, {5, 5, 5},
                                                                      [=](sim::Vec3) { return vector; })});
  }
  Report run(int iterations, const char* folder, bool resume = false) {
    std::string text = std::string(kPlot) + kTree;
    const std::string walk = "rules: {random_tree: {trials: {min: 2, max: 9}}}";
    text.replace(text.find(walk), walk.size(), kTreeRules);
    text.replace(text.find("iterations: 8"), 13, "iterations: " + std::to_string(iterations));
    const auto scene = readScene(scratch_.write("scene.yaml", text));
    if (!scene) throw sim::InputError(format(scene.problems()));
    RunOptions options;
    options.folder = scratch_.path(folder);
    options.pictures = false;
    return runScene(*scene, options, {.resume = resume});
  }

  tests::Scratch scratch_;
};

TEST_F(KeptFields, AreGoneOnWithBitForBit) {
  const std::uint64_t whole = run(30, "whole").growth->state_hash;
  run(7, "part");
  EXPECT_EQ(run(30, "part", true).growth->state_hash, whole);
  for (const char* file : {"world.vdb", "plant.glb", "growth.state"})
    EXPECT_EQ(tests::fileText(scratch_.path(std::string("part/") + file)),
              tests::fileText(scratch_.path(std::string("whole/") + file)))
        << file;
}

TEST_F(KeptFields, ThatAreNoneAreADamagedState) {
  run(7, "part");
  const auto scene = readScene(scratch_.path("scene.yaml"));
  ASSERT_TRUE(scene);
  Site site = makeSite(*scene);
  const auto plantings = makePlantings(*scene, site);
  const auto said = [&](const char* column) {
    sim::State state = *readKept(scratch_.path("part"));
    state.growth.commons.at("field whorl").erase(column);
    return tests::messageOf(
        [&] { takeUp(std::move(state), scratch_.path("part"), *scene, site, plantings, Same::everything); });
  };
  for (const char* column : {"axis", "grid", "region", "region_size"})
    EXPECT_NE(said(column).find("growth.state: the state is damaged: "), std::string::npos) << column;
}

TEST_F(KeptFields, OfAnotherVolumeAreRefused) {
  run(7, "part");
  writeWinds({1, 0, 0});
  EXPECT_NE(tests::messageOf([&] { run(30, "part", true); }).find("fields.whorl.contents are others"),
            std::string::npos);
}

TEST_F(KeptFields, VolumesAreNotWrittenOver) {
  const auto file = scratch_.path("winds.vdb"), own = scratch_.path("world.vdb");
  std::filesystem::rename(file, own);
  const std::string before = tests::fileText(own);
  std::filesystem::create_symlink("world.vdb", file);
  EXPECT_NE(tests::messageOf([&] { run(3, ""); }).find("this run reads the file and would write over it"),
            std::string::npos);
  EXPECT_EQ(tests::fileText(own), before);
}

}  // namespace
}  // namespace espalier::scenes
