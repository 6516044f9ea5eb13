#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "rules/growth/make_process.h"
#include "rules/growth/scene_lines.h"
#include "scenes/read/read_rules.h"
#include "sim/base/random.h"
#include "sim/grow/grow.h"
#include "sim/tile/build_world.h"
#include "tests/support/lively.h"
#include "tests/support/meshes.h"
#include "tests/support/plots.h"

/// Seeds of every rule set of the library, where such a plant would live.
namespace espalier {
namespace {

namespace fs = std::filesystem;
using sim::Vec3;
using sim::Voxel;

struct Place {
  sim::World world;
  Vec3 seed_vx{0.0};
  Vec3 about_vx{0.0};  ///< how far the seed may stand from there
  std::vector<rules::LineEnds> lines_vx = {};
};

sim::World floored(Voxel size) {
  sim::World world({Vec3(0.0), 0.04, size});
  tests::addBox(world, "soil", {0, 0, 0}, {size.x - 1, 1, size.z - 1});
  return world;
}

Place openGround() {
  Place place{floored({40, 32, 40}), {20, 2, 20}, {6, 0.4, 6}};
  place.world.setLayers(8);
  return place;
}
Place wallsFoot() {
  Place place{floored({40, 40, 32}), {20, 2, 11.2}, {8, 0.4, 0.6}};
  tests::addBox(place.world, "brick", {0, 2, 0}, {39, 39, 9});
  place.world.setLayers(8);
  return place;
}
Place ledge() {
  Place place{floored({40, 44, 32}), {20, 22, 12}, {8, 0.4, 1.4}};
  tests::addBox(place.world, "brick", {0, 2, 0}, {39, 39, 9});
  tests::addBox(place.world, "stone", {0, 20, 10}, {39, 21, 14});
  place.world.setLayers(8);
  return place;
}
Place column() {
  Place place{floored({32, 96, 32}), {16, 2, 20.2}, {2.4, 0.4, 0.6}};
  tests::addBox(place.world, "marble", {13, 2, 13}, {18, 95, 18});
  place.world.setLayers(8);
  return place;
}
/// As figure 2 has it: a sheet one voxel thick.
Place sheet() {
  Place place{sim::World({Vec3(0.0), 0.04, {64, 64, 1}}), {32, 8, 0}, {20, 6, 0}};
  tests::addBox(place.world, "soil", {0, 0, 0}, {63, 1, 0});
  place.world.setLayers(8);
  return place;
}

/// A post with two arms that is a guide and no more.
Place sketch() {
  sim::TiledMesh post{tests::emptyMesh("sketch")};
  post.mesh.regions = {"posts"};
  post.guide = true;
  for (const auto& [from, to] :
       {std::pair(Vec3(20, 0, 20), Vec3(20, 40, 20)), std::pair(Vec3(20, 40, 20), Vec3(36, 60, 20)),
        std::pair(Vec3(20, 40, 20), Vec3(4, 60, 20))})
    post.lines.push_back({0.04 * from, 0.04 * to, 0});
  Place place{sim::buildWorld({Vec3(0.0), 0.04, {40, 64, 40}}, {post}, 8), {20, 8, 20}, {0.4, 6, 0.4}};
  for (const sim::Line& line : post.lines) place.lines_vx.emplace_back(line.from_m / 0.04, line.to_m / 0.04);
  return place;
}

const std::map<std::string, std::vector<std::pair<std::string, Place (*)()>>> kHomes = {
    {"shy_shrub", {{"open ground", openGround}}},
    {"flowering_plant", {{"open ground", openGround}, {"a wall's foot", wallsFoot}}},
    {"line_tracker", {{"a sketch", sketch}}},
    {"sketch_limbs", {{"a sketch", sketch}}},
    {"courtyard_vine", {{"open ground", openGround}, {"a wall's foot", wallsFoot}, {"a ledge", ledge}}},
    {"ivy",
     {{"open ground", openGround}, {"a wall's foot", wallsFoot}, {"a ledge", ledge}, {"a column", column}}},
    {"crevice_ivy", {{"open ground", openGround}, {"a wall's foot", wallsFoot}, {"a ledge", ledge}}},
    {"flat_walk", {{"a sheet", sheet}, {"open ground", openGround}}},
    {"column_climber_up", {{"a column", column}, {"open ground", openGround}}},
    {"column_climber_near", {{"a column", column}}},
    {"column_climber_helix", {{"a column", column}}},
};

/// Segments after 50 iterations, or as soon as there are enough.
int segmentsOf(const Place& place, const std::shared_ptr<const rules::RuleSet>& rules, Vec3 at_vx) {
  sim::World world = place.world;
  sim::GrowthSettings settings = tests::brightSettings(50);
  settings.commons[rules::kSceneLines] = rules::columnsOf(place.lines_vx);
  sim::Growing growing(world, tests::planting(world, *rules, {at_vx}), settings);
  const auto segments = [&] { return growing.growth().plants[0].skeleton.size() - 1; };
  while (segments() < 20 && growing.step()) {
  }
  return segments();
}

TEST(Library, SeedsLiveWhereTheirKindWould) {
  constexpr int kSeeds = 100;
  for (const auto& file : fs::directory_iterator(ESPALIER_SOURCE_DIR "/rules/library")) {
    const auto rules = scenes::readRules(file.path());
    ASSERT_TRUE(rules);
    if ((*rules)->propagate != rules::Propagate::random_tree) continue;
    const auto home = kHomes.find(file.path().stem().string());
    ASSERT_NE(home, kHomes.end()) << "where would " << file.path() << " live?";
    for (const auto& [name, make] : home->second) {
      const Place place = make();
      int dead = 0;
      for (unsigned i = 0; i < kSeeds; ++i) {
        sim::Slots slots({sim::streamOf(1, "seeds"), i}, sim::Purpose::custom);
        const Vec3 share(slots.uniform(0), slots.uniform(1), slots.uniform(2));
        const Vec3 at = place.seed_vx + place.about_vx * (2.0 * share - 1.0);
        dead += segmentsOf(place, *rules, at) < 20;
      }
      EXPECT_LE(dead, 2) << home->first << " at " << name;
    }
  }
}

}  // namespace
}  // namespace espalier
