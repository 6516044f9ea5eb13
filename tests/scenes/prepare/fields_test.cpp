#include "scenes/prepare/fields.h"

#include <gtest/gtest.h>

#include "rules/growth/shared_guide.h"
#include "scenes/prepare/attractors.h"
#include "scenes/prepare/plantings.h"
#include "scenes/prepare/site.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "sim/grow/grow.h"
#include "tests/support/meshes.h"
#include "tests/support/messages.h"
#include "tests/support/scratch.h"
#include "tests/support/volumes.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;

class Fields : public testing::Test {
 protected:
  Fields() {
    scratch_.write("cube.obj", tests::kCubeObj);
    scratch_.write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nf 1 2 3\n");
    tests::writeVolume(scratch_.path("up.vdb"),
                       {tests::vectorGrid("up", 0.5, {-12, -2, -12}, {25, 25, 25},
                                          [](Vec3) { return Vec3(0.3, 0.8, -0.2); })});
  }

  /// A tree in a ball, in a world from -4 to 4 and 0 to 8 high, in voxels of 10 cm.
  const Site& made(const std::string& field) {
    const auto path = scratch_.write(
        "scene.yaml",
        "espalier: scene\nworld: {voxel: 10 cm, bounds: {min: [-4, 0, -4], max: [4, 8, 4]}}\n"
        "meshes: [{file: cube.obj, tiled: false, translate: [0, 3, 0]}, {file: sheet.obj, tiled: false}]\n"
        "attractors: {ball: {sphere: 3, at: [0, 1, 0], count: 1500}}\n"
        "fields: {whorl: " +
            field +
            "}\n"
            "plants: [{rules: {propagate: colonization, colonization: {attractors: ball, fields: [whorl]}}, "
            "seeds: [[0, 0.3, 0]]}]\n");
    auto read = readScene(path);
    if (!read) throw sim::InputError(format(read.problems()));
    scene_ = *read;
    site_.emplace(makeSite(scene_));
    return *site_;
  }
  sim::Growth grown(const std::string& field) {
    made(field);
    const auto plantings = makePlantings(scene_, *site_);
    return sim::grow(site_->world, plantings, growthSettings(scene_, *site_, attractorsOf(scene_, *site_)));
  }
  std::string refusal(const std::string& field) {
    std::string said = tests::messageOf([&] { made(field); });
    const std::string folder = scratch_.path("").string();
    for (auto at = said.find(folder); at != said.npos; at = said.find(folder)) said.erase(at, folder.size());
    return said;
  }
  bool holds(Vec3 at_m) const {
    const rules::Guide guide = guideOf(scene_.fields[0], site_->fields[0], site_->world.frame());
    const Vec3 at = sim::voxelFromWorld(site_->world.frame(), at_m);
    return rules::guideAt(guide, {at, {40, 1, 40}, 60.0, {}, 0}) != Vec3(0.0);
  }

  tests::Scratch scratch_;
  Scene scene_;
  std::optional<Site> site_;
};

// What is read are the vector's floats, and its shares between voxels add up to 1 but for a few bits of a
// double: the axes are one to 1e-15, and the nodes, each a step from the last, to far less than a voxel.
TEST_F(Fields, OfAGridThatIsOneVectorAreThoseOfADirection) {
  const sim::Growth by_grid = grown("{angle: 360, strength: 2, axis: grid, file: up.vdb}");
  const sim::Growth by_direction =
      grown("{angle: 360, strength: 2, direction: [0.300000012, 0.800000012, -0.200000003]}");
  const auto &a = by_grid.plants[0].skeleton, &b = by_direction.plants[0].skeleton;
  ASSERT_EQ(a.position_vx.size(), b.position_vx.size());
  EXPECT_GT(a.position_vx.size(), 500u);
  for (std::size_t n = 0; n < a.position_vx.size(); ++n)
    EXPECT_LT(glm::distance(a.position_vx[n], b.position_vx[n]), 1e-6);
  // The control: another axis, other nodes.
  EXPECT_NE(grown("{angle: 360, strength: 2}").plants[0].skeleton.position_vx, b.position_vx);
}

TEST_F(Fields, AreNothingBeyondTheirGrid) {
  tests::writeVolume(scratch_.path("small.vdb"), {tests::vectorGrid("up", 0.5, {0, 4, 0}, {3, 3, 3},
                                                                    [](Vec3) { return Vec3(0, 1, 0); })});
  made("{angle: 90, axis: grid, file: small.vdb}");
  EXPECT_TRUE(holds({0.5, 2.5, 0.5}));
  EXPECT_TRUE(holds({1.4, 2.5, 0.5}));  // half a metre beside the last of its voxels it fades out
  EXPECT_FALSE(holds({1.6, 2.5, 0.5}));
  EXPECT_FALSE(holds({0.5, 3.6, 0.5}));
}

TEST_F(Fields, NameTheirFilesAmongTheInputs) {
  const Site& site = made("{axis: grid, file: up.vdb}");
  EXPECT_EQ(site.mesh_files.back().name, "up.vdb");
  EXPECT_EQ(site.mesh_files.back().kind, "volume");
  EXPECT_EQ(site.mesh_paths.back(), scratch_.path("up.vdb"));
  EXPECT_TRUE(site.warnings.empty());
}

TEST_F(Fields, SayWhatIsWrongWithTheirFilesAndWhere) {
  EXPECT_EQ(refusal("{axis: grid, file: none.vdb}"),
            "scene.yaml:5:36: there is no volume none.vdb; expected one");
  scratch_.write("bad.vdb", std::string(5000, 'x'));
  EXPECT_TRUE(refusal("{axis: grid, file: bad.vdb}")
                  .starts_with("scene.yaml:5:36: fields 'whorl': bad.vdb: the file is damaged or cut, or no "
                               "OpenVDB file: "))
      << refusal("{axis: grid, file: bad.vdb}");
  EXPECT_EQ(
      refusal("{axis: grid, file: up.vdb, grid: down}"),
      "scene.yaml:5:36: fields 'whorl': up.vdb: there is no grid 'down' in the file; expected one of up");
}

TEST_F(Fields, HoldWithinAMesh) {
  const Site& site = made("{angle: 90, within: cube}");
  EXPECT_TRUE(site.warnings.empty());
  EXPECT_TRUE(holds({0, 4, 0}));
  const double fine = 0.5 * site.fields[0].region.voxel_m + 1e-9;
  EXPECT_LT(fine, 0.01);
  for (const double side : {-1.0, 1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 in(0, 4, 0), out = in;
      in[axis] += side * (1.0 - fine);
      out[axis] += side * (1.0 + fine);
      EXPECT_TRUE(holds(in)) << axis << side;
      EXPECT_FALSE(holds(out)) << axis << side;
    }
  }
  EXPECT_FALSE(holds({3, 7, 3}));
  made("{angle: 90, box: {min: [-2, 0, -2], max: [2, 4, 2]}, within: cube}");
  EXPECT_TRUE(holds({0, 3.9, 0}));
  EXPECT_FALSE(holds({0, 4.1, 0}));
}

TEST_F(Fields, AskForAMeshThatHasAnInside) {
  EXPECT_EQ(refusal("{within: sheet}"),
            "scene.yaml:5:26: fields 'whorl': mesh 'sheet': is a sheet, which has no inside; expected a mesh "
            "that holds something");
  std::string open = tests::kCubeObj;
  open = open.substr(0, open.find("f 5")) + open.substr(open.find("f 1 5"));  // without its lid
  scratch_.write("cube.obj", open);
  const Site& site = made("{within: cube}");
  ASSERT_EQ(site.warnings.size(), 1u);
  EXPECT_EQ(site.warnings[0].line, 5);
  EXPECT_TRUE(site.warnings[0].text.starts_with("fields 'whorl': the mesh 'cube' leaks: for "))
      << site.warnings[0].text;
}

}  // namespace
}  // namespace espalier::scenes
