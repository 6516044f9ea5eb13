#include "scenes/prepare/attractors.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scenes/prepare/plantings.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "tests/support/meshes.h"
#include "tests/support/messages.h"
#include "tests/support/png_bytes.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

class Attractors : public testing::Test {
 protected:
  /// Of a world from -4 to 4 and 0 to 8 high, in voxels of 10 cm, in whose middle a cube of 2 m stands.
  std::vector<NamedPoints> made(const std::string& attractors, const std::string& meshes = kStands) {
    scratch_.write("cube.obj", tests::kCubeObj);
    scratch_.write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nf 1 2 3\n");
    const auto path = scratch_.write(
        "scene.yaml", "espalier: scene\nworld: {voxel: 10 cm, bounds: {min: [-4, 0, -4], max: [4, 8, 4]}}\n" +
                          meshes + "attractors:\n  main: " + attractors + "\n");
    auto read = readScene(path);
    if (!read) throw sim::InputError(format(read.problems()));
    scene_ = *read;
    site_.emplace(makeSite(scene_));
    warnings_.clear();
    return attractorsOf(scene_, *site_, &warnings_);
  }
  std::string refusal(const std::string& attractors, const std::string& meshes = kStands) {
    return tests::messageOf([&] { made(attractors, meshes); }).substr(scratch_.path("").string().size());
  }
  sim::Vec3 metres(sim::Vec3 at_vx) const { return sim::worldFromVoxel(site_->world.frame(), at_vx); }

  static constexpr const char* kStands = "meshes: [{file: cube.obj, solid: true}]\n";
  static constexpr const char* kShape = "meshes: [{file: cube.obj, tiled: false, translate: [0, 3, 0]}]\n";

  tests::Scratch scratch_;
  Scene scene_;
  std::optional<Site> site_;
  std::vector<Problem> warnings_;
};

TEST_F(Attractors, OfASolidKeepOutOfWhatStandsThere) {
  const auto all = made("{cylinder: {height: 4, radius: 1.5}, at: [0, 1, 0], count: 4000}");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].name, "main");
  // The cube fills a part of its lowest metre.
  const double share = 1.0 - (4.0 / (2.25 * 3.14159)) / 4.0;
  EXPECT_NEAR(static_cast<double>(all[0].at_vx.size()), 4000 * share, 150);
  for (const sim::Vec3& p : all[0].at_vx) EXPECT_FALSE(site_->world.occupied().at(sim::voxelAt(p)));
  EXPECT_EQ(all[0].normal, std::vector<sim::Vec3>(all[0].at_vx.size(), sim::Vec3(0)));
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(Attractors, BeyondTheWorldAreCounted) {
  const auto all = made("{box: [8, 2, 8], at: [4, 4, 0], count: 1000}");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(warnings_[0].line, 5);
  EXPECT_EQ(warnings_[0].column, 3);
  EXPECT_EQ(warnings_[0].text, "attractors 'main': of 1000 points " +
                                   std::to_string(1000 - all[0].at_vx.size()) +
                                   " lie beyond the world and 0 in what stands there");
  EXPECT_NEAR(static_cast<double>(all[0].at_vx.size()), 500, 65);
  EXPECT_EQ(refusal("{dome: 6, at: [100, 0, 0], count: 9}"),
            "scene.yaml:5:3: attractors 'main': of 9 points 9 lie beyond the world and 0 in what stands "
            "there: none "
            "is left; expected a place in the open, inside the world");
  EXPECT_EQ(refusal("{sphere: 0.5, at: [0, 0.5, 0], count: 9}"),
            "scene.yaml:5:3: attractors 'main': of 9 points 0 lie beyond the world and 9 in what stands "
            "there: none "
            "is left; expected a place in the open, inside the world");
}

TEST_F(Attractors, OnAMeshThatStandsThereStepOutOfIt) {
  const auto all = made("{surface: cube, count: 600}");
  EXPECT_GT(all[0].at_vx.size(), 480u);  // all but those beneath
  for (std::size_t i = 0; i < all[0].at_vx.size(); ++i) {
    const sim::Vec3 p = metres(all[0].at_vx[i]), n = all[0].normal[i];
    EXPECT_EQ(glm::length(n), 1.0);
    EXPECT_FALSE(site_->world.occupied().at(sim::voxelAt(all[0].at_vx[i])));
    const double out = std::max({std::abs(p.x), std::abs(p.y - 1), std::abs(p.z)}) - 1;
    EXPECT_GT(out, 0.0);
    EXPECT_LT(out, 0.2001);
  }
}

TEST_F(Attractors, OnAShapeThatStandsNowhereLieOnIt) {
  const auto all = made("{surface: cube, spacing: 30 cm}", kShape);
  EXPECT_EQ(site_->world.occupied().count(), 0u);
  EXPECT_GT(all[0].at_vx.size(), 100u);
  for (std::size_t i = 0; i < all[0].at_vx.size(); ++i) {
    const sim::Vec3 p = metres(all[0].at_vx[i]) - sim::Vec3(0, 4, 0);
    EXPECT_NEAR(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 1.0, 1e-9);
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_GE(glm::distance(all[0].at_vx[i], all[0].at_vx[k]), 3.0 - 1e-9);
  }
  EXPECT_TRUE(warnings_.empty());
  made("{surface: cube, spacing: 90 cm, count: 100}", kShape);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].text.find(" of 100 points find room on 'cube' with 0.9 m between any two"),
            std::string::npos)
      << warnings_[0].text;
}

TEST_F(Attractors, InAShape) {
  const auto all = made("{inside: cube, count: 500}", kShape);
  for (const sim::Vec3& at : all[0].at_vx) {
    const sim::Vec3 p = metres(at) - sim::Vec3(0, 4, 0);
    EXPECT_LT(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 1.01);
  }
  EXPECT_TRUE(warnings_.empty());
  EXPECT_EQ(refusal("{inside: sheet}", "meshes: [{file: sheet.obj, tiled: false}]\n"),
            "scene.yaml:5:3: attractors 'main': mesh 'sheet': is a sheet, which has no inside; "
            "expected a mesh that holds something, or points on its surface");
}

TEST_F(Attractors, InAMeshThatLeaksSaySo) {
  std::string open = tests::kCubeObj;
  open = open.substr(0, open.find("f 5")) + open.substr(open.find("f 1 5"));  // without its lid
  scratch_.write("open.obj", open);
  made("{inside: open, count: 50}", "meshes: [{file: open.obj, tiled: false}]\n");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].text.find("the mesh 'open' leaks: for 1e+02 %"), std::string::npos)
      << warnings_[0].text;
}

TEST_F(Attractors, InABallOfWhichOneTriangleIsMissingSaySoAndInAWholeOneDoNot) {
  const std::string ball = tests::fileText(tests::sourceFolder() / "scenes/meshes/sphere.obj");
  const auto face = ball.find("\nf ");
  scratch_.write("ball.obj", ball);
  scratch_.write("open.obj", ball.substr(0, face) + ball.substr(ball.find('\n', face + 1)));
  for (const char* at : {"[-1.2, 2.1, 0]", "[0, 2.1, 0]", "[0.333, 2, 0.2]"}) {
    const std::string rest = std::string(", tiled: false, scale: 2.8, translate: ") + at + "}]\n";
    made("{inside: ball, count: 50}", "meshes: [{file: ball.obj" + rest);
    EXPECT_TRUE(warnings_.empty()) << at << ": " << warnings_[0].text;
    made("{inside: open, count: 50}", "meshes: [{file: open.obj" + rest);
    EXPECT_EQ(warnings_.size(), 1u) << at;
  }
}

/// A strip of four pixels, of which the third is black and the fourth half as bright as the others.
constexpr const char* kStrip =
    "file: strip.png, top_left: [-2, 3, -1], top_right: [2, 3, -1], bottom_left: [-2, 3, 1]";

TEST_F(Attractors, InAPictureAreDenseWhereItIsBright) {
  scratch_.write("strip.png", tests::pngBytes(4, 1, 8, 0, {200, 200, 0, 100}));
  const std::string picture = std::string("{picture: {") + kStrip + "}, ";
  const auto all = made(picture + "count: 5000}");
  std::array<double, 4> counts{};
  for (std::size_t i = 0; i < all[0].at_vx.size(); ++i) {
    const sim::Vec3 p = metres(all[0].at_vx[i]);
    EXPECT_NEAR(p.y, 3.0, 1e-9);
    EXPECT_LE(std::abs(p.z), 1.0);
    EXPECT_EQ(all[0].normal[i], sim::Vec3(0, 1, 0));
    ++counts.at(static_cast<std::size_t>(p.x + 2.0));
  }
  EXPECT_NEAR(counts[0], 2000, 140);
  EXPECT_NEAR(counts[1], 2000, 140);
  EXPECT_EQ(counts[2], 0);
  EXPECT_NEAR(counts[3], 1000, 110);
  EXPECT_TRUE(warnings_.empty());
  const auto apart = made(picture + "spacing: 20 cm, waves: 2}");
  EXPECT_EQ(apart[0].wave.size(), apart[0].at_vx.size());
  EXPECT_GT(apart[0].at_vx.size(), 60u);
  made(picture + "spacing: 1 m, count: 100}");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].text.find(" of 100 points find room in the picture with 1 m between any two"),
            std::string::npos)
      << warnings_[0].text;
  EXPECT_EQ(site_->mesh_files.back().kind, "density");
}

TEST_F(Attractors, InAPictureThatIsNoneSayWhere) {
  const auto place = scratch_.path("scene.yaml").string() + ":5:26: " + scratch_.path("strip.png").string();
  for (const std::string& bytes : {std::string("GIF89a"), tests::pngBytes(60'000, 60'000, 8, 0, {0}),
                                   tests::pngBytes(4, 1, 8, 0, {0, 0, 0, 0})}) {
    scratch_.write("strip.png", bytes);
    const std::string said = tests::messageOf([&] { made(std::string("{picture: {") + kStrip + "}}"); });
    EXPECT_TRUE(said.starts_with(place)) << said;
  }
}

TEST_F(Attractors, FromATable) {
  scratch_.write("p.csv", "\"x\", y, z\n\n# one\n0.5,4,0\n-1.5 , 2e0 ,3, more\r\n9,4,0\n");
  const auto all = made("{points: p.csv}");
  ASSERT_EQ(all[0].at_vx.size(), 2u);
  EXPECT_LT(glm::distance(metres(all[0].at_vx[0]), sim::Vec3(0.5, 4, 0)), 1e-12);
  EXPECT_LT(glm::distance(metres(all[0].at_vx[1]), sim::Vec3(-1.5, 2, 3)), 1e-12);
  EXPECT_EQ(warnings_.at(0).text,
            "attractors 'main': of 3 points 1 lies beyond the world and 0 in what stands there");
  EXPECT_EQ(site_->mesh_files.back().name, "p.csv");
  EXPECT_EQ(site_->mesh_files.back().kind, "points");
  const std::string expected = "; expected x, y, z in metres, each from -1000000 to 1000000",
                    table = "scene.yaml:5:18: " + scratch_.path("p.csv").string();
  for (const std::string bad : {"1,2", "1,2,nan", "1;2;3", "1,2,3e7", "1,2,x", "x,y,z"}) {
    scratch_.write("p.csv", "0,1,0\n" + bad + "\n");
    EXPECT_EQ(refusal("{points: p.csv}"), table + ":2: '" + bad + "' is no point" + expected);
  }
  scratch_.write("p.csv", "x,y,z\n");
  EXPECT_EQ(refusal("{points: p.csv}"), table + ": has no points; expected x, y, z on each line");
}

TEST_F(Attractors, OfOneTypeInATable) {
  scratch_.write("p.csv", "x,y,z,type\n0,1,3,0\n0.5,4,0,1\n-0.5,4,0,2,more\n1,5,0, 1\n");
  EXPECT_EQ(made("{points: p.csv, type: 1}")[0].at_vx.size(), 2u);
  const auto second = made("{points: p.csv, type: 2}");
  ASSERT_EQ(second[0].at_vx.size(), 1u);
  EXPECT_LT(glm::distance(metres(second[0].at_vx[0]), sim::Vec3(-0.5, 4, 0)), 1e-12);
  EXPECT_EQ(made("{points: p.csv}")[0].at_vx.size(), 4u);
  const std::string table = "scene.yaml:5:18: " + scratch_.path("p.csv").string();
  EXPECT_EQ(refusal("{points: p.csv, type: 3}"),
            table + ": has no points of type 3; expected x, y, z on each line");
  scratch_.write("p.csv", "0,1,0,1\n0,1,0\n");
  EXPECT_EQ(
      refusal("{points: p.csv, type: 1}"),
      table +
          ":2: '0,1,0' is no point with a type; expected x, y, z in metres, each from -1000000 to 1000000, "
          "and a whole number");
  // Those of another type may be where plants start.
  scratch_.write("p.csv", "0,1,3,0\n0.5,1,3.1,0\n0,4,3,1\n");
  made(
      "{points: p.csv, type: 1}\nplants:\n  - {rules: {propagate: colonization, colonization: {attractors: "
      "main}}, "
      "points: p.csv, type: 0}");
  const auto plantings = makePlantings(scene_, *site_);
  ASSERT_EQ(plantings.at(0).seeds.size(), 2u);
  EXPECT_LT(glm::distance(metres(plantings[0].seeds[1].at_vx), sim::Vec3(0.5, 1, 3.1)), 1e-12);
  EXPECT_EQ(site_->mesh_files.size(), 2u);  // the mesh, and the table once
}

TEST_F(Attractors, FollowFromTheSeedAndTheirName) {
  const std::string dome = "{dome: 2, at: [0, 3, 0], count: 50}";
  const auto first = made(dome)[0].at_vx;
  EXPECT_EQ(made(dome)[0].at_vx, first);
  EXPECT_NE(made(dome + "\nseed: 2")[0].at_vx, first);
  const auto both = made(dome + "\n  other: " + dome);
  EXPECT_EQ(both[0].at_vx, first);
  EXPECT_NE(both[1].at_vx, first);
}

TEST_F(Attractors, AreColumnsOfWhatPlantingsShare) {
  const auto all = made("{dome: 2, at: [0, 3, 0], count: 50}");
  const sim::Commons commons = commonsOf(all);
  ASSERT_EQ(commons.size(), 1u);
  const sim::Columns& columns = commons.at("attractors main");
  EXPECT_EQ(sim::column<sim::Vec3>(columns, "at_vx"), all[0].at_vx);
  EXPECT_EQ(sim::column<sim::Vec3>(columns, "normal"), all[0].normal);
}

class Crowns : public testing::Test {
 protected:
  std::vector<NamedPoints> made(const std::string& seeds, const std::string& crown) {
    const auto path = scratch_.write(
        "scene.yaml",
        "espalier: scene\nworld: {voxel: 10 cm, bounds: {min: [-4, 0, -4], max: [4, 8, 4]}}\nplants:\n  - "
        "{name: "
        "tree, seeds: " +
            seeds + ", rules: {propagate: colonization, colonization: {crown: " + crown + "}}}\n");
    auto read = readScene(path);
    if (!read) throw sim::InputError(format(read.problems()));
    scene_ = *read;
    site_.emplace(makeSite(scene_));
    warnings_.clear();
    return crownsOf(scene_, *site_, makePlantings(scene_, *site_), &warnings_);
  }
  sim::Vec3 metres(sim::Vec3 at_vx) const { return sim::worldFromVoxel(site_->world.frame(), at_vx); }

  tests::Scratch scratch_;
  Scene scene_;
  std::optional<Site> site_;
  std::vector<Problem> warnings_;
};

TEST_F(Crowns, StandOverTheirSeeds) {
  const auto all = made("[[-2, 0.5, 0], [2, 1.5, 1]]", "{sphere: 1 m, trunk: 2 m, count: 300}");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].name, "crown of tree");
  ASSERT_EQ(all[0].at_vx.size(), 600u);
  for (std::size_t i = 0; i < 600; ++i) {
    const sim::Vec3 middle = i < 300 ? sim::Vec3(-2, 3.5, 0) : sim::Vec3(2, 4.5, 1);
    EXPECT_LT(glm::distance(metres(all[0].at_vx[i]), middle), 1.0 + 1e-9);
  }
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(Crowns, OfOneKeyAreTheSameWhereverTheyStand) {
  const std::string crown = "{dome: 1 m, trunk: 1 m, count: 50}";
  const auto here = made("[{at: [-2, 0.5, 0], key: oak}]", crown);
  const auto first = metres(here[0].at_vx[7]) - sim::Vec3(-2, 0.5, 0);
  const auto there = made("[{at: [1, 0.7, 1], key: oak}]", crown);
  EXPECT_LT(glm::distance(metres(there[0].at_vx[7]) - sim::Vec3(1, 0.7, 1), first), 1e-9);
  const auto other = made("[{at: [1, 0.7, 1], key: elm}]", crown);
  EXPECT_GT(glm::distance(other[0].at_vx[7], there[0].at_vx[7]), 1e-3);
}

TEST_F(Crowns, BelowGroundAreRootsToGrowTo) {
  const auto all = made("[[0, 6, 0]]", "{cylinder: {radius: 2, height: 3}, trunk: -3.5 m, count: 100}");
  for (const sim::Vec3& at : all[0].at_vx) {
    EXPECT_GE(metres(at).y, 2.5 - 1e-9);
    EXPECT_LE(metres(at).y, 5.5 + 1e-9);
  }
}

TEST_F(Crowns, SayWhatIsWrongWithPlaceAndRemedy) {
  const auto refusal = [&](const std::string& crown) {
    return tests::messageOf([&] { made("[[0, 0.5, 0]]", crown); }).substr(scratch_.path("").string().size());
  };
  EXPECT_EQ(
      refusal("{dome: 1 m, trunk: 20 m}"),
      "scene.yaml:4:40: attractors 'crown of tree': of 500 points 500 lie beyond the world and 0 in what "
      "stands there: none is left; expected a place in the open, inside the world");
  EXPECT_NE(refusal("{dome: 1 m, count: 10000001}").find("count is '10000001'"), std::string::npos);
  made("[[0, 0.5, 0]]", "{dome: 1 m, trunk: 7 m}");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].text.find("lie beyond the world"), std::string::npos);
  EXPECT_NE(tests::messageOf([&] {
              made("[[0, 1, 0], [0, 2, 0]]", "{dome: 1 m, count: 6000000}");
            }).find("12000000 points with those before it; expected at most 10000000 in a scene"),
            std::string::npos);
}

}  // namespace
}  // namespace espalier::scenes
