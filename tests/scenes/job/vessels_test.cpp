#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>

#include "render/form/formed.h"
#include "render/model/radii.h"
#include "scenes/prepare/attractors.h"
#include "scenes/prepare/plantings.h"
#include "scenes/read/read_scene.h"
#include "sim/grow/grow.h"
#include "sim/grow/retiled.h"
#include "sim/tile/inside.h"
#include "tests/support/drawn_forks.h"
#include "tests/support/scratch.h"

/// Figures 14 and 15 of Tanaka et al. 2022: what the library's scene says of its vessels, in its body and in
/// another, with its seed and another, at its resolution and a coarser one.
namespace espalier::scenes {
namespace {

struct ChangedVessels {
  const char* name;
  std::uint64_t seed;
  double voxel_m;
  const char* body;               ///< another mesh; empty: the figure
  std::vector<sim::Vec3> starts;  ///< there
};

std::ostream& operator<<(std::ostream& out, const ChangedVessels& changed) {
  return out << changed.name;
}

Scene vessels(const ChangedVessels& changed) {
  auto read = readScene(tests::sourceFolder() / "scenes/library/vessels.yaml");
  if (!read) throw std::runtime_error(format(read.problems()));
  Scene scene = *read;
  scene.seed = changed.seed;
  scene.world.voxel_m = changed.voxel_m;
  if (*changed.body == '\0') return scene;
  scene.meshes.at(0).file = tests::sourceFolder() / changed.body;
  for (std::size_t i = 0; i < scene.plants.size(); ++i) scene.plants[i].seeds.at(0).at_m = changed.starts[i];
  return scene;
}

struct GrownVessels {
  render::FormedStand stand;
  sim::BitVolume inside, skin;
};

GrownVessels vesselsIn(const ChangedVessels& changed) {
  const Scene scene = vessels(changed);
  Site site = makeSite(scene);
  const sim::World before = site.world;
  const auto plantings = makePlantings(scene, site);
  const sim::Growth growth =
      sim::grow(site.world, plantings, growthSettings(scene, site, attractorsOf(scene, site)));
  return {render::formedStand(before, site.world, growth.plants),
          sim::insideOf(site.meshes.at(0).mesh, site.world.frame()), before.occupied()};
}

class Vessels : public testing::TestWithParam<ChangedVessels> {
 protected:
  /// Each grown once.
  static const GrownVessels& grown() {
    static std::map<std::string, GrownVessels> all;
    const auto at = all.find(GetParam().name);
    return at != all.end() ? at->second : all.emplace(GetParam().name, vesselsIn(GetParam())).first->second;
  }
};

TEST_P(Vessels, StayInTheBody) {
  for (const sim::Plant& plant : grown().stand.plants) {
    EXPECT_GT(plant.skeleton.size(), 300);
    for (const sim::Vec3 p : plant.skeleton.position_vx) {
      const sim::Voxel v = sim::voxelAt(p);
      EXPECT_TRUE(grown().inside.at(v) && !grown().skin.at(v));
    }
  }
}

TEST_P(Vessels, ArteriesAndVeinsShareNoVoxel) {
  const auto arteries = sim::stemVoxels(grown().stand.plants.at(0).skeleton),
             veins = sim::stemVoxels(grown().stand.plants.at(1).skeleton);
  std::vector<sim::Voxel> both;
  std::set_intersection(arteries.begin(), arteries.end(), veins.begin(), veins.end(),
                        std::back_inserter(both), sim::beforeInRows);
  EXPECT_TRUE(both.empty());
}

TEST_P(Vessels, CubesOfRadiiAddUp) {
  for (const sim::Plant& plant : grown().stand.plants) {
    const sim::Skeleton& s = plant.skeleton;
    const std::vector<float> radii = render::stemRadii(s, plant.girth);
    std::vector<double> sum(radii.size(), 0.0);
    for (std::size_t n = 1; n < radii.size(); ++n)
      sum[static_cast<std::size_t>(s.parent[n])] += std::pow(static_cast<double>(radii[n]), 3);
    for (std::size_t n = 1; n < radii.size(); ++n) {
      if (sum[n] <= 0.0) continue;
      EXPECT_NEAR(std::cbrt(sum[n]) / static_cast<double>(radii[n]), 1.0, 1e-5);
    }
  }
}

TEST_P(Vessels, ForkAtMurraysAngle) {
  for (const sim::Plant& plant : grown().stand.plants) {
    const test::DrawnForks forks = test::drawnForks(plant);
    EXPECT_GT(forks.drawn_deg.size(), 100u);
    EXPECT_EQ(forks.crowded, 0u);
    EXPECT_LT(forks.meanDeviation(), 3.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Vessels,
                         testing::Values(ChangedVessels{"library", 1, 0.006, "", {}},
                                         ChangedVessels{"another_seed", 77, 0.006, "", {}},
                                         ChangedVessels{"coarser", 1, 0.006 / 0.7, "", {}},
                                         ChangedVessels{"in_a_ball",
                                                        5,
                                                        0.006,
                                                        "scenes/meshes/sphere.obj",
                                                        {{0.02, 0.1, 0.0}, {-0.02, 0.1, 0.0}}}),
                         [](const auto& changed) { return changed.param.name; });

}  // namespace
}  // namespace espalier::scenes
