#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "scenes/lights.h"
#include "scenes/prepare/plantings.h"
#include "scenes/read/read_scene.h"
#include "sim/grow/grow.h"
#include "sim/light/brightest.h"
#include "sim/tile/tiling.h"
#include "tests/support/scratch.h"

/// The library's scenes of figures 1 and 7 to 9 of Ned Greene's "Voxel Space Automata", and of what plants
/// sense after its section 3, show what they say.
namespace espalier::scenes {
namespace {

using sim::Vec3;

struct Figure {
  Scene scene;
  Site site;
  sim::Growth growth;

  const sim::Plant& plant(const std::string& of) const {
    return *std::find_if(growth.plants.begin(), growth.plants.end(),
                         [&](const sim::Plant& p) { return p.name.starts_with(of); });
  }
};

Figure grown(Scene scene) {
  Site site = makeSite(scene);
  const auto plantings = makePlantings(scene, site);
  auto settings = growthSettings(scene, site, {});
  sim::Growth growth = sim::grow(site.world, plantings, settings);
  return {std::move(scene), std::move(site), std::move(growth)};
}

Scene library(const std::string& name) {
  auto read = readScene(tests::sourceFolder() / "scenes/library" / (name + ".yaml"));
  if (!read) throw std::runtime_error(format(read.problems()));
  return *read;
}

Vec3 placeOf(const Figure& figure, const sim::Plant& plant, std::size_t node) {
  return sim::worldFromVoxel(figure.site.world.frame(), plant.skeleton.position_vx[node]);
}

std::vector<int> childrenOf(const sim::Plant& plant) {
  std::vector<int> children(plant.skeleton.parent.size(), 0);
  for (const sim::NodeId parent : plant.skeleton.parent) {
    if (parent != sim::kNoNode) ++children[static_cast<std::size_t>(parent)];
  }
  return children;
}

double degrees(Vec3 a, Vec3 b) {
  return std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0)) * 180.0 /
         std::numbers::pi;
}

TEST(Figure1, TheVoxelsOfAPolygonAndALineAreThoseThatTheyPass) {
  const Figure figure = grown(library("figure_1"));
  const sim::World& world = figure.site.world;
  EXPECT_EQ(world.frame().size, sim::Voxel(8));
  ASSERT_EQ(figure.site.meshes.size(), 2u);
  std::vector<sim::Voxel> polygon, line;
  const auto vx = [&](Vec3 p_m) { return sim::voxelFromWorld(world.frame(), p_m); };
  const sim::Mesh& mesh = figure.site.meshes[0].mesh;
  for (const auto& t : mesh.triangles)
    sim::tileTriangle({vx(mesh.vertices_m[t[0]]), vx(mesh.vertices_m[t[1]]), vx(mesh.vertices_m[t[2]])},
                      polygon);
  for (const sim::Line& l : figure.site.meshes[1].lines) sim::tileSegment(vx(l.from_m), vx(l.to_m), line);
  sim::BitVolume expected(world.frame().size);
  for (const auto* voxels : {&polygon, &line}) {
    for (const sim::Voxel v : *voxels) expected.set(v);
  }
  EXPECT_EQ(world.occupied().words(), expected.words());
  const Vec3 normal =
      glm::cross(mesh.vertices_m[1] - mesh.vertices_m[0], mesh.vertices_m[2] - mesh.vertices_m[0]);
  for (const Vec3 corner : mesh.vertices_m)
    EXPECT_NEAR(glm::dot(corner - mesh.vertices_m[0], normal), 0.0, 1e-5)
        << "a polygon is flat, as its file's numbers say";
}

TEST(Tendril, LeavesTheCubeByItsOpenSideAndTurnsToTheTopOfTheSunsWay) {
  const Scene scene = library("tendril");
  EXPECT_EQ(scene.iterations, 5);
  const Figure figure = grown(scene);
  const sim::Plant& tendril = figure.plant("tendril");
  ASSERT_EQ(tendril.skeleton.size(), 6) << "a segment an iteration";
  const Vec3 top = sunDirection(scene.sun, 12.0);
  std::vector<double> off;
  for (std::size_t n = 1; n < 6; ++n)
    off.push_back(degrees(placeOf(figure, tendril, n) - placeOf(figure, tendril, n - 1), top));
  EXPECT_GT(off[0], 30.0) << "it cannot see there yet";
  EXPECT_LT(off[1], off[0]);
  for (std::size_t n = 2; n < 5; ++n) EXPECT_LT(off[n], 12.0);
  const auto inside = [](Vec3 p) {
    return std::abs(p.x) < 0.7 && p.y > 0.1 && p.y < 1.5 && std::abs(p.z) < 0.7;
  };
  EXPECT_TRUE(inside(placeOf(figure, tendril, 0)));
  for (std::size_t n = 1; n < 6; ++n) {
    const Vec3 from = placeOf(figure, tendril, n - 1), to = placeOf(figure, tendril, n);
    if (!inside(from) || inside(to)) continue;
    const Vec3 out = glm::mix(from, to, (0.7 - from.z) / (to.z - from.z));
    EXPECT_LT(std::abs(out.x), 0.7);
    EXPECT_LT(out.y, 1.5);
    return;
  }
  FAIL() << "it stays inside";
}

/// Of a planting's tips between their last segments and the brightest spots that they see.
double meanOff(const Figure& figure, const std::string& planting) {
  const sim::SkyTable table =
      skyTableOf(backgroundOf(figure.scene.sky, figure.site.sky_picture, figure.site.sun.directions));
  double sum = 0.0;
  int tips = 0;
  for (const sim::Plant& plant : figure.growth.plants) {
    if (!plant.name.starts_with(planting + " ")) continue;
    const std::vector<int> children = childrenOf(plant);
    for (std::size_t n = 1; n < children.size(); ++n) {
      if (children[n] > 0) continue;
      const Vec3 at = plant.skeleton.position_vx[n];
      const Vec3 spot = sim::brightest(table, figure.site.world.opaque(), sim::voxelAt(at));
      if (spot == Vec3(0.0)) continue;
      sum +=
          degrees(at - plant.skeleton.position_vx[static_cast<std::size_t>(plant.skeleton.parent[n])], spot);
      ++tips;
    }
  }
  EXPECT_GT(tips, 50);
  return sum / tips;
}

TEST(Clusters, TipsPointFifteenDegreesNearerToTheBrightestSpot) {
  double without = 0.0, with = 0.0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    Scene scene = library("clusters");
    scene.seed = seed;
    const Figure figure = grown(scene);
    without += meanOff(figure, "without") / 3.0;
    with += meanOff(figure, "with") / 3.0;
  }
  EXPECT_GT(without, with + 15.0);
}

TEST(Gable, AllForksOfTheRailingBranchAndNothingElseDoes) {
  Scene scene = library("gable");
  std::erase_if(scene.plants, [](const PlantSpec& plant) { return plant.name != "railing"; });
  scene.world.bounds_m = {{Vec3(-3.0, -0.1, 2.0), Vec3(3.0, 1.5, 2.8)}};
  const Figure figure = grown(scene);
  // Where posts, rails and braces meet (scenes/meshes/make_rough.py); what reaches a fork by two lines finds
  // the rest of them taken.
  std::vector<Vec3> forks;
  for (int i = 0; i < 5; ++i) {
    for (const double y : {0.15, 1.05}) forks.emplace_back(-2.4 + 1.2 * i, y, 2.4);
  }
  for (int i = 0; i < 4; ++i) {
    for (const double y : {0.62, 1.05}) forks.emplace_back(-1.8 + 1.2 * i, y, 2.4);
  }
  int branchings = 0;
  for (const sim::Plant& plant : figure.growth.plants) {
    const std::vector<int> children = childrenOf(plant);
    for (std::size_t n = 0; n < children.size(); ++n) {
      if (children[n] < 2) continue;
      ++branchings;
      const Vec3 at = placeOf(figure, plant, n);
      EXPECT_TRUE(
          std::any_of(forks.begin(), forks.end(), [&](Vec3 fork) { return glm::distance(fork, at) < 0.12; }))
          << at.x << " " << at.y;
    }
  }
  EXPECT_GE(branchings, 9);
  EXPECT_LE(branchings, static_cast<int>(forks.size()));
  // Drawn out: every bit of the lines has a limb near.
  const sim::BitVolume& taken = figure.site.world.occupied();
  const sim::Frame& frame = figure.site.world.frame();
  int near = 0, all = 0;
  for (const sim::Line& line : figure.site.meshes[1].lines) {
    if (line.from_m.z < 2.0) continue;
    for (int i = 0; i <= 20; ++i, ++all) {
      const sim::Voxel v =
          sim::voxelAt(sim::voxelFromWorld(frame, glm::mix(line.from_m, line.to_m, i / 20.0)));
      bool found = false;
      for (int k = 0; k < 5 * 5 * 5; ++k)
        found = found || (taken.at(v + sim::Voxel(k % 5, k / 5 % 5, k / 25) - 2));
      near += found;
    }
  }
  EXPECT_GT(near, 0.95 * all);
}

/// What limbs of the house do: at the eaves, the longest row of segments, and near the tops of the gables,
/// the mean angle between their ways and those to the apex.
struct HouseLimbs {
  int at_eaves = 0, longest = 0, at_gables = 0;
  double off_apex_deg = 0.0;
};

HouseLimbs houseLimbs(bool turn_away) {
  Scene scene = library("gable");
  std::erase_if(scene.plants, [](const PlantSpec& plant) { return plant.name != "house"; });
  scene.world.voxel_m = 0.05;  // quicker, and the rules are in centimetres
  if (!turn_away) {
    auto rules = std::make_shared<rules::RuleSet>(*scene.plants[0].rules);
    auto gables = std::make_shared<rules::RuleSet>(*rules->regions.find("gables")->second.rules);
    EXPECT_NE(gables->bias.apex, rules::Value(0.0));
    gables->bias.apex = 0.0;
    rules->regions["gables"].rules = gables;
    scene.plants[0].rules = rules;
  }
  const Figure figure = grown(scene);
  const sim::World& world = figure.site.world;
  const auto regionAt = [&](Vec3 at_vx) {
    const auto near = world.nearnessAt(sim::voxelAt(at_vx));
    return near ? world.part(near->part).region : std::string();
  };
  HouseLimbs limbs;
  for (const sim::Plant& plant : figure.growth.plants) {
    const sim::Skeleton& s = plant.skeleton;
    std::vector<int> there(s.parent.size(), 0);
    for (std::size_t n = 1; n < s.parent.size(); ++n) {
      const auto parent = static_cast<std::size_t>(s.parent[n]);
      const std::string from = regionAt(s.position_vx[parent]), to = regionAt(s.position_vx[n]);
      if (from == "eaves" && to == "eaves") {
        there[n] = there[parent] + 1;
        limbs.longest = std::max(limbs.longest, there[n]);
        ++limbs.at_eaves;
      }
      const Vec3 at = placeOf(figure, plant, parent);
      if (from != "gables" || at.y < 3.6) continue;
      const Vec3 apex(0, 4.9, at.z > -0.4 ? 1.2 : -2.0);
      limbs.off_apex_deg += degrees(placeOf(figure, plant, n) - at, apex - at);
      ++limbs.at_gables;
    }
  }
  limbs.off_apex_deg /= std::max(1, limbs.at_gables);
  return limbs;
}

TEST(Gable, EaveLimbsEndAndGableLimbsTurnAway) {
  const HouseLimbs limbs = houseLimbs(true), plain = houseLimbs(false);
  EXPECT_GT(limbs.at_eaves, 100);
  EXPECT_LE(limbs.longest, 5);
  EXPECT_GT(limbs.at_gables, 50);
  EXPECT_GT(limbs.off_apex_deg, plain.off_apex_deg + 10.0);
}

/// Share of the nodes of plants whose names begin so that stand nearer to another one of them.
double shareNear(const Figure& figure, const std::string& of, double near_m) {
  std::vector<std::vector<Vec3>> plants;
  for (const sim::Plant& plant : figure.growth.plants) {
    if (!plant.name.starts_with(of)) continue;
    plants.emplace_back();
    for (std::size_t n = 0; n < plant.skeleton.position_vx.size(); ++n)
      plants.back().push_back(placeOf(figure, plant, n));
  }
  std::size_t all = 0, close = 0;
  for (std::size_t a = 0; a < plants.size(); ++a) {
    for (const Vec3 at : plants[a]) {
      ++all;
      bool found = false;
      for (std::size_t b = 0; b < plants.size() && !found; ++b) {
        found = b != a && std::any_of(plants[b].begin(), plants[b].end(),
                                      [&](Vec3 other) { return glm::distance(at, other) < near_m; });
      }
      close += found;
    }
  }
  return static_cast<double>(close) / static_cast<double>(all);
}

TEST(ShyShrubs, KeepClearOfEachOther) {
  const Figure figure = grown(library("shy_shrubs"));
  for (const sim::Plant& plant : figure.growth.plants) EXPECT_GT(plant.skeleton.size(), 200) << plant.name;
  const double careless = shareNear(figure, "careless", 0.12), shy = shareNear(figure, "shy", 0.12);
  EXPECT_GT(careless, 0.15);
  EXPECT_LT(shy, 0.05) << careless;
}

}  // namespace
}  // namespace espalier::scenes
