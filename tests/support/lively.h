#pragma once
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "rules/growth/make_process.h"
#include "sim/grow/grow.h"
#include "sim/light/sky.h"
#include "sim/light/sun.h"
#include "sim/world/world.h"

/// A rule set in which everything has an effect, for asking what does; made for tests::wallPlot().
namespace espalier::tests {

inline rules::Value range(double low, double high) {
  rules::Value value(low);
  value.kind = rules::Value::Kind::range;
  value.high = high;
  return value;
}

inline rules::RuleSet lively() {
  rules::RuleSet rules;
  rules.name = "lively";
  rules.random_tree.wander_deg = 30.0;
  rules.random_tree.trials_min = 4;
  rules.random_tree.trials_max = 16;
  rules.bias.up = 0.08;
  rules.bias.gravity = 0.02;
  rules.bias.light = 0.1;
  rules.bias.away = 0.05;
  rules.bias.toward = 0.1;
  rules.bias.twist = 0.2;
  rules.bias.twist_radius = {5.0};
  rules.bias.apex = 0.05;
  rules.bias.towards = {{std::nullopt, sim::Vec3(1, 0, 0), 0.05}};
  rules.require.along = {{"crowd"}};
  rules.senses = {{"crowd", rules::SenseSpec::Measure::distance, "scene", {5.0}}};
  rules.bias.senses = {{"crowd", -0.05}};
  rules.require.senses = {{"crowd"}};
  rules.require.proximity_max = {3.0};
  rules.prefer = {true, {1.8}, 1.0, {{"crowd", 0.1, 10.0}}};
  rules.light = {0.5, 0.5, 1.5};
  rules::Element leaf;
  leaf.per_segment = 1.5;
  leaf.polygons = {{{0, 0.3, 0}, {-0.8, 0.8, 0}, {0, 2, 0}, {0.8, 0.8, 0}}};
  rules.elements = {leaf};
  return rules;
}

/// None of whose trials is ever good; it is neither too dark nor too bright for it, and it never rests.
inline rules::RuleSet failing() {
  rules::RuleSet rules;
  rules.name = "failing";
  rules.random_tree.trials_min = rules.random_tree.trials_max = 1;
  rules.require.proximity_max = {std::numeric_limits<double>::min()};
  return rules;
}

/// Before the wall, in the sun.
inline const sim::Vec3 kOpenSeed(12, 2, 23);

inline sim::GrowthSettings brightSettings(int iterations) {
  sim::GrowthSettings s;
  s.iterations = iterations;
  s.light.sky = sim::makeSky({.directions = 64}).directions;
  s.light.sun = sim::makeSun({20.0, 180.0, 24}).directions;
  s.sky_table = [] { return sim::makeSkyTable(9, 36, sim::backgroundOf(sim::Weighting::uniform)); };
  return s;
}

inline std::vector<sim::Planting> planting(const sim::World& world, const rules::RuleSet& rules,
                                           const std::vector<sim::Vec3>& seeds_vx,
                                           const std::string& name = "vine") {
  return {{name, rules::makeProcess(std::make_shared<rules::RuleSet>(rules), world.frame().voxel_m),
           sim::seedsAt(world.frame(), seeds_vx)}};
}

}  // namespace espalier::tests
