// Skeletons that go out of the program, and those that come in.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/cli/plot.h"

namespace espalier {
namespace {

using nlohmann::json;

constexpr const char* kDressed = R"(espalier: scene
name: dressed
meshes:
  - file: plot.obj
world:
  voxel: 5 cm
  bounds: {min: [-1.1, -0.1, -1.1], max: [1.1, 1.5, 1.1]}
plants:
  - {name: vine, skeleton: out/skeleton.json, rules: vine.yaml}
iterations: 9
)";

/// A node, and what its segment is like.
using Row = std::array<double, 7>;

std::vector<Row> segmentsIn(const json& skeletons) {
  std::vector<Row> rows;
  for (const json& plant : skeletons["plants"]) {
    for (std::size_t n = 0; n < plant["parent"].size(); ++n) {
      const auto parent = plant["parent"][n].get<int>();
      if (parent < 0) continue;
      const auto from = plant["position_m"][static_cast<std::size_t>(parent)].get<std::array<double, 3>>(),
                 to = plant["position_m"][n].get<std::array<double, 3>>();
      rows.push_back({from[0], from[1], from[2], to[0], to[1], to[2], plant["radius_m"][n].get<double>()});
    }
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

class Skeleton : public tests::Plot {
 protected:
  tests::Ran growScene(const std::string& text, const std::string& folder,
                       const std::string& more = "--no-pictures") {
    scratch_.write("dressed.yaml", text);
    return tests::espalier("grow " + scratch_.path("dressed.yaml").string() + " -o " +
                           scratch_.path(folder).string() + " " + more);
  }
  json skeleton(const std::string& folder) {
    return json::parse(tests::fileText(scratch_.path(folder) / "skeleton.json"));
  }
  std::string dressedIn(const std::string& from, const std::string& to) {
    std::string text = kDressed;
    const auto at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return text.replace(at, from.size(), to);
  }
  void expectRefused(const std::string& text, const std::string& because) {
    const auto ran = growScene(text, "refused");
    EXPECT_EQ(ran.status, 2);
    EXPECT_NE(ran.output.find(because), std::string::npos) << ran.output;
    EXPECT_FALSE(std::filesystem::exists(scratch_.path("refused") / "plant.glb"));
  }
};

TEST_F(Skeleton, ComesBackAsItWentOut) {
  ASSERT_EQ(grow("--no-pictures").status, 0);
  const auto ran = growScene(kDressed, "again");
  ASSERT_EQ(ran.status, 0) << ran.output;
  const json out = skeleton("out"), again = skeleton("again");
  EXPECT_EQ(out["plants"].size(), 2u);
  EXPECT_EQ(again["plants"].size(), 2u);
  const auto was = segmentsIn(out), is = segmentsIn(again);
  ASSERT_GT(was.size(), 30u);
  ASSERT_EQ(is.size(), was.size());
  for (std::size_t i = 0; i < was.size(); ++i) {
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(is[i][k], was[i][k], 1e-12);
    EXPECT_NEAR(is[i][6], was[i][6], 1e-6 * was[i][6]);
  }
  // The same stems, but for the roundings of their numbers; other iterations, so other youths.
  const json grew = report("out"), dressed = report("again");
  EXPECT_EQ(grew["growth"]["plants"][0]["segments"], dressed["growth"]["plants"][0]["segments"]);
  EXPECT_GT(dressed["growth"]["plants"][0]["elements"], 20);
  bool named = false;
  for (const json& input : dressed["inputs"])
    named = named || (input["kind"] == "skeleton" && input["file"] == "out/skeleton.json");
  EXPECT_TRUE(named) << dressed["inputs"];
  // And once more: what has come in goes out with its numbers.
  ASSERT_EQ(growScene(dressedIn("out/skeleton.json", "again/skeleton.json"), "third").status, 0);
  const json third = skeleton("third");
  for (std::size_t i = 0; i < 2; ++i) {
    for (const char* const column : {"name", "parent", "born"})
      EXPECT_EQ(third["plants"][i][column], again["plants"][i][column]) << column;
  }
}

TEST_F(Skeleton, IsTheSameBytesOnAnyNumberOfThreads) {
  scratch_.write("out/skeleton.json",
                 R"([{"position": [0, 0.1, 0.3]}, {"parent": 0, "position": [0, 0.8, 0.3]},
                     {"parent": 1, "position": [0.4, 1.1, 0.5]}, {"parent": 1, "position": [-0.4, 1.1, 0.5]}])");
  ASSERT_EQ(growScene(kDressed, "one", "--no-pictures --threads 1").status, 0);
  ASSERT_EQ(growScene(kDressed, "five", "--no-pictures --threads 5").status, 0);
  for (const char* const file : {"skeleton.json", "plant.glb", "world.vdb", "growth.state"})
    EXPECT_TRUE(tests::fileText(scratch_.path("one") / file) == tests::fileText(scratch_.path("five") / file))
        << file;
}

TEST_F(Skeleton, IsGoneOnWithToTheSameBytes) {
  scratch_.write("out/skeleton.json",
                 R"([{"position": [0, 0.1, 0.3]}, {"parent": 0, "position": [0, 0.8, 0.3]},
                     {"parent": 1, "position": [0.4, 1.1, 0.5]}, {"parent": 1, "position": [-0.4, 1.1, 0.5]}])");
  ASSERT_EQ(growScene(kDressed, "whole").status, 0);
  ASSERT_EQ(growScene(kDressed, "kept", "--no-pictures --iterations 6").status, 0);
  EXPECT_EQ(report("kept")["growth"]["plants"][0]["segments"], 1);  // the trunk is the longest
  ASSERT_EQ(growScene(kDressed, "kept", "--resume --no-pictures").status, 0);
  for (const char* const file : {"skeleton.json", "plant.glb", "world.vdb", "growth.state"})
    EXPECT_TRUE(tests::fileText(scratch_.path("whole") / file) ==
                tests::fileText(scratch_.path("kept") / file))
        << file;
  ASSERT_EQ(growScene(kDressed, "kept", "--resume --no-pictures --iterations 12").status, 0);
  EXPECT_EQ(report("kept")["growth"]["plants"][0]["segments"], 3);
  // In other iterations of the scene's it grows at another speed.
  const auto slower =
      growScene(dressedIn("iterations: 9", "iterations: 14"), "kept", "--resume --no-pictures");
  EXPECT_EQ(slower.status, 2);
  EXPECT_NE(slower.output.find("skeletons.iterations is '14', was '9'"), std::string::npos) << slower.output;
  scratch_.write("out/skeleton.json",
                 R"([{"position": [0, 0.1, 0.3]}, {"parent": 0, "position": [0, 0.9, 0.3]}])");
  const auto other = growScene(kDressed, "kept", "--resume --no-pictures");
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.output.find("plants[0].skeleton.contents are others"), std::string::npos) << other.output;
}

TEST_F(Skeleton, ThatPassesThroughWallsStandsAndIsToldOf) {
  scratch_.write("through.obj", "v 0 0.4 0.5\nv 0 0.5 -0.5\nv 0 0.9 -0.5\nv 0 0.9 0.5\nl 1 2 3 4\n");
  const auto ran = growScene(dressedIn("out/skeleton.json", "through.obj"), "through");
  ASSERT_EQ(ran.status, 0) << ran.output;
  const std::string told =
      "2 of 3 segments of the skeleton of 'vine' pass through the scene's objects, and stand there all the "
      "same";
  EXPECT_NE(ran.output.find("note: " + told), std::string::npos) << ran.output;
  const json r = report("through");
  EXPECT_EQ(r["growth"]["plants"][0]["segments"], 3);
  EXPECT_EQ(r["warnings"].size(), 1u);
  EXPECT_TRUE(r["warnings"][0].get<std::string>().starts_with(told));
}

TEST_F(Skeleton, ThatCannotBeIsRefusedByGrowAndByCheck) {
  scratch_.write("high.obj", "v 0 0.4 0.5\nv 0 4 0.5\nl 1 2\n");
  const std::string high = dressedIn("out/skeleton.json", "high.obj");
  expectRefused(
      high,
      "high.obj: node 2 stands at [0, 4, 0.5] m, outside of the world, which reaches from [-1.1, -0.1, "
      "-1.1] to [1.1, 1.5, 1.1]");
  const auto checked = tests::espalier("check " + scratch_.path("dressed.yaml").string());
  EXPECT_EQ(checked.status, 2);
  EXPECT_NE(checked.output.find("node 2 stands at"), std::string::npos) << checked.output;
  expectRefused(kDressed, "dressed.yaml:9:28: there is no skeleton ");
  expectRefused(dressedIn("out/skeleton.json", "plot.yaml"), "'plot.yaml' is no skeleton that is known");
  expectRefused(dressedIn("out/skeleton.json", "plot.obj"), "there are no lines in the file, only faces");
  expectRefused(dressedIn("skeleton: out/skeleton.json", "skeleton: high.obj, seeds: [[0, 0.5, 0.5]]"),
                "seeds means nothing to a plant with a skeleton");
  expectRefused(dressedIn("skeleton: out/skeleton.json, ", ""), "points: FILE or skeleton: FILE");
}

TEST_F(Skeleton, HasNoUseForAttractorsOfItsRules) {
  scratch_.write("out/skeleton.json",
                 R"([{"position": [0, 0.1, 0.3]}, {"parent": 0, "position": [0, 0.8, 0.3]}])");
  const auto ran = growScene(
      dressedIn("rules: vine.yaml", "rules: {propagate: colonization, colonization: {attractors: none}}"),
      "front");
  EXPECT_EQ(ran.status, 0) << ran.output;
}

}  // namespace
}  // namespace espalier
