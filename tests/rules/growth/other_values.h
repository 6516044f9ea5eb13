#pragma once
#include <map>
#include <string>
#include <vector>

#include "rules/language/registry.h"
#include "tests/support/lively.h"

namespace espalier::rules {

inline std::vector<std::vector<sim::Vec3>> square() {
  return {{{-0.5, 0, 0}, {0.5, 0, 0}, {0.5, 1.5, 0}, {-0.5, 1.5, 0}}};
}

/// Another value than that of lively(), by the key's path.
inline const std::map<std::string, Datum>& otherValues() {
  static const std::map<std::string, Datum> values = {
      {"random_tree.length", Length{3.1}},
      {"random_tree.branch_age_range", WholeRange{2, 2}},
      {"random_tree.branch_angle", Value(35.0)},
      {"random_tree.wander.angle", tests::range(5.0, 60.0)},
      {"random_tree.wander.distribution", std::string("gaussian")},
      {"random_tree.wander.table", Pairs{{0.5, 0.0}, {1.5, 1.0}}},
      {"random_tree.fork", WholeRange{1, 3}},
      {"random_tree.fork_angle", 80.0},
      {"random_tree.fork_apart", std::int64_t{3}},
      {"random_tree.trials.min", std::int64_t{3}},
      {"random_tree.trials.max", std::int64_t{4}},
      {"bias.up", Value(0.3)},
      {"bias.gravity", Value(0.2)},
      {"bias.light.amount", Value(0.4)},
      {"bias.light.brightest", std::string("moment")},
      {"bias.away", Value(0.3)},
      {"bias.toward", Value(0.3)},
      {"bias.twist.amount", Value(-0.5)},
      {"bias.twist.radius", Distance{2.0}},
      {"bias.apex.amount", Value(-0.4)},
      {"bias.apex.of", std::string("soil")},
      {"bias.towards[].point", sim::Vec3(0.4, 1.0, 0.2)},
      {"bias.towards[].direction", sim::Vec3(-1, 0, 1)},
      {"bias.towards[].amount", Value(-0.3)},
      {"bias.senses[].amount", Value(0.2)},
      {"senses[].measure", std::string("height")},
      {"senses[].of", std::string("brick")},
      {"senses[].within", Distance{2.0}},
      {"require.senses[].min", 0.05},
      {"require.senses[].max", 0.1},
      {"require.along[].min", 0.08},
      {"require.along[].max", 0.09},
      {"prefer.weight", 5.0},
      {"prefer.senses[].at", 0.9},
      {"prefer.senses[].weight", 40.0},
      {"require.clear", false},
      {"require.proximity.min", Distance{1.6}},
      {"require.proximity.max", Distance{1.9}},
      {"require.age.min", std::int64_t{2}},
      {"require.age.max", std::int64_t{4}},
      {"require.in_region.max", std::int64_t{2}},
      {"require.exposure.min", 0.3},
      {"require.exposure.max", 0.6},
      {"prefer.proximity", Distance{3.0}},
      {"light.blend.sun", 0.05},
      {"light.blend.sky", 0.05},
      {"light.boost", 4.0},
      {"elements[].trials", std::int64_t{1}},
      {"elements[].per_segment", Value(0.4)},
      {"elements[].size", Length{0.6}},
      {"elements[].face", Value(0.1)},
      {"elements[].pose", std::string("hang")},
      {"elements[].polygons", Polygons{square()}},
      {"elements[].petiole", Length{0.8}},
      {"elements[].crosses", true},
      {"elements[].thick", Distance{0.2}},
      {"elements[].phyllotaxis.angle", 60.0},
      {"elements[].phyllotaxis.spacing", Distance{0.9}},
      {"elements[].phyllotaxis.whorl", std::int64_t{2}},
      {"elements[].phyllotaxis.pitch", Value(15.0)},
      // These change how the plant looks, and not how it grows.
      {"elements[].texture", std::string("ovate")},
      {"elements[].varies.chance", 0.2},
      {"elements[].varies.age", 0.2},
      {"elements[].varies.light", 0.2},
      {"elements[].varies.height", 0.2},
      {"elements[].name", std::string("thorn")},
      {"elements[].colour", sim::Colour(0.9f, 0.1f, 0.1f)},
      {"elements[].emits.colour", sim::Colour(0.9f, 0.1f, 0.1f)},
      {"elements[].emits.strength", 7.0},
      {"elements[].opacity", 0.4},
  };
  return values;
}

}  // namespace espalier::rules
