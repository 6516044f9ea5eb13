#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "rules/front/colonize.h"
#include "rules/growth/front_memory.h"
#include "rules/growth/make_process.h"
#include "rules/growth/shared_guide.h"
#include "rules/language/registry.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/grow/grow.h"
#include "sim/grow/state.h"
#include "sim/light/sky.h"
#include "sim/tile/tiling.h"
#include "tests/rules/front/points.h"
#include "tests/support/colonies.h"
#include "tests/support/lively.h"
#include "tests/support/plots.h"

namespace espalier {
namespace {

using sim::Vec3;

using tests::crown;
using tests::grown;
using tests::leafyTree;
using tests::open;
using tests::settings;
using tests::tree;

TEST(Colonization, IsTheFrontWhereNothingIsInTheWay) {
  for (const bool onto : {false, true}) {
    for (const rules::Acts acts : {rules::Acts::on_nearest_node, rules::Acts::on_every_node}) {
      rules::RuleSet rules = tree();
      rules.colonization.acts = acts;
      rules.colonization.onto = onto;
      sim::World world = open();
      const sim::Growth growth = grown(world, rules, {{32, 2, 32}}, crown(600));
      const Vec3 start(32, 2, 32);
      const rules::Colony bare = rules::colonize(crown(600), {&start, 1}, {2.0, 14.0, 3.0, acts, onto}, 200);
      ASSERT_EQ(growth.plants.size(), 1U);
      EXPECT_GT(bare.position.size(), 400U);
      EXPECT_EQ(growth.plants[0].skeleton.position_vx, bare.position);
      EXPECT_EQ(growth.plants[0].skeleton.parent, bare.parent);
    }
  }
}

TEST(Colonization, GrowsByLengthsThatFollowFromTheAttractors) {
  rules::RuleSet rules = tree();
  rules.colonization.step = rules.colonization.influence = rules.colonization.kill = std::nullopt;
  sim::World world = open();
  const sim::Growth growth = grown(world, rules, {{32, 2, 32}}, crown(400));
  EXPECT_GT(growth.plants[0].skeleton.size(), 250);
  const rules::Front front = [&] {
    sim::Columns columns = growth.commons.at(rules::attractorsNamed("crown"));
    return rules::LentFront(columns).front;
  }();
  EXPECT_EQ(rules::fatesOf(front.attractors.fate).reached, 400U);
}

/// Voxels that segments pass and the scene stands in.
std::size_t crossings(const sim::World& scene, const sim::Growth& growth) {
  std::size_t count = 0;
  std::vector<sim::Voxel> passes;
  for (const sim::Plant& plant : growth.plants) {
    for (sim::NodeId n = 1; n < plant.skeleton.size(); ++n) {
      const auto i = static_cast<std::size_t>(n);
      passes.clear();
      sim::tileSegment(plant.skeleton.position_vx[static_cast<std::size_t>(plant.skeleton.parent[i])],
                       plant.skeleton.position_vx[i], passes);
      count += static_cast<std::size_t>(
          std::count_if(passes.begin(), passes.end(), [&](sim::Voxel v) { return scene.occupied().at(v); }));
    }
  }
  return count;
}

TEST(Colonization, GrowsAroundWhatStandsInTheWay) {
  const auto walled = [] {
    sim::World world = open();
    tests::addBox(world, "ceiling", {20, 28, 20}, {63, 30, 63});  // open on two sides
    world.setLayers(4);
    return world;
  };
  const sim::World scene = walled();
  sim::World world = walled();
  std::vector<Vec3> attractors = crown(800);
  std::erase_if(attractors, [&](Vec3 at) { return scene.occupied().at(sim::voxelAt(at)); });
  const sim::Growth growth = grown(world, tree(), {{40, 2, 40}}, attractors);
  EXPECT_EQ(crossings(scene, growth), 0U);
  // Above the ceiling too.
  const auto& places = growth.plants[0].skeleton.position_vx;
  EXPECT_GT(std::count_if(places.begin(), places.end(),
                          [](Vec3 at) { return at.y > 31 && at.x > 22 && at.z > 22; }),
            200);
  // The control: through it, if it may.
  rules::RuleSet ghost = tree();
  ghost.require.clear = false;
  sim::World other = walled();
  EXPECT_GT(crossings(scene, grown(other, ghost, {{40, 2, 40}}, attractors)), 10U);
}

TEST(Colonization, GoesAlongARoofToItsEdge) {
  for (const bool derived : {false, true}) {
    sim::World world = open();
    tests::addBox(world, "roof", {0, 24, 0}, {63, 26, 44});  // open towards the greatest z
    world.setLayers(4);
    rules::RuleSet rules = tree();
    if (derived) {
      rules.colonization = {};
      rules.colonization.attractors = "crown";
    }
    // All of the crown is above the roof, some of it beyond the roof's edge.
    const auto attractors = tests::inBox(3, 400, {32, 44, 38}, {16, 12, 22});
    const sim::Growth growth = grown(world, rules, {{32, 4, 32}}, attractors, 600);
    const rules::Fates fates = rules::fatesIn(growth.commons.at(rules::attractorsNamed("crown")));
    EXPECT_GT(fates.reached, 380U) << derived;
    EXPECT_LT(growth.iterations, 300) << derived;
  }
}

TEST(Colonization, IsBentByWhatBendsVines) {
  const auto middleHeight = [](const rules::RuleSet& rules) {
    sim::World world = open();
    const sim::Growth growth = grown(world, rules, {{32, 32, 32}}, crown(300), 12);
    double sum = 0.0;
    for (const Vec3& at : growth.plants[0].skeleton.position_vx) sum += at.y;
    return sum / static_cast<double>(growth.plants[0].skeleton.size());
  };
  rules::RuleSet up = tree(), down = tree(), light = tree();
  up.bias.up = 0.4;
  down.bias.gravity = 0.4;
  light.bias.light = 0.4;
  const double plain = middleHeight(tree());
  EXPECT_GT(middleHeight(up), plain + 0.3);
  EXPECT_LT(middleHeight(down), plain - 0.3);
  EXPECT_GT(middleHeight(light), plain + 0.1);
  rules::RuleSet none = tree();
  none.bias.up = 0.0;
  EXPECT_EQ(middleHeight(none), plain);
}

TEST(Colonization, DiesInTheDark) {
  const auto roofed = [] {
    sim::World world = open();
    tests::addBox(world, "roof", {0, 40, 0}, {63, 41, 47});
    world.setLayers(4);
    return world;
  };
  rules::RuleSet rules = tree();
  rules.require.exposure_min = 0.4;
  sim::World world = roofed();
  const sim::Growth growth = grown(world, rules, {{32, 2, 60}}, crown(600));
  const auto& places = growth.plants[0].skeleton.position_vx;
  const auto below = [](Vec3 at) { return at.y < 38 && at.z < 30; };
  EXPECT_GT(growth.plants[0].skeleton.size(), 50);
  const auto dim = std::count_if(places.begin(), places.end(), below);
  EXPECT_GT(sim::timesOf(growth.tallies[0].sites, sim::Outcome::too_dark), 0U);
  sim::World other = roofed();
  const sim::Growth blind = grown(other, tree(), {{32, 2, 60}}, crown(600));
  const auto& all = blind.plants[0].skeleton.position_vx;
  EXPECT_GT(std::count_if(all.begin(), all.end(), below), 10 * dim + 100);
}

TEST(Colonization, TreesCompeteForTheSameAttractors) {
  sim::World world = open();
  std::vector<sim::Planting> plantings = tests::planting(world, tree(), {{16, 2, 32}, {48, 2, 32}}, "oak");
  plantings.push_back(tests::planting(world, tree(), {{32, 2, 12}}, "beech").front());
  const sim::Growth growth = sim::grow(world, plantings, settings(crown(900)));
  sim::Columns columns = growth.commons.at(rules::attractorsNamed("crown"));
  const rules::LentFront lent(columns);
  std::size_t nodes = 0;
  for (const sim::Plant& plant : growth.plants) {
    EXPECT_GT(plant.skeleton.size(), 100);
    nodes += static_cast<std::size_t>(plant.skeleton.size());
  }
  EXPECT_EQ(lent.front.nodes.size(), nodes);
  EXPECT_EQ(rules::fatesOf(lent.front.attractors.fate).waiting, 0U);
  // No voxel is of two of them.
  std::map<std::tuple<int, int, int>, std::size_t> owner;
  std::vector<sim::Voxel> passes;
  for (std::size_t p = 0; p < growth.plants.size(); ++p) {
    const sim::Skeleton& skeleton = growth.plants[p].skeleton;
    for (std::size_t n = 1; n < skeleton.parent.size(); ++n) {
      passes.clear();
      sim::tileSegment(skeleton.position_vx[static_cast<std::size_t>(skeleton.parent[n])],
                       skeleton.position_vx[n], passes);
      for (const sim::Voxel v : passes)
        EXPECT_EQ(owner.emplace(std::tuple(v.x, v.y, v.z), p).first->second, p);
    }
  }
}

sim::GrowthSettings gardenSettings(int iterations) {
  sim::GrowthSettings s = settings({});
  s.iterations = iterations;
  sim::column<Vec3>(s.commons[rules::attractorsNamed("crown")], rules::kAttractorPlace) =
      tests::inBox(4, 300, {24, 30, 30}, {14, 14, 9});
  return s;
}

/// A tree and a vine.
std::vector<sim::Planting> garden(const sim::World& world) {
  std::vector<sim::Planting> plantings = tests::planting(world, leafyTree(), {{24, 2, 32}}, "tree");
  plantings.push_back(tests::planting(world, tests::lively(), {tests::kOpenSeed}, "vine").front());
  return plantings;
}

TEST(Colonization, IsTheSameOnAnyNumberOfThreadsAndInSteps) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 5}) {
    sim::World world = tests::wallPlot();
    sim::onThreads(threads, [&] {
      const sim::Growth growth = sim::grow(world, garden(world), gardenSettings(18));
      EXPECT_GT(growth.plants[0].skeleton.size(), 100);
      EXPECT_GT(growth.plants[0].elements.size(), 100U);
      EXPECT_GT(growth.plants[1].skeleton.size(), 30);
      hashes.push_back(sim::stateHash(world, growth));
    });
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);

  const sim::Inputs inputs = {{"seed", "1"}};
  for (const int before : {0, 3, 11}) {
    sim::World first = tests::wallPlot();
    const sim::BitVolume site = first.occupied();
    const std::string bytes =
        sim::stateBytes(inputs, first, site, sim::grow(first, garden(first), gardenSettings(before)));
    sim::World world = tests::wallPlot();
    sim::Growth grown =
        sim::restore(sim::readState(bytes, "growth.state"), world, garden(world), "growth.state");
    sim::Growing growing(world, garden(world), gardenSettings(18), std::move(grown));
    while (growing.step()) {
    }
    EXPECT_EQ(sim::stateHash(world, growing.growth()), hashes[0]) << "after " << before;
  }
}

// So too where rays go by how far along anything lies: in worlds of more than 65,536 bricks.
TEST(Colonization, InTheLightOfALargeWorldIsTheSameOnAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 5}) {
    sim::World world({Vec3(0.0), 0.04, {330, 320, 328}});
    const sim::Voxel bricks = world.opaqueBricks().bits().size();
    ASSERT_GT(bricks.x * bricks.y * bricks.z, 65'536);
    tests::addBox(world, "roof", {100, 60, 100}, {200, 62, 160});
    tests::addBox(world, "wall", {190, 0, 60}, {194, 300, 250});
    sim::onThreads(threads, [&] {
      rules::RuleSet rules = leafyTree();
      rules.bias.light = 0.3;
      rules.require.exposure_min = 0.05;
      sim::GrowthSettings s = settings({});
      s.iterations = 60;
      s.light.sky = sim::makeSky({.directions = 300}).directions;  // more than are looked along at once
      sim::column<Vec3>(s.commons[rules::attractorsNamed("crown")], rules::kAttractorPlace) =
          tests::inBox(4, 900, {164, 40, 164}, {24, 30, 24});
      const sim::Growth growth = sim::grow(world, tests::planting(world, rules, {{164, 4, 164}}, "tree"), s);
      EXPECT_GT(growth.plants[0].skeleton.size(), 300);
      hashes.push_back(sim::stateHash(world, growth));
    });
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

// Each key of the section changes what grows.
TEST(Colonization, HasNoKeyWithoutEffect) {
  const auto hash = [](const rules::Colonization& front) {
    rules::RuleSet rules = tree();
    rules.colonization = front;
    sim::World world = open();
    tests::addBox(world, "ceiling", {20, 28, 20}, {63, 30, 63});
    world.setLayers(4);
    sim::GrowthSettings s = settings(crown(300));
    rules::Guide whorl;
    whorl.angle_deg = 200.0;
    s.commons[rules::fieldNamed("whorl")] = rules::columnsOf(whorl);
    sim::column<Vec3>(s.commons[rules::attractorsNamed("other")], rules::kAttractorPlace) = crown(290);
    return sim::stateHash(world, sim::grow(world, tests::planting(world, rules, {{40, 2, 40}}, "tree"), s));
  };
  using Change = std::function<void(rules::Colonization&)>;
  const std::map<std::string, Change> changes = {
      {"attractors", [](auto& c) { c.attractors = "other"; }},
      {"step", [](auto& c) { c.step = {2.5}; }},
      {"influence", [](auto& c) { c.influence = {8.0}; }},
      {"kill", [](auto& c) { c.kill = {2.0}; }},
      {"acts", [](auto& c) { c.acts = rules::Acts::on_every_node; }},
      {"onto", [](auto& c) { c.onto = true; }},
      {"repeated", [](auto& c) { c.repeated = true; }},
      {"avoid", [](auto& c) { c.avoid_deg = 20.0; }},
      {"trials", [](auto& c) { c.trials = 3; }},
      {"branching.angle.min", [](auto& c) { c.branching.angle_min_deg = 40.0; }},
      {"branching.angle.max", [](auto& c) { c.branching.angle_max_deg = 30.0; }},
      {"branching.above", [](auto& c) { c.branching.above = {40.0}; }},
      {"branching.most", [](auto& c) { c.branching.most = 0; }},
      {"fields", [](auto& c) { c.fields = {"whorl"}; }},
  };
  const rules::Colonization plain = tree().colonization;
  std::set<std::uint64_t> hashes{hash(plain)};
  EXPECT_FALSE(hashes.insert(hash(plain)).second);
  const std::function<void(const rules::Table&, const std::string&)> visit = [&](const rules::Table& table,
                                                                                 const std::string& prefix) {
    for (const rules::Key& key : table.keys) {
      const std::string path = prefix + key.name;
      if (path == "crown") continue;  // strewn by a scene, before anything grows: tests/scenes/prepare
      if (key.child) {
        visit(*key.child, path + ".");
        continue;
      }
      ASSERT_TRUE(changes.contains(path)) << path << " is new: say what it changes";
      rules::Colonization changed = plain;
      changes.at(path)(changed);
      EXPECT_TRUE(hashes.insert(hash(changed)).second) << path;
    }
  };
  visit(*rules::find(rules::ruleTable(), "colonization")->child, "");
}

TEST(Colonization, RefusesAStateThatGrowthNeverLeaves) {
  sim::World world = tests::wallPlot();
  const sim::Growth sound = sim::grow(world, garden(world), gardenSettings(6));
  const auto refused = [&](const std::function<void(sim::Columns & front, sim::Columns & memory)>& damage) {
    sim::Growth growth = sound;
    damage(growth.commons.at(rules::attractorsNamed("crown")), growth.stands[0].memory);
    sim::World copy = world;
    try {
      rules::requireSoundFronts(growth.commons);
      const sim::Growing growing(copy, garden(copy), gardenSettings(18), std::move(growth));
      growing.alive();
      growing.due();
    } catch (const sim::BrokenContract&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused([](auto&, auto&) {}));
  const auto whole = [](sim::Columns& columns, const char* name) -> std::vector<std::int32_t>& {
    return sim::column<std::int32_t>(columns, name);
  };
  EXPECT_TRUE(refused([&](auto& front, auto&) { whole(front, "front_nearest")[3] = 1'000'000; }));
  EXPECT_TRUE(refused([&](auto& front, auto&) { whole(front, "tree_child")[0] = 0; }));
  EXPECT_TRUE(refused([&](auto& front, auto&) { whole(front, "front_number")[0] = -1; }));
  EXPECT_TRUE(refused([&](auto& front, auto&) { whole(front, "node_pulled_by").back() += 1; }));
  EXPECT_TRUE(refused([&](auto& front, auto&) { sim::column<double>(front, "front_x")[0] = NAN; }));
  EXPECT_TRUE(refused([&](auto& front, auto&) { front.erase("front_y"); }));
  EXPECT_TRUE(refused([&](auto& front, auto&) { front.erase("front_moved"); }));
  EXPECT_TRUE(refused([&](auto& front, auto&) { sim::column<Vec3>(front, "normal") = {Vec3(0, 1, 0)}; }));
  EXPECT_TRUE(refused([&](auto& front, auto&) { sim::column<Vec3>(front, "at_vx").pop_back(); }));
  EXPECT_TRUE(refused([&](auto& front, auto&) { whole(front, "node_tried")[0] = 1'000'000; }));
  EXPECT_TRUE(refused([&](auto& front, auto&) { sim::column<Vec3>(front, "tree_high")[0] = Vec3(0.0); }));
  EXPECT_TRUE(refused([&](auto& front, auto&) { sim::column<double>(front, "tree_farthest2")[0] = NAN; }));
  EXPECT_TRUE(refused([&](auto&, auto& memory) { whole(memory, "active_node").back() = 99'999; }));
  EXPECT_TRUE(
      refused([&](auto&, auto& memory) { sim::column<double>(memory, "front_lengths_vx")[0] = 0.0; }));
}

TEST(Colonization, SaysWhatKeepsItFromBeginning) {
  const auto messageOf = [](const rules::RuleSet& rules, const std::vector<Vec3>& attractors) {
    sim::World world = open();
    try {
      grown(world, rules, {{32, 2, 32}}, attractors);
    } catch (const sim::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  rules::RuleSet other = tree();
  other.colonization.attractors = "hedge";
  EXPECT_NE(messageOf(other, crown(10)).find("there are no attractors 'hedge'"), std::string::npos);
  rules::RuleSet derived = tree();
  derived.colonization.step = std::nullopt;
  EXPECT_NE(messageOf(derived, crown(1)).find("expected colonization.step"), std::string::npos);
  rules::RuleSet tiny = tree();
  tiny.colonization.step = {0.01};
  EXPECT_NE(messageOf(tiny, crown(10)).find("colonization.step is 0.01 voxel widths"), std::string::npos);
  rules::RuleSet mixed = tree();
  mixed.otherwise = std::make_shared<rules::RuleSet>(tests::lively());
  EXPECT_NE(messageOf(mixed, crown(10)).find("propagates otherwise"), std::string::npos);
}

}  // namespace
}  // namespace espalier
