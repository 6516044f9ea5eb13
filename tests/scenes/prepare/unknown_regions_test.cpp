#include "scenes/prepare/unknown_regions.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scenes/prepare/plantings.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

using tests::Scratch;

constexpr const char* kMesh = R"(
v 0 0 0
v 1 0 0
v 1 0 1
v 0 0 1
v 0 1 0
v 1 1 0
g paving
f 1 4 3 2
g wall
f 1 2 6 5
)";

/// A scene of two regions, and what it has to say of those that its files name.
class UnknownRegions : public testing::Test {
 protected:
  UnknownRegions() { scratch_.write("plot.obj", kMesh); }

  Scene read(const std::string& plants) {
    auto scene =
        readScene(scratch_.write("s.yaml",
                                 "espalier: scene\nmeshes: [plot.obj]\nworld: {voxel: 10 cm, margin: 50 cm}\n"
                                 "plants:\n" +
                                     plants));
    EXPECT_TRUE(scene) << format(scene.problems());
    return scene ? *scene : Scene{};
  }
  std::string warnings(const std::string& plants) {
    const Scene scene = read(plants);
    return scratch_.shown(unknownRegions(scene, makeSite(scene).world));
  }
  std::string warningsOfFile(const std::string& rules) {
    scratch_.write("r.yaml", "espalier: rules\n" + rules);
    return warnings("  - {rules: r.yaml, seeds: [[0.5, 0.3, 0.5]]}\n");
  }

  Scratch scratch_;
};

TEST_F(UnknownRegions, AreNamedWithTheirPlaceTheRegionsThatThereAreAndTheNearest) {
  EXPECT_EQ(
      warningsOfFile("regions:\n  pavingg: forbid\n"),
      "r.yaml:3:3: no mesh of the scene has a region 'pavingg'; expected one of paving, wall; did you mean "
      "'paving'?");
}

TEST_F(UnknownRegions, AreFoundWhereverARuleSetStands) {
  EXPECT_EQ(warningsOfFile("otherwise: {regions: {pavingg: forbid}}\n").substr(0, 12), "r.yaml:2:23:");
  EXPECT_EQ(warningsOfFile("regions: {wall: {regions: {roof: forbid}}}\n").substr(0, 12), "r.yaml:2:28:");
  EXPECT_EQ(warningsOfFile("regions: {others: {regions: {roof: forbid}}}\n").substr(0, 12), "r.yaml:2:30:");
  EXPECT_EQ(warnings("  - {rules: {regions: {roof: forbid}}, seeds: [[0.5, 0.3, 0.5]]}\n").substr(0, 12),
            "s.yaml:5:24:");
  scratch_.write("deep.yaml", "espalier: rules\nregions: {roof: forbid}\n");
  EXPECT_EQ(warningsOfFile("base: deep.yaml\n").substr(0, 15), "deep.yaml:2:11:");
  EXPECT_EQ(warningsOfFile("otherwise: deep.yaml\n").substr(0, 15), "deep.yaml:2:11:");
  EXPECT_EQ(warningsOfFile("regions: {wall: deep.yaml}\n").substr(0, 15), "deep.yaml:2:11:")
      << "a region's own file";
  EXPECT_EQ(warningsOfFile("base: deep.yaml\nregions: {roof: {}}\n").substr(0, 15), "deep.yaml:2:11:")
      << "a name that a later layer repeats is still in the base";
}

TEST_F(UnknownRegions, ThatSensesAskAfterAreNamedToo) {
  EXPECT_EQ(
      warningsOfFile("senses: {gap: {measure: distance, of: wal}}\n"),
      "r.yaml:2:39: no mesh of the scene has a region 'wal'; expected one of paving, wall; did you mean "
      "'wall'?");
  EXPECT_EQ(warningsOfFile("otherwise: {senses: {gap: {of: roof}}}\n").substr(0, 12), "r.yaml:2:32:");
  EXPECT_EQ(warningsOfFile("senses: {a: {of: wall}, b: {of: others}, c: {}}\n"), "");
}

TEST_F(UnknownRegions, AreThoseOfGuidesToSenses) {
  const auto scene = readScene(
      scratch_.write("s.yaml",
                     "espalier: scene\nmeshes: [{file: plot.obj, guide: true}]\n"
                     "world: {voxel: 10 cm, margin: 50 cm}\nplants:\n  - {rules: {senses: {gap: {of: wall}}, "
                     "regions: {paving: forbid}}, seeds: [[0.5, 0.3, 0.5]]}\n"));
  ASSERT_TRUE(scene) << format(scene.problems());
  EXPECT_EQ(
      scratch_.shown(unknownRegions(*scene, makeSite(*scene).world)),
      "s.yaml:5:33: the region 'wall' is a guide's, of which nothing is sensed; expected one that fills "
      "voxels");
}

TEST_F(UnknownRegions, AreToldOnceForEachPlace) {
  scratch_.write("base.yaml", "espalier: rules\nregions: {roof: forbid}\n");
  scratch_.write("other.yaml", "espalier: rules\nbase: base.yaml\n");
  scratch_.write("r.yaml", "espalier: rules\nbase: base.yaml\notherwise: other.yaml\nregions: {roof: {}}\n");
  const auto shown = warnings(
      "  - {rules: r.yaml, seeds: [[0.5, 0.3, 0.5]]}\n  - {rules: r.yaml, name: b, seeds: [[0.6, 0.3, "
      "0.5]]}\n");
  EXPECT_EQ(std::count(shown.begin(), shown.end(), '\n'), 1) << shown;
  EXPECT_NE(shown.find("base.yaml:2:11:"), shown.npos) << shown;
  EXPECT_NE(shown.find("r.yaml:4:11:"), shown.npos) << shown;
}

TEST_F(UnknownRegions, AreNoneWhereEveryNameIsKnown) {
  EXPECT_EQ(warningsOfFile(
                "regions: {paving: forbid, wall: {}, others: forbid}\notherwise: {regions: {wall: {}}}\n"),
            "")
      << "others is no region";
}

TEST_F(UnknownRegions, OfScatteredSeedsAreErrorsWithTheirPlace) {
  const auto error = [&](const std::string& plants) -> std::string {
    try {
      const Scene scene = read(plants);
      makePlantings(scene, makeSite(scene));
    } catch (const sim::InputError& e) {
      std::string text = e.what();
      const auto folder = scratch_.path("").string();
      for (auto at = text.find(folder); at != text.npos; at = text.find(folder))
        text.erase(at, folder.size());
      return text;
    }
    return "";
  };
  EXPECT_EQ(
      error("  - rules: {}\n    scatter:\n      region: wal\n      count: 3\n"
            "  - {rules: {}, scatter: {count: 3, region: bed}}\n"),
      "s.yaml:7:15: no mesh of the scene has a region 'wal'; expected one of paving, wall; did you mean "
      "'wall'?\n"
      "s.yaml:9:45: no mesh of the scene has a region 'bed'; expected one of paving, wall");
}

TEST_F(UnknownRegions, OfAMeshOfManyAreListedCutShort) {
  std::string mesh = "v 0 0 0\nv 1 0 0\nv 1 0 1\n";
  for (int i = 0; i < 3000; ++i)
    mesh += fmt::format("g region_{}{}\nf 1 2 3\n", i, i == 0 ? std::string(300, 'x') : "");
  scratch_.write("plot.obj", mesh);
  const auto shown = warningsOfFile("regions: {roof: forbid}\n");
  EXPECT_LT(shown.size(), 600u) << shown;
  EXPECT_NE(shown.find("region_1, region_2,"), shown.npos) << shown;
}

TEST_F(UnknownRegions, OfAnEmptyWorldAreNamedToo) {
  const auto scene = readScene(
      scratch_.write("s.yaml",
                     "espalier: scene\nworld: {voxel: 10 cm, bounds: {min: [0,0,0], max: [1,1,1]}}\n"
                     "plants: [{rules: {regions: {wall: forbid}}, seeds: [[0.5, 0.3, 0.5]]}]\n"));
  ASSERT_TRUE(scene) << format(scene.problems());
  EXPECT_EQ(scratch_.shown(unknownRegions(*scene, makeSite(*scene).world)),
            "s.yaml:3:29: no mesh of the scene has a region 'wall'; expected a mesh that has it");
}

}  // namespace
}  // namespace espalier::scenes
