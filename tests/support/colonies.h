#pragma once
#include <vector>

#include "rules/growth/front_memory.h"
#include "sim/grow/grow.h"
#include "tests/rules/front/points.h"
#include "tests/support/lively.h"

/// Trees that colonize a crown in an open world.
namespace espalier::tests {

using sim::Vec3;

inline rules::RuleSet tree() {
  rules::RuleSet rules;
  rules.name = "tree";
  rules.propagate = rules::Propagate::colonization;
  rules.colonization.attractors = "crown";
  rules.colonization.step = {2.0};
  rules.colonization.influence = {14.0};
  rules.colonization.kill = {3.0};
  return rules;
}

inline rules::RuleSet leafyTree() {
  rules::RuleSet rules = tree();
  rules.bias.light = 0.1;
  rules.light = {0.5, 0.5, 1.6};
  rules.elements = lively().elements;
  return rules;
}

inline const sim::Voxel kSize{64, 64, 64};

inline sim::World open() {
  sim::World world({Vec3(0.0), 0.05, kSize});
  world.setLayers(4);
  return world;
}

inline std::vector<Vec3> crown(int count) {
  return inBox(21, count, {32, 42, 32}, {20, 18, 20});
}

inline sim::GrowthSettings settings(const std::vector<Vec3>& attractors, int iterations = 200) {
  sim::GrowthSettings s = brightSettings(iterations);
  sim::column<Vec3>(s.commons[rules::attractorsNamed("crown")], rules::kAttractorPlace) = attractors;
  return s;
}

inline sim::Growth grown(sim::World& world, const rules::RuleSet& rules, const std::vector<Vec3>& seeds,
                         const std::vector<Vec3>& attractors, int iterations = 200) {
  return sim::grow(world, planting(world, rules, seeds, "tree"), settings(attractors, iterations));
}

}  // namespace espalier::tests
