#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "scenes/job/inspect.h"
#include "scenes/job/run.h"
#include "scenes/read/read_scene.h"
#include "tests/support/meshes.h"
#include "tests/support/messages.h"
#include "tests/support/scratch.h"

/// The scene that is made for a stranger's mesh works at once.
namespace espalier::scenes {
namespace {

using sim::Mesh;
using sim::Vec3;

class MeshScene : public testing::Test {
 protected:
  /// `place`: of each corner, in the file.
  std::filesystem::path write(const std::string& name, const Mesh& mesh,
                              const std::function<Vec3(Vec3)>& place) {
    std::string text;
    for (const Vec3& of : mesh.vertices_m) {
      const Vec3 p = place(of);
      text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    }
    for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    return scratch_.write(name, text);
  }
  InScene sceneOf(const std::vector<std::filesystem::path>& files) {
    std::vector<Inspection> meshes;
    for (const auto& file : files) meshes.push_back(inspectMesh(file));
    return sceneWith(std::move(meshes), scratch_.path("scene.yaml"));
  }
  /// Writes the scene, and lets it grow.
  Report grown(const InScene& made) {
    auto scene = readScene(scratch_.write("scene.yaml", made.text));
    EXPECT_TRUE(scene) << format(scene.problems()) << made.text;
    RunOptions options;
    options.pictures = false;
    options.folder = scratch_.path("out");
    options.strict = true;
    scene->iterations = 10;
    return runScene(*scene, options);
  }
  static std::size_t segmentsIn(const Report& report) {
    std::size_t segments = 0;
    for (const auto& plant : report.growth->plants) segments += plant.segments;
    return segments;
  }

  tests::Scratch scratch_;
  const Mesh house_ =
      tests::together(tests::boxMesh({-2, 0, -1}, {2, 2.5, 1}), tests::boxMesh({1, 0, 0}, {1.8, 3.5, 2}));
};

TEST_F(MeshScene, GrowsAVineOnAHouseHoweverItsFileHasIt) {
  const auto as_it_is = write("house.obj", house_, [](Vec3 p) { return p; });
  const auto odd =
      write("odd house.obj", tests::insideOut(house_), [](Vec3 p) { return 100.0 * Vec3(p.x, -p.z, p.y); });
  const InScene plain = sceneOf({as_it_is}), other = sceneOf({odd});
  EXPECT_EQ(plain.text.find("unit"), std::string::npos) << plain.text;
  EXPECT_NE(other.text.find("\"odd house.obj\", name: odd_house, unit: cm, up: z, solid: true"),
            std::string::npos)
      << other.text;
  for (const InScene* made : {&plain, &other}) {
    ASSERT_EQ(made->choices.size(), 3u);
    for (const VoxelChoice& choice : made->choices) EXPECT_TRUE(choice.foretold) << choice.refused;
    EXPECT_GT(segmentsIn(grown(*made)), 10u) << made->text;
  }
  // The same house, but for its name.
  EXPECT_EQ(plain.text.substr(plain.text.find("world:")), other.text.substr(other.text.find("world:")));
}

TEST_F(MeshScene, HoldsSeveralMeshesUnderNamesThatDiffer) {
  const auto here = write("wall.obj", house_, [](Vec3 p) { return p; });
  const auto there = write("other/wall.obj", house_, [](Vec3 p) { return p + Vec3(6, 0, 0); });
  const InScene both = sceneOf({here, there});
  EXPECT_NE(both.text.find("{file: other/wall.obj, name: wall_2"), std::string::npos) << both.text;
  EXPECT_GT(segmentsIn(grown(both)), 10u);
}

TEST_F(MeshScene, OfAPlaneGrowsOnIt) {
  const Mesh ground = tests::terrainMesh(4, 1.0, [](double, double) { return 0.0; });
  EXPECT_GT(segmentsIn(grown(sceneOf({write("ground.obj", ground, [](Vec3 p) { return p; })}))), 5u);
}

TEST_F(MeshScene, IsAsSmallAsItsMesh) {
  const auto file = write("thing.obj", house_, [](Vec3 p) { return 0.01 * p; });
  EXPECT_GT(segmentsIn(grown(sceneOf({file}))), 10u);
}

TEST_F(MeshScene, IsRefusedFartherOutThanScenesReach) {
  const auto file = write("far.obj", house_, [](Vec3 p) { return p + Vec3(0, 0, 5e6); });
  EXPECT_NE(tests::messageOf([&] { sceneOf({file}); }).find("farther than a scene reaches"),
            std::string::npos);
}

}  // namespace
}  // namespace espalier::scenes
