#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "scenes/prepare/plantings.h"
#include "scenes/read/read_scene.h"
#include "scenes/show/pictures.h"
#include "sim/grow/grow.h"
#include "sim/light/lighting.h"
#include "tests/support/scratch.h"

/// The library's courtyard shows what sections 4 and 6 of Ned Greene's "Voxel Space Automata" tell of its
/// figures 5 and 6.
namespace espalier::scenes {
namespace {

using sim::Vec3;

struct Court {
  Scene scene;
  Site site;            ///< with what grew in it
  sim::Lighting light;  ///< of the surfaces, before anything grew
  sim::Growth growth;
};

Scene courtyard() {
  auto read = readScene(tests::sourceFolder() / "scenes/library/courtyard.yaml");
  if (!read) throw std::runtime_error(format(read.problems()));
  return *read;
}

Court grownCourt(Scene scene) {
  Site site = makeSite(scene);
  const auto plantings = makePlantings(scene, site);
  sim::Lighting light = sim::lightOf(site.world, site.sky, site.sun, {.faces = false});
  sim::Growth growth = sim::grow(site.world, plantings, growthSettings(scene, site, {}));
  return {std::move(scene), std::move(site), std::move(light), std::move(growth)};
}

/// As the library has it, grown once.
const Court& court() {
  static const Court it = grownCourt(courtyard());
  return it;
}

/// A planting's plants.
std::vector<const sim::Plant*> plantsOf(const Court& of, const std::string& planting) {
  std::vector<const sim::Plant*> plants;
  for (const sim::Plant& plant : of.growth.plants) {
    if (plant.name.starts_with(planting + " ")) plants.push_back(&plant);
  }
  EXPECT_FALSE(plants.empty());
  return plants;
}

const rules::RuleSet& rulesOf(const Scene& scene, const std::string& planting) {
  for (const PlantSpec& plant : scene.plants) {
    if (plant.name == planting) return *plant.rules;
  }
  throw std::runtime_error("the courtyard has no '" + planting + "'");
}

/// The region that is nearest.
std::string regionAt(const sim::World& world, Vec3 at_vx) {
  const auto near = world.nearnessAt(sim::voxelAt(at_vx));
  return near ? world.part(near->part).region : std::string();
}

struct Foliage {
  int segments = 0, leaves = 0;
  double scales = 0.0;

  double meanScale() const { return scales / leaves; }
  double leavesASegment() const { return static_cast<double>(leaves) / segments; }
};

/// Of the vines' segments that end where a region is nearest.
Foliage foliageOn(const std::string& region) {
  Foliage all;
  for (const sim::Plant* plant : plantsOf(court(), "vine")) {
    const sim::Skeleton& s = plant->skeleton;
    std::vector<bool> there(s.parent.size());
    for (std::size_t n = 1; n < there.size(); ++n) {
      there[n] = regionAt(court().site.world, s.position_vx[n]) == region;
      all.segments += there[n];
    }
    for (const sim::PlacedElement& leaf : plant->elements) {
      if (!there[static_cast<std::size_t>(leaf.node)]) continue;
      ++all.leaves;
      all.scales += leaf.scale;
    }
  }
  return all;
}

TEST(Courtyard, LeavesAreLargerAndMoreOnTopOfTheWallThanOnItsFaces) {
  const Foliage top = foliageOn("coping"), faces = foliageOn("wall");
  EXPECT_GT(top.segments, 1000);
  EXPECT_GT(faces.segments, 1000);
  EXPECT_GT(top.meanScale(), 1.08 * faces.meanScale());
  EXPECT_GT(top.leavesASegment(), 1.08 * faces.leavesASegment());
}

/// Of a surface voxel, by its number.
double exposureOf(const Court& of, const render::LightNeeds& needs, std::size_t surface) {
  return needs.sun * of.light.sun.values[surface] + needs.sky * of.light.sky.values[surface];
}

/// What panel C asks of the surface voxel that is nearest to a place, which lies within the boundary layers.
bool isBright(const Court& of, const render::LightNeeds& needs, Vec3 at_vx) {
  constexpr int kReach = 6;
  const sim::Voxel middle = sim::voxelAt(at_vx);
  const sim::Voxel size = of.light.where->bits().size();
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
  for (int k = 0; k < 13 * 13 * 13; ++k) {
    const sim::Voxel v = middle + sim::Voxel(k % 13, k / 13 % 13, k / 169) - kReach;
    if (glm::any(glm::lessThan(v, sim::Voxel(0))) || glm::any(glm::greaterThanEqual(v, size))) continue;
    if (!of.light.where->has(v)) continue;
    const double distance = glm::distance(Vec3(v), at_vx);
    if (distance < least) {
      least = distance;
      nearest = of.light.where->number(v);
    }
  }
  EXPECT_LT(least, kReach);
  return exposureOf(of, needs, nearest) >= needs.least;
}

TEST(Courtyard, VinesKeepToThePartsThatAreBrightEnough) {
  const render::LightNeeds needs = lightNeeds(rulesOf(court().scene, "vine"));
  EXPECT_FLOAT_EQ(needs.least, 0.3f);
  EXPECT_FLOAT_EQ(needs.sun, 0.8f);
  std::size_t nodes = 0, bright = 0;
  for (const sim::Plant* plant : plantsOf(court(), "vine")) {
    for (const Vec3 at : plant->skeleton.position_vx) {
      ++nodes;
      bright += isBright(court(), needs, at);
    }
  }
  EXPECT_GT(nodes, 10000u);
  EXPECT_GE(static_cast<double>(bright), 0.95 * static_cast<double>(nodes));
  // Which they would not do by chance.
  std::size_t walls = 0, dark = 0;
  for (std::size_t i = 0; i < court().light.surfaces.size(); ++i) {
    const std::string region = regionAt(court().site.world, Vec3(court().light.surfaces[i].voxel));
    if (region != "wall" && region != "coping") continue;
    ++walls;
    dark += exposureOf(court(), needs, i) < needs.least;
  }
  EXPECT_GT(static_cast<double>(dark), 0.2 * static_cast<double>(walls));
}

TEST(Courtyard, TheSunStandsBehindTheWallWithTheWindow) {
  EXPECT_EQ(court().scene.sun.tilt_deg, 20.0);
  double front = 0.0, back = 0.0;
  int in_front = 0, behind = 0;
  for (std::size_t i = 0; i < court().light.surfaces.size(); ++i) {
    const sim::TiledVoxel& tiled = court().light.surfaces[i];
    const Vec3 at = sim::worldFromVoxel(court().site.world.frame(), Vec3(tiled.voxel));
    // Its bare faces, between the beds and the coping.
    if (std::abs(at.x) > 2.0 || at.y < 0.5 || at.y > 1.8 || std::abs(at.z + 2.08) > 0.2) continue;
    if (regionAt(court().site.world, Vec3(tiled.voxel)) != "wall") continue;
    const bool viewers = at.z > -2.08;
    (viewers ? front : back) += court().light.sun.values[i];
    ++(viewers ? in_front : behind);
  }
  ASSERT_GT(in_front, 1000);
  ASSERT_GT(behind, 1000);
  EXPECT_LT(front / in_front, 0.02);
  EXPECT_GT(back / behind, 0.8);
}

/// From the wall with the window to the flowers (scenes/meshes/make_courtyard.py has its face at z = -1.92).
double meanFromWall(const Court& of) {
  double sum = 0.0;
  int flowers = 0;
  for (const sim::Plant* plant : plantsOf(of, "flowers")) {
    for (const sim::PlacedElement& element : plant->elements) {
      if (plant->shapes[static_cast<std::size_t>(element.shape)].name != "flower") continue;
      sum += sim::worldFromVoxel(of.site.world.frame(), element.position_vx).z + 1.92;
      ++flowers;
    }
  }
  EXPECT_GT(flowers, 100);
  return sum / flowers;
}

Court withBias(double light) {
  Scene scene = courtyard();
  for (PlantSpec& plant : scene.plants) {
    if (plant.name != "flowers") continue;
    auto rules = std::make_shared<rules::RuleSet>(*plant.rules);
    rules->bias.light = light;
    plant.rules = rules;
  }
  return grownCourt(std::move(scene));
}

TEST(Courtyard, FlowersGrowAwayFromTheWallAsTheyTurnToTheLight) {
  EXPECT_EQ(rulesOf(court().scene, "flowers").bias.light, rules::Value(0.15));
  const double none = meanFromWall(withBias(0.0)), own = meanFromWall(court()),
               strong = meanFromWall(withBias(0.4));
  EXPECT_GT(own, none + 0.01);
  EXPECT_GT(strong, own + 0.05);
}

}  // namespace
}  // namespace espalier::scenes
