#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "rules/growth/ways.h"
#include "rules/language/registry.h"
#include "sim/grow/grow.h"
#include "tests/support/lively.h"
#include "tests/support/plots.h"

/// Random numbers follow from what they are for: what is added to a rule set, or planted beside it, moves no
/// others.
namespace espalier::rules {
namespace {

using tests::lively;

Value curve(Over over, double level) {
  Value value;
  value.kind = Value::Kind::curve;
  value.over = over;
  value.curve = {{0.0, level}, {1.0, level}};
  return value;
}

sim::Growth grown(const RuleSet& rules, int iterations = 7) {
  sim::World world = tests::wallPlot();
  return sim::grow(world, tests::planting(world, rules, {tests::kOpenSeed}),
                   tests::brightSettings(iterations));
}

/// Every byte of a plant that does not say where it stands in a list.
void expectSame(const sim::Plant& a, const sim::Plant& b, const std::string& what) {
  EXPECT_EQ(a.key, b.key) << what;
  EXPECT_EQ(a.skeleton.parent, b.skeleton.parent) << what;
  EXPECT_EQ(a.skeleton.position_vx, b.skeleton.position_vx) << what;
  EXPECT_EQ(a.skeleton.born, b.skeleton.born) << what;
  EXPECT_EQ(a.skeleton.columns, b.skeleton.columns) << what;
  ASSERT_EQ(a.elements.size(), b.elements.size()) << what;
  for (std::size_t i = 0; i < a.elements.size(); ++i) {
    const sim::PlacedElement &e = a.elements[i], &f = b.elements[i];
    EXPECT_TRUE(e.node == f.node && e.shape == f.shape && e.position_vx == f.position_vx && e.x == f.x &&
                e.y == f.y && e.z == f.z && e.scale == f.scale && e.exposure == f.exposure &&
                e.born == f.born)
        << what << ", element " << i;
  }
}

TEST(Draws, ABiasWithoutWeightChangesNothing) {
  RuleSet plain = lively();
  plain.bias = {};
  plain.bias.up = 0.1;
  const sim::Plant before = grown(plain).plants[0];
  ASSERT_GT(before.skeleton.size(), 10);
  ASSERT_GT(before.elements.size(), 5u);
  for (Value Bias::*const weight : {&Bias::gravity, &Bias::light, &Bias::away, &Bias::toward, &Bias::twist}) {
    for (const Value& none :
         {Value(0.0), tests::range(0.0, 0.0), curve(Over::age, 0.0), curve(Over::exposure, 0.0)}) {
      RuleSet more = plain;
      more.bias.*weight = none;
      expectSame(before, grown(more).plants[0], "a bias");
    }
    RuleSet more = plain;
    more.bias.*weight = tests::range(0.0, 0.5);  // this test can tell
    EXPECT_NE(before.skeleton.position_vx, grown(more).plants[0].skeleton.position_vx);
  }
}

TEST(Draws, AnElementThatIsNeverPlacedChangesNothing) {
  const RuleSet plain = lively();
  RuleSet more = plain;
  more.elements.push_back(plain.elements[0]);
  more.elements.back().name = "flower";
  more.elements.back().per_segment = 0.0;
  const sim::Growth before = grown(plain), after = grown(more);
  EXPECT_EQ(after.plants[0].shapes.size(), 2u);
  expectSame(before.plants[0], after.plants[0], "a flower");
}

TEST(Draws, AnElementMoreChangesNothingOfTheSegment) {
  RuleSet more = lively();
  more.elements.push_back(more.elements[0]);
  more.elements.back().per_segment = 3.0;
  const sim::Plant before = grown(lively(), 1).plants[0], after = grown(more, 1).plants[0];
  ASSERT_EQ(before.skeleton.size(), 2);
  EXPECT_EQ(before.skeleton.position_vx, after.skeleton.position_vx);
  ASSERT_GT(after.elements.size(), before.elements.size());
  for (std::size_t i = 0; i < before.elements.size(); ++i)
    EXPECT_EQ(before.elements[i].position_vx, after.elements[i].position_vx);
}

/// Two yards with a wall to the sky between them: neither sees the other's light, nor feels its mass.
sim::World twoYards() {
  sim::World world({sim::Vec3(0.0), 0.04, {61, 24, 24}});
  tests::addBox(world, "soil", {0, 0, 0}, {60, 0, 23});
  tests::addBox(world, "brick", {24, 1, 0}, {36, 23, 23});
  world.setLayers(4);
  return world;
}

TEST(Draws, PlantsThatDoNotMeetDoNotKnowOfEachOther) {
  const auto grow = [](const std::function<std::vector<sim::Planting>(const sim::World&)>& plantings) {
    sim::World world = twoYards();
    return sim::grow(world, plantings(world), tests::brightSettings(8));
  };
  const sim::Vec3 here(39, 2, 12), there(21, 2, 16), beside(20, 2, 5);
  const sim::Growth alone = grow([&](const auto& w) { return tests::planting(w, lively(), {here}); });
  ASSERT_GT(alone.plants[0].skeleton.size(), 10);
  ASSERT_GT(alone.plants[0].elements.size(), 5u);
  const sim::Growth seeded = grow([&](const auto& w) {
    return tests::planting(w, lively(), {there, beside, here});
  });
  ASSERT_GT(seeded.plants[0].skeleton.size(), 5);
  expectSame(alone.plants[0], seeded.plants[2], "two seeds more");
  const sim::Growth planted = grow([&](const auto& w) {
    auto all = tests::planting(w, lively(), {there, beside}, "ivy");
    all.push_back(tests::planting(w, lively(), {here})[0]);
    return all;
  });
  ASSERT_GT(planted.plants[0].skeleton.size(), 5);
  expectSame(alone.plants[0], planted.plants[2], "a planting more");
  EXPECT_NE(seeded.plants[0].skeleton.position_vx, planted.plants[0].skeleton.position_vx);  // by its name
}

/// Calls with each of a struct's keys that hold a number which may be a range, and the struct.
void forEachValue(const Table& table, void* object, const std::string& prefix,
                  const std::function<void(const std::string&, const Key&, void*)>& visit) {
  for (const Key& key : table.keys) {
    if (key.kind == Kind::value || key.kind == Kind::length || key.kind == Kind::size ||
        key.kind == Kind::whole_range)
      visit(prefix + key.name, key, object);
    if (key.kind == Kind::section) forEachValue(*key.child, key.open(object), prefix + key.name + ".", visit);
    if (key.kind == Kind::entries) {
      for (const Item& item : key.items(object))
        forEachValue(*key.child, const_cast<void*>(item.object), prefix + key.name + "[].", visit);
    }
  }
}

TEST(Draws, ARangeOfOneNumberIsThatNumber) {
  RuleSet plain = lively();
  plain.random_tree.branch_age_min = plain.random_tree.branch_age_max = 2;
  plain.elements.at(0).phyllotaxis.emplace();
  const sim::Plant before = grown(plain).plants[0];
  ASSERT_GT(before.skeleton.size(), 10);
  int values = 0;
  RuleSet ranges = plain;
  forEachValue(ruleTable(), &ranges, "", [&](const std::string& path, const Key& key, void* object) {
    const Datum datum = key.get(object);
    Datum changed = datum;
    if (auto* const value = std::get_if<Value>(&changed)) value->kind = Value::Kind::range;
    if (auto* const length = std::get_if<Length>(&changed)) length->value.kind = Value::Kind::range;
    if (std::holds_alternative<std::monostate>(datum)) return;  // of those that may be missing
    ++values;
    key.set(object, changed);
    expectSame(before, grown(ranges).plants[0], path);
    key.set(object, datum);
  });
  EXPECT_GE(values, 13);
}

TEST(Draws, TenThousandTrialsAreAllDifferent) {
  RuleSet rules = tests::failing();
  rules.random_tree.trials_min = rules.random_tree.trials_max = 10'000;
  rules.otherwise = std::make_shared<RuleSet>(rules);
  sim::World world = tests::wallPlot();
  auto settings = tests::brightSettings(1);
  settings.record_attempts = true;
  const auto growth = sim::grow(world, tests::planting(world, rules, {tests::kOpenSeed}), settings);
  std::set<std::pair<double, double>> ends;
  for (const auto& attempt : growth.attempts) ends.insert({attempt.to_vx.x, attempt.to_vx.z});
  EXPECT_GT(ends.size(), 19'990u);  // two may fall on one place of the lattice
}

TEST(Draws, ARangeOfOneQuantityMovesNoOther) {
  const auto firstTrials = [](const RuleSet& rules) {
    sim::World world = tests::wallPlot();
    auto settings = tests::brightSettings(1);
    settings.record_attempts = true;
    return sim::grow(world, tests::planting(world, rules, {tests::kOpenSeed}), settings).attempts;
  };
  RuleSet rules = lively();
  rules.random_tree.trials_min = 20;
  rules.random_tree.trials_max = 20;
  RuleSet longer = rules;
  longer.random_tree.length = {tests::range(2.0, 4.0)};
  const auto a = firstTrials(rules), b = firstTrials(longer);
  ASSERT_EQ(a.size(), 20u);  // each trial once, the one that was taken too
  ASSERT_EQ(b.size(), 20u);
  double least = 9.0, most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const sim::Vec3 way_a = a[i].to_vx - a[i].from_vx, way_b = b[i].to_vx - b[i].from_vx;
    EXPECT_NEAR(glm::dot(glm::normalize(way_a), glm::normalize(way_b)), 1.0, 1e-7);
    least = std::min(least, glm::length(way_b));
    most = std::max(most, glm::length(way_b));
  }
  EXPECT_GT(most - least, 1.0);
  EXPECT_EQ(std::count_if(a.begin(), a.end(), [](const auto& attempt) { return attempt.taken; }), 1);
}

}  // namespace
}  // namespace espalier::rules
