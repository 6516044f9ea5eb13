#include <gtest/gtest.h>

#include <algorithm>

#include "rules/growth/front_memory.h"
#include "tests/support/colonies.h"
#include "tests/support/plots.h"

namespace espalier {
namespace {

using rules::Acts;
using sim::Vec3;
using tests::open;

constexpr int kMany = 2000;  // iterations: far more than any of these need

/// Two voxels thick, across the whole world above the seeds.
sim::World shut() {
  sim::World world = open();
  tests::addBox(world, "slab", {0, 24, 0}, {63, 26, 63});
  world.setLayers(4);
  return world;
}

std::vector<Vec3> above() {
  return tests::inBox(21, 120, {32, 46, 32}, {20, 16, 20});
}

struct Way {
  const char* name;
  Acts acts;
  bool onto, repeated;
};
void PrintTo(const Way& way, std::ostream* out) {
  *out << way.name;
}
const Way kWays[] = {{"nearest", Acts::on_nearest_node, false, false},
                     {"nearest_repeated", Acts::on_nearest_node, false, true},
                     {"nearest_onto", Acts::on_nearest_node, true, false},
                     {"nearest_onto_repeated", Acts::on_nearest_node, true, true},
                     {"every", Acts::on_every_node, false, false},
                     {"every_repeated", Acts::on_every_node, false, true},
                     {"every_onto", Acts::on_every_node, true, false},
                     {"every_onto_repeated", Acts::on_every_node, true, true}};

class Ends : public testing::TestWithParam<Way> {
 protected:
  Ends() {
    rules_.colonization.acts = GetParam().acts;
    rules_.colonization.onto = GetParam().onto;
    rules_.colonization.repeated = GetParam().repeated;
    if (GetParam().repeated) rules_.colonization.influence = {10.0};  // or it has thousands of ways
  }
  rules::RuleSet rules_ = tests::tree();
};

TEST_P(Ends, WhereNothingLeadsToTheCrown) {
  sim::World world = shut();
  const sim::Growth growth = tests::grown(world, rules_, {{32, 20, 32}}, above(), kMany);
  EXPECT_LT(growth.iterations, kMany / 4);
  const sim::Columns& crown = growth.commons.at(rules::attractorsNamed("crown"));
  EXPECT_EQ(rules::fatesIn(crown).reached + rules::fatesIn(crown).taken, 0u);
  EXPECT_EQ(rules::endingIn(crown, growth.iterations, true).find("iterations"), std::string::npos)
      << rules::endingIn(crown, growth.iterations, true);
}

TEST_P(Ends, WhereAllIsOpen) {
  sim::World world = open();
  const sim::Growth growth = tests::grown(world, rules_, {{32, 18, 32}}, above(), kMany);
  EXPECT_LT(growth.iterations, kMany / 4);
  const rules::Fates fates = rules::fatesIn(growth.commons.at(rules::attractorsNamed("crown")));
  EXPECT_GT(fates.reached + fates.taken, 30u);
  EXPECT_GT(growth.plants[0].skeleton.size(), 15);
}

TEST_P(Ends, WhereABiasPulls) {
  rules_.bias.up = 0.3;
  sim::World world = open();
  const sim::Growth growth = tests::grown(world, rules_, {{32, 18, 32}}, above(), kMany);
  EXPECT_LT(growth.iterations, kMany / 4);
  EXPECT_GT(growth.plants[0].skeleton.size(), 15);
}

TEST_P(Ends, WhereTreesCompeteInTheDark) {
  rules_.require.exposure_min = 0.6;
  sim::World world = shut();
  auto attractors = above();
  if (GetParam().repeated) attractors.resize(40);  // or it has thousands of ways
  const sim::Growth growth =
      tests::grown(world, rules_, {{20, 30, 20}, {44, 30, 44}, {32, 20, 32}}, attractors, kMany);
  EXPECT_LT(growth.iterations, kMany / 4);
}

INSTANTIATE_TEST_SUITE_P(Fronts, Ends, testing::ValuesIn(kWays),
                         [](const auto& way) { return std::string(way.param.name); });

TEST(Ending, IsToldInWords) {
  EXPECT_EQ(rules::endingOf({.reached = 3, .taken = 2}, false), "all attractors were reached");
  EXPECT_EQ(rules::endingOf({.reached = 3, .given_up = 1}, false),
            "3 of 4 attractors were reached; no way led to the others");
  EXPECT_EQ(rules::endingOf({.waiting = 2, .reached = 3, .given_up = 1}, false),
            "no attractor is in reach any more; 2 of 6 wait");
  EXPECT_EQ(rules::endingOf({.waiting = 2, .reached = 3}, true),
            "the iterations ended while 2 of 5 attractors wait");
}

TEST(FrontBegins, ByLengthsThatDoNotDependOnWhoBeganFirst) {
  rules::RuleSet derived = tests::tree();
  derived.colonization.step = derived.colonization.influence = derived.colonization.kill = std::nullopt;
  rules::RuleSet greedy = tests::tree();
  const auto attractors = tests::crown(300);
  const Vec3 least =
      *std::min_element(attractors.begin(), attractors.end(), [](Vec3 a, Vec3 b) { return a.y < b.y; });
  for (const double kill : {3.0, 12.0, 90.0}) {  // of none, of many, of all as soon as the first begins
    greedy.colonization.kill = {kill};
    sim::World world = open();
    auto plantings = tests::planting(world, greedy, {least + Vec3(0, -4, 0)}, "first");
    plantings.push_back(tests::planting(world, derived, {{32, 2, 12}}, "second").front());
    const sim::Growth shared = sim::grow(world, plantings, tests::settings(attractors, 1));
    sim::World other = open();
    const sim::Growth alone = tests::grown(other, derived, {{32, 2, 12}}, attractors, 1);
    const char* const lengths = "front_lengths_vx";
    EXPECT_EQ(sim::column<double>(shared.stands[1].memory, lengths),
              sim::column<double>(alone.stands[0].memory, lengths));
  }
}

}  // namespace
}  // namespace espalier
