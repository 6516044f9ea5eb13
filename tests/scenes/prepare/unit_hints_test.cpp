#include "scenes/prepare/unit_hints.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scenes/prepare/site.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "tests/support/messages.h"
#include "tests/support/scratch.h"

/// A mesh that nobody told the unit of.
namespace espalier::scenes {
namespace {

/// A box of this size from the origin, without a top.
std::string box(const sim::Vec3& size) {
  std::string text;
  for (int corner = 0; corner < 8; ++corner) {
    text += fmt::format("v {} {} {}\n", (corner & 1) ? size.x : 0.0, (corner & 2) ? size.y : 0.0,
                        (corner & 4) ? size.z : 0.0);
  }
  return text + "f 1 2 6 5\nf 1 3 4 2\nf 5 6 8 7\nf 1 5 7 3\nf 2 4 8 6\n";
}

/// Hills without a wall.
std::string hills(double side, double high) {
  return fmt::format(
      "v 0 0 0\nv {0} 0 0\nv {0} 0 {0}\nv 0 0 {0}\nv {1} {2} {1}\nf 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\n", side,
      0.5 * side, high);
}

class UnitHints : public testing::Test {
 protected:
  /// A scene with one mesh, on its fourth line.
  Scene scene(const std::string& mesh, const std::string& world, const std::string& more = "") {
    scratch_.write("house.obj", mesh);
    auto read = readScene(scratch_.write(
        "scene.yaml",
        fmt::format(
            "espalier: scene\nsky: {{directions: 8}}\nmeshes:\n  - {{file: house.obj{}}}\nworld: {{{}}}\n",
            more, world)));
    EXPECT_TRUE(read) << format(read.problems());
    return *read;
  }
  std::string hints(const std::string& mesh, const std::string& world, const std::string& more = "") {
    return format(makeSite(scene(mesh, world, more)).warnings);
  }
  std::string refusal(const std::string& mesh, const std::string& world, const std::string& more = "") {
    const Scene read = scene(mesh, world, more);
    return tests::messageOf([&] { makeSite(read); });
  }

  tests::Scratch scratch_;
  const sim::Vec3 house_cm_{880, 610, 580};
};

TEST_F(UnitHints, AHouseInCentimetresThatDoesNotFitIsToldOfItsUnitBesideTheVoxelSize) {
  const std::string said = refusal(box(house_cm_), "voxel: 1 cm");
  EXPECT_NE(said.find("expected"), std::string::npos) << said;
  EXPECT_NE(said.find("scene.yaml:4:5: the mesh 'house' is 880 x 610 x 580 m large"), std::string::npos)
      << said;
  EXPECT_NE(said.find("'unit: cm', which makes it 8.8 x 6.1 x 5.8 m"), std::string::npos) << said;
  EXPECT_EQ(refusal(box(house_cm_), "voxel: 1 cm", ", unit: m").find("unit: cm"), std::string::npos);
  EXPECT_EQ(refusal(box(house_cm_), "voxel: 10 cm", ", unit: cm"), "no error");
}

TEST_F(UnitHints, InMillimetresTheLikelierUnitComesFirst) {
  const std::string said = refusal(box(10.0 * house_cm_), "voxel: 10 cm");
  const auto mm = said.find("'unit: mm', which makes it 8.8 x"),
             cm = said.find("'unit: cm', which makes it 88 x");
  EXPECT_NE(cm, std::string::npos) << said;
  EXPECT_LT(mm, cm) << said;
}

TEST_F(UnitHints, WhereItFitsWhatIsAsHighAsNoHouseIsToldOf) {
  EXPECT_NE(hints(box(house_cm_), "resolution: 40").find("'unit: cm', which makes it 8.8"),
            std::string::npos);
  EXPECT_EQ(hints(box(house_cm_), "resolution: 40", ", unit: m"), "");
  EXPECT_EQ(hints(box(house_cm_), "resolution: 40", ", unit: cm"), "");
}

TEST_F(UnitHints, TownsAndTerrainAreAsLargeAsTheyAre) {
  EXPECT_EQ(hints(box({900, 60, 700}), "resolution: 40"), "");
  EXPECT_EQ(hints(hills(3000, 900), "resolution: 40"), "");
  EXPECT_EQ(hints(box({30, 20, 20}), "resolution: 40"), "");
  EXPECT_EQ(refusal(box({150, 60, 100}), "voxel: 2 mm").find("unit"), std::string::npos);
}

TEST_F(UnitHints, WhatIsSmallerThanAFewOfTheVoxelsAskedForIsToldOf) {
  const std::string small = hints(box({0.088, 0.061, 0.058}), "voxel: 4 cm, margin: 20 cm");
  EXPECT_NE(small.find("0.088 x 0.061 x 0.058 m large, 2.2 voxels of 0.04 m"), std::string::npos) << small;
  EXPECT_NE(small.find("a scale for its meshes"), std::string::npos) << small;
  const std::string in_mm = hints(box({8.8, 6.1, 5.8}), "voxel: 4 cm, margin: 20 cm", ", unit: mm");
  EXPECT_NE(in_mm.find("or another unit"), std::string::npos) << in_mm;
  EXPECT_EQ(hints(box({0.156, 0.154, 0.121}), "voxel: 4 mm"), "");     // a bunny
  EXPECT_EQ(hints(box({0.088, 0.061, 0.058}), "resolution: 10"), "");  // as fine as somebody asked for
  EXPECT_EQ(hints(box({0.088, 0.061, 0.058}), "voxel: 4 cm, margin: 20 cm", ", unit: m"), "");
}

}  // namespace
}  // namespace espalier::scenes
