#include <gtest/gtest.h>

#include <algorithm>

#include "sim/base/error.h"
#include "sim/grow/grow.h"
#include "tests/support/colonies.h"
#include "tests/support/plots.h"

/// What rule sets do by senses of their own: bias, require, prefer, and curves over what they read.
namespace espalier::rules {
namespace {

using sim::Vec3;
using Measure = SenseSpec::Measure;

constexpr double kVoxel_m = 0.04;

RuleSet walker() {
  RuleSet rules;
  rules.random_tree.branch_age_min = rules.random_tree.branch_age_max = 1000;
  rules.random_tree.wander_deg = 25.0;
  rules.random_tree.length = {2.4};
  return rules;
}

/// Two posts in an open world, of other regions: oak at x = 12, elm at x = 52.
sim::World posts() {
  sim::World world({Vec3(0.0), kVoxel_m, {64, 48, 32}});
  tests::addBox(world, "oak", {10, 0, 14}, {12, 47, 18});
  tests::addBox(world, "elm", {52, 0, 14}, {54, 47, 18});
  world.setLayers(3);
  return world;
}

std::vector<sim::Plant> grown(sim::World world, const RuleSet& rules, const std::vector<Vec3>& seeds,
                              int iterations = 20) {
  return sim::grow(world, tests::planting(world, rules, seeds), tests::brightSettings(iterations)).plants;
}

Vec3 endOf(const sim::Plant& plant) {
  return plant.skeleton.position_vx.back();
}

RuleSet drawnTo(const std::string& of, Measure measure, double amount) {
  RuleSet rules = walker();
  rules.senses = {{"post", measure, of, {60.0}}};
  rules.bias.up = 0.05;
  rules.bias.senses = {{"post", amount}};
  return rules;
}

TEST(Sensed, BiasDrawsToARegionAndAwayFromIt) {
  for (const Measure measure : {Measure::density, Measure::distance}) {
    EXPECT_LT(endOf(grown(posts(), drawnTo("oak", measure, 0.4), {{32, 4, 16}})[0]).x, 20.0);
    EXPECT_GT(endOf(grown(posts(), drawnTo("elm", measure, 0.4), {{32, 4, 16}})[0]).x, 44.0);
    EXPECT_GT(endOf(grown(posts(), drawnTo("oak", measure, -0.4), {{32, 4, 16}}, 6)[0]).x, 36.0);
  }
}

TEST(Sensed, HeightDrawsDown) {
  RuleSet rules = walker();
  rules.senses = {{"rise", Measure::height, "scene", {6.0}}};
  rules.bias.senses = {{"rise", 0.5}};
  EXPECT_LT(endOf(grown(posts(), rules, {{32, 40, 16}}, 6)[0]).y, 34.0);
  rules.bias.senses = {{"rise", -0.5}};
  EXPECT_GT(endOf(grown(posts(), rules, {{32, 4, 16}}, 6)[0]).y, 10.0);
}

TEST(Sensed, RequireEndsLimbsWhereReadingsAreBeyond) {
  RuleSet rules = walker();
  rules.bias.up = 0.6;
  const double free_m = endOf(grown(posts(), rules, {{32, 4, 16}}, 15)[0]).y * kVoxel_m;
  rules.senses = {{"rise", Measure::height, "scene", {6.0}}};
  rules.require.senses = {{"rise", -kNoLimit, 0.6}};
  const sim::Plant low = grown(posts(), rules, {{32, 4, 16}}, 15)[0];
  EXPECT_GT(free_m, 1.0);
  EXPECT_GT((endOf(low).y + 0.5) * kVoxel_m, 0.6);
  EXPECT_LT((endOf(low).y + 0.5) * kVoxel_m, 0.6 + 2.5 * kVoxel_m);
}

TEST(Sensed, PlantsKeepTheirDistance) {
  RuleSet rules = walker();
  rules.bias.up = 0.5;
  rules.senses = {{"gap", Measure::distance, "others", {12.0}}};
  const std::vector<Vec3> seeds{{30, 3, 16}, {34, 3, 16}};
  const auto apart = [&](double amount) {
    rules.bias.senses = {{"gap", amount}};
    const auto plants = grown(posts(), rules, seeds, 14);
    return glm::distance(endOf(plants[0]), endOf(plants[1]));
  };
  EXPECT_GT(apart(-0.4), apart(0.0) + 4.0);
}

TEST(Sensed, PreferTakesTrialsByWeightedReadings) {
  RuleSet rules = walker();
  rules.bias.up = 0.3;
  rules.random_tree.wander_deg = 60.0;
  rules.random_tree.trials_min = 40;
  rules.random_tree.trials_max = 80;
  rules.senses = {{"oak", Measure::distance, "oak", {60.0}}, {"elm", Measure::distance, "elm", {60.0}}};
  const auto end = [&](double oak, double elm) {
    rules.prefer.senses = {{"oak", 0.0, oak}, {"elm", 0.0, elm}};
    return endOf(grown(posts(), rules, {{32, 4, 16}}, 8)[0]).x;
  };
  EXPECT_LT(end(3.0, 1.0), 26.0);
  EXPECT_GT(end(1.0, 3.0), 38.0);
}

TEST(Sensed, CurvesFollowReadings) {
  RuleSet rules = walker();
  rules.bias.up = 0.5;
  rules.senses = {{"oak", Measure::distance, "oak", {60.0}}};
  Value length;
  length.kind = Value::Kind::curve;
  length.over = Over::sense;
  length.sense = "oak";
  length.curve = {{0.4, 1.5}, {1.2, 4.5}};  // metres from the post
  rules.random_tree.length = {length};
  const auto first = [&](double x) {
    const sim::Plant plant = grown(posts(), rules, {{x, 4, 16}}, 1)[0];
    const auto& nodes = plant.skeleton.position_vx;
    return nodes.size() < 2 ? 0.0 : glm::distance(nodes[0], nodes[1]);
  };
  EXPECT_NEAR(first(20), 1.5, 0.01);
  EXPECT_NEAR(first(32), 1.5 + 3.0 * (20 * kVoxel_m - 0.4) / 0.8, 0.01);
  EXPECT_NEAR(first(48), 4.5, 0.01);
}

TEST(Sensed, HoldInOtherwise) {
  RuleSet top = tests::failing();
  top.otherwise = std::make_shared<const RuleSet>(drawnTo("oak", Measure::density, 0.4));
  EXPECT_LT(endOf(grown(posts(), top, {{32, 4, 16}})[0]).x, 20.0);
}

TEST(Sensed, BendFrontsAndEndThem) {
  const auto middle = [](const RuleSet& rules) {
    sim::World world({Vec3(0.0), 0.05, tests::kSize});
    tests::addBox(world, "oak", {2, 0, 30}, {4, 63, 34});
    world.setLayers(4);
    const sim::Growth growth = tests::grown(world, rules, {{32, 32, 32}}, tests::crown(300), 12);
    Vec3 sum(0.0);
    for (const Vec3& at : growth.plants[0].skeleton.position_vx) sum += at;
    return sum / static_cast<double>(growth.plants[0].skeleton.size());
  };
  RuleSet rules = tests::tree();
  const Vec3 plain = middle(rules);
  rules.senses = {{"oak", Measure::distance, "oak", {60.0}}, {"rise", Measure::height, "scene", {6.0}}};
  EXPECT_EQ(middle(rules), plain) << "nobody asks";
  rules.bias.senses = {{"oak", 0.4}};
  EXPECT_LT(middle(rules).x, plain.x - 0.3);
  rules.bias.senses = {{"oak", -0.4}};
  EXPECT_GT(middle(rules).x, plain.x + 0.3);
  rules.bias.senses.clear();
  rules.require.senses = {{"rise", -kNoLimit, 2.0}};  // metres: 40 voxel widths
  EXPECT_LT(middle(rules).y, plain.y - 1.0);
}

TEST(Sensed, AreAskedForByNamesThatThereAre) {
  RuleSet rules = walker();
  rules.prefer.senses = {{"gap", 0.0, 1.0}};
  EXPECT_THROW(grown(posts(), rules, {{32, 4, 16}}), sim::InputError);
}

TEST(Sensed, HoldAlongTheSegmentsOfFrontsToo) {
  const auto highest = [](const RuleSet& rules) {
    sim::World world = tests::open();
    const sim::Growth growth = tests::grown(world, rules, {{32, 2, 32}}, tests::crown(300));
    const auto& places = growth.plants[0].skeleton.position_vx;
    EXPECT_GT(places.size(), 20u);
    return std::max_element(places.begin(), places.end(), [](Vec3 a, Vec3 b) { return a.y < b.y; })->y;
  };
  RuleSet rules = tests::tree();
  EXPECT_GT(highest(rules), 45.0);
  rules.senses = {{"rise", Measure::height, "scene", {6.0}}};
  rules.require.along = {{"rise", -kNoLimit, 1.7}};  // metres: 34 voxel widths
  EXPECT_LT(highest(rules), 33.5 + 1e-6);
}

}  // namespace
}  // namespace espalier::rules
