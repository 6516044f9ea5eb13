#include "scenes/prepare/plantings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <tuple>

#include "sim/base/error.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

/// A step of two blocks; upon the low one stands a little roof of another region.
constexpr const char* kStep = R"(
v 0 0 0
v 4 0 0
v 4 0 3
v 0 0 3
v 0 1.3 0
v 2 1.3 0
v 2 1.3 3
v 0 1.3 3
v 2 2.2 0
v 4 2.2 0
v 4 2.2 3
v 2 2.2 3
v 0 1.9 0
v 1 1.9 0
v 1 1.9 1
v 0 1.9 1
g stone
f 1 2 3 4
f 5 8 7 6
f 6 7 12 9
f 9 12 11 10
f 1 5 6 9 10 2
f 4 3 11 12 7 8
f 1 4 8 5
f 2 10 11 3
g roof
f 13 16 15 14
)";

class Step : public testing::Test {
 protected:
  Step() {
    scene_.file = "step.yaml";
    scene_.world.voxel_m = 0.25;
    scene_.world.margin_m = 0.5;
    scene_.sky.directions = 32;
    SceneMesh mesh;
    mesh.name = "step";
    mesh.file = scratch_.write("step.obj", kStep);
    mesh.solid = true;
    scene_.meshes.push_back(mesh);
    PlantSpec plant;
    plant.name = "moss";
    plant.rules = std::make_shared<rules::RuleSet>();
    scene_.plants.push_back(plant);
  }
  std::string failure() const {
    const Site site = makeSite(scene_);
    try {
      makePlantings(scene_, site);
    } catch (const sim::InputError& error) {
      return error.what();
    }
    return "";
  }

  tests::Scratch scratch_;
  Scene scene_;
};

TEST_F(Step, SeedsAreScatteredOverAllThatLooksUpAndNothingElse) {
  const Site site = makeSite(scene_);
  // Told from the list of all voxels, one by one.
  std::vector<sim::Voxel> places;
  for (const sim::TiledVoxel& tiled : site.world.surfaces()) {
    const sim::Voxel above = tiled.voxel + sim::Voxel(0, 1, 0);
    if (site.world.part(tiled.surface.part).region == "stone" && !site.world.occupied().at(above))
      places.push_back(above);
  }
  ASSERT_GT(places.size(), 150u);
  ASSERT_LT(places.size(), site.world.occupied().count() / 2);  // it is solid
  scene_.plants[0].scatter = Scatter{"stone", static_cast<int>(places.size())};
  const auto all = makePlantings(scene_, site);
  ASSERT_EQ(all.size(), 1u);
  std::vector<sim::Voxel> scattered;
  for (const sim::Seed& seed : all[0].seeds) scattered.emplace_back(seed.at_vx);
  const auto order = [](sim::Voxel a, sim::Voxel b) {
    return std::tie(a.y, a.z, a.x) < std::tie(b.y, b.z, b.x);
  };
  std::sort(scattered.begin(), scattered.end(), order);
  std::sort(places.begin(), places.end(), order);
  EXPECT_EQ(scattered, places);
}

TEST_F(Step, SeedsGivenInMetresComeFirst) {
  scene_.plants[0].seeds = {{{0.3, 1.7, 2.0}, "north door"}};
  scene_.plants[0].scatter = Scatter{"roof", 2};
  const Site site = makeSite(scene_);
  const auto plantings = makePlantings(scene_, site);
  const auto& seeds = plantings[0].seeds;
  ASSERT_EQ(seeds.size(), 3u);
  EXPECT_EQ(seeds[0].at_vx, sim::voxelFromWorld(site.world.frame(), {0.3, 1.7, 2.0}));
  EXPECT_EQ(seeds[0].key, sim::keyOfName("north door"));
  EXPECT_NE(seeds[1].at_vx, seeds[2].at_vx);
  EXPECT_NE(seeds[1].key, seeds[2].key);
}

TEST_F(Step, WhatCannotBePlantedNamesTheSceneAndTheSiteStands) {
  scene_.plants[0].scatter = Scatter{"ston", 2};
  EXPECT_EQ(failure(),
            "step.yaml: no mesh of the scene has a region 'ston'; expected one of stone, roof; did you mean "
            "'stone'?");
  scene_.plants[0].scatter = Scatter{"roof", 400};
  EXPECT_NE(failure().find("step.yaml: scatter: region 'roof' has "), std::string::npos) << failure();
  scene_.plants[0].scatter.reset();
  auto rules = std::make_shared<rules::RuleSet>();
  rules->random_tree.length = {100.0, true};
  scene_.plants[0].rules = rules;
  EXPECT_NE(failure().find("step.yaml: rule set "), std::string::npos) << failure();
}

}  // namespace
}  // namespace espalier::scenes
