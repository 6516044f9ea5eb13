#include "scenes/prepare/site.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/lights.h"
#include "sim/base/error.h"
#include "tests/support/meshes.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

using namespace std::chrono_literals;

Scene emptyScene() {
  Scene scene;
  scene.file = "garden.yaml";
  scene.world.voxel_m = 0.5;
  scene.world.bounds_m = {{sim::Vec3(-2.0), sim::Vec3(2.0)}};
  scene.seed = 7;
  scene.sky.weighting = sim::Weighting::cosine;
  scene.sky.accuracy = 0.02;
  return scene;
}

TEST(Site, KnowsItsSkyItsSunAndItsRandomRays) {
  Scene scene = emptyScene();
  scene.sun.place = SunPlace{-33.87, 151.22, 10.0};
  scene.sun.date = 2019y / 6 / 21;
  {
    const Site site = makeSite(scene);
    EXPECT_EQ(site.world.frame().size, sim::Voxel(8));
    EXPECT_FALSE(site.random_sky);
    EXPECT_EQ(site.sky.weighting, sim::Weighting::cosine);
    EXPECT_LE(site.sky.standard_error, 0.02);
    EXPECT_EQ(site.sun.about, makeSun(scene.sun).about);
  }
  scene.sky.sampling = Sampling::random;
  const Site site = makeSite(scene);
  ASSERT_TRUE(site.random_sky);
  EXPECT_EQ(site.random_sky->rays, 100);
  EXPECT_EQ(site.random_sky->seed, 7u);
}

/// Nobody said how they are wound, nor that they are closed.
TEST(Site, AStrangersMeshIsTheSameWorldHoweverItIsWound) {
  const tests::Scratch scratch;
  const auto siteOf = [&](const std::string& obj, std::optional<bool> solid) {
    Scene scene = emptyScene();
    SceneMesh mesh;
    mesh.name = "house";
    mesh.file = scratch.write("house.obj", obj);
    mesh.solid = solid;
    scene.meshes.push_back(mesh);
    scene.world.bounds_m.reset();
    scene.world.voxel_m = 0.1;
    return makeSite(scene);
  };
  const std::string right = tests::kCubeObj;
  std::string inside_out = right;
  inside_out = inside_out.substr(0, inside_out.find("f ")) +
               "f 4 3 2 1\nf 6 7 8 5\nf 2 6 5 1\nf 3 7 6 2\nf 4 8 7 3\nf 1 5 8 4\n";
  const Site a = siteOf(right, std::nullopt), b = siteOf(inside_out, std::nullopt);
  EXPECT_TRUE(a.facings.empty());
  ASSERT_EQ(b.facings.size(), 1u);
  EXPECT_EQ(b.facings[0].turned, 12u);
  for (const Site* site : {&a, &b}) {
    ASSERT_EQ(site->fills.size(), 1u);
    EXPECT_TRUE(site->fills[0].found);
  }
  EXPECT_EQ(a.world.opaque().words(), b.world.opaque().words());
  const auto surfaces = a.world.surfaces(), others = b.world.surfaces();
  ASSERT_EQ(surfaces.size(), others.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    ASSERT_EQ(surfaces[i].voxel, others[i].voxel);
    if (surfaces[i].surface.coverage == 0.0f) continue;  // a corner has no normal of its own
    ASSERT_LT(glm::distance(surfaces[i].surface.normal, others[i].surface.normal), 1e-5f);
  }
  const sim::Part& part =
      a.world.part(a.world.partAt(sim::voxelAt(sim::voxelFromWorld(a.world.frame(), {0, 1, 0}))));
  EXPECT_EQ(sim::orLeaveHollow(part),
            ", or leave 'house' hollow with solid: false: it is closed, and was filled");
  const Site hollow = siteOf(inside_out, false);  // as it is
  EXPECT_EQ(sim::orLeaveHollow(hollow.world.parts().front()), "");
  EXPECT_TRUE(hollow.fills.empty() && hollow.facings.empty());
  EXPECT_LT(hollow.world.occupied().count(), a.world.occupied().count());
}

TEST(Site, KeepsItsMeshesAsPlaced) {
  const tests::Scratch scratch;
  Scene scene = emptyScene();
  SceneMesh mesh;
  mesh.name = "slab";
  mesh.file = scratch.write("slab.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\ng top\nf 1 3 2\n");
  mesh.placement.scale = 2.0;
  mesh.placement.translate_m = {-1, 0.25, -1};
  scene.meshes.push_back(mesh);
  const Site site = makeSite(scene);
  ASSERT_EQ(site.meshes.size(), 1u);
  const auto& vertices = site.meshes[0].mesh.vertices_m;
  EXPECT_EQ(vertices.size(), 3u);
  EXPECT_NE(std::find(vertices.begin(), vertices.end(), sim::Vec3(1, 0.25, 1)), vertices.end());
  EXPECT_EQ(site.world.part(site.world.partAt({4, 4, 3})).region, "top");
}

TEST(Site, AnOptionalMeshThatIsNotThereIsSaidSo) {
  Scene scene = emptyScene();
  SceneMesh mesh;
  mesh.file = "/nowhere/gone.obj";
  mesh.optional = true;
  scene.meshes.push_back(mesh);
  EXPECT_THROW(makeSite(scene), MeshMissing);
}

TEST(Site, FaultsOfTheSceneNameItsFile) {
  Scene scene = emptyScene();
  scene.world.voxel_m = 1e-4;
  try {
    makeSite(scene);
    FAIL() << "a world of 40000 voxels a side was made";
  } catch (const sim::InputError& error) {
    EXPECT_TRUE(std::string_view(error.what()).starts_with("garden.yaml: world: ")) << error.what();
  }
}

/// A plant whose rules ask so far from the scene.
PlantSpec feeling(rules::Distance max) {
  auto rules = std::make_shared<rules::RuleSet>();
  rules->name = "ivy";
  auto shade = std::make_shared<rules::RuleSet>(*rules);
  shade->require.proximity_max = max;
  rules->otherwise = shade;
  PlantSpec plant;
  plant.rules = rules;
  return plant;
}

TEST(Site, HasTheLayersThatItsPlantsAskForOrTheScene) {
  Scene scene = emptyScene();
  EXPECT_EQ(makeSite(scene).world.layers(), 4);
  scene.plants = {feeling({2.0}), feeling({2.5, true})};  // 5 voxels
  EXPECT_EQ(makeSite(scene).world.layers(), 6);
  scene.world.layers = 8;
  EXPECT_EQ(makeSite(scene).world.layers(), 8);
  scene.plants = {feeling({1000.0}), feeling({100.0, true})};  // farther than this world is wide
  EXPECT_EQ(makeSite(scene).world.layers(), 8);
  scene.plants = {feeling({9.0, true})};
  EXPECT_EQ(makeSiteForLight(scene).world.layers(), 0);
}

TEST(Site, MoreLayersThanAreAllowedAreRefusedWithTheVoxelThatFits) {
  const auto failure = [](const PlantSpec& plant) -> std::string {
    Scene scene = emptyScene();
    scene.plants = {plant};
    try {
      layersFor(scene, {sim::Vec3(0.0), 0.02, sim::Voxel(200)});
    } catch (const sim::InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(failure(feeling({1.26, true})), "");
  PlantSpec plant = feeling({1.89, true});
  EXPECT_EQ(
      failure(plant),
      "garden.yaml: rule set 'ivy', otherwise: require.proximity.max is 94.5 voxel widths at a voxel of "
      "0.02 m, which takes 96 boundary layers; expected at most 64, as with a voxel of 0.03 m");
  plant.rules_place = {std::make_shared<const std::string>("garden.yaml"), 7, 12};
  EXPECT_TRUE(failure(plant).starts_with("garden.yaml:7:12: rule set 'ivy', otherwise: ")) << failure(plant);
  EXPECT_TRUE(failure(feeling({80.0})).ends_with("which takes 81 boundary layers; expected at most 64"));
}

TEST(Site, ACameraInAWallIsNamed) {
  const tests::Scratch scratch;
  Scene scene = emptyScene();
  SceneMesh mesh;
  mesh.name = "slab";
  mesh.file =
      scratch.write("slab.obj", "v -2 0.25 -2\nv 2 0.25 -2\nv 2 0.25 2\nv -2 0.25 2\ng top\nf 1 4 3 2\n");
  scene.meshes.push_back(mesh);
  scene.cameras.push_back({"main", {{0.2, 1.2, 0.2}, {0, 0, 0}, 40}});
  const Site site = makeSite(scene);
  requireCamerasInTheOpen(scene, site.world);
  scene.cameras.push_back({"low", {{0.2, 0.2, 0.2}, {0, 0, 0}, 40}});
  try {
    requireCamerasInTheOpen(scene, site.world);
    FAIL() << "a camera in a slab was let pass";
  } catch (const sim::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "garden.yaml: camera 'low' stands inside 'slab' (top); move its eye into the open");
  }
}

}  // namespace
}  // namespace espalier::scenes
