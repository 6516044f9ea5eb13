#include "rules/growth/voxel_widths.h"

#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "tests/support/lively.h"
#include "tests/support/plots.h"

namespace espalier::rules {
namespace {

constexpr double kVoxel = 0.02;

RuleSet inMetres() {
  RuleSet rules;
  rules.name = "metric";
  rules.random_tree.length = {tests::range(0.04, 0.06), true};
  rules.bias.twist_radius = {0.3, true};
  rules.require.proximity_min = {0.01, true};
  rules.require.proximity_max = {0.08, true};
  rules.prefer = {true, {0.03, true}};
  rules.stem.radius = {0.002, true};
  Element sized;
  sized.size = 0.06;
  sized.size_metres = true;
  sized.polygons = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  Element drawn;
  drawn.name = "drawn";
  drawn.size = 1.5;
  drawn.polygons = {{{0, 0, 0}, {0.02, 0, 0}, {0, 0.04, 0}}};
  drawn.polygons_metres = true;
  rules.elements = {sized, drawn};
  return rules;
}

std::shared_ptr<RuleSet> sharedCopy(const RuleSet& rules) {
  return std::make_shared<RuleSet>(rules);
}

std::string complaint(const RuleSet& rules, double voxel_m = kVoxel) {
  try {
    inVoxelWidths(sharedCopy(rules), voxel_m);
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(VoxelWidths, DividesEveryLengthByTheVoxel) {
  const auto rules = inVoxelWidths(sharedCopy(inMetres()), kVoxel);
  EXPECT_EQ(rules->random_tree.length, (Length{tests::range(2.0, 3.0)}));
  EXPECT_EQ(rules->bias.twist_radius, Distance{15.0});
  EXPECT_EQ(rules->require.proximity_min, Distance{0.5});
  EXPECT_EQ(rules->require.proximity_max, Distance{4.0});
  EXPECT_EQ(rules->prefer.proximity, Distance{1.5});
  EXPECT_EQ(rules->stem.radius, Distance{0.1});
  EXPECT_EQ(rules->elements[0].size, Value(3.0));
  EXPECT_EQ(rules->elements[0].polygons, inMetres().elements[0].polygons) << "multiples of the size";
  EXPECT_EQ(rules->elements[1].size, Value(1.5));
  EXPECT_EQ(rules->elements[1].polygons[0][2], sim::Vec3(0, 2, 0));
  EXPECT_FALSE(rules->elements[0].size_metres || rules->elements[1].polygons_metres);
}

TEST(VoxelWidths, LeavesPlainNumbersAsTheyAre) {
  const RuleSet plain = tests::lively();
  for (const double voxel_m : {0.01, 0.3}) {
    const auto rules = inVoxelWidths(sharedCopy(plain), voxel_m);
    EXPECT_EQ(rules->random_tree.length, plain.random_tree.length);
    EXPECT_EQ(rules->require.proximity_max, plain.require.proximity_max);
    EXPECT_EQ(rules->bias.twist_radius, plain.bias.twist_radius);
    EXPECT_EQ(rules->elements[0].size, plain.elements[0].size);
    EXPECT_EQ(rules->elements[0].polygons, plain.elements[0].polygons);
  }
}

TEST(VoxelWidths, GoesWhereverTheBookLeadsAndASharedSetStaysOne) {
  const auto brick = sharedCopy(inMetres());
  const auto top = sharedCopy(inMetres());
  top->regions["brick"] = top->regions["stone"] = {false, brick};
  top->regions["soil"] = {true, nullptr};
  top->others = RegionRule{false, brick};
  top->otherwise = sharedCopy(inMetres());
  const auto rules = inVoxelWidths(top, kVoxel);
  EXPECT_EQ(rules->regions.at("brick").rules, rules->regions.at("stone").rules);
  EXPECT_EQ(rules->regions.at("brick").rules, rules->others->rules);
  EXPECT_EQ(rules->others->rules->require.proximity_max, Distance{4.0});
  EXPECT_EQ(rules->otherwise->require.proximity_max, Distance{4.0});
  EXPECT_TRUE(rules->regions.at("soil").forbidden);
  EXPECT_EQ(brick->require.proximity_max, (Distance{0.08, true})) << "the rules themselves stay";
}

TEST(VoxelWidths, RefusesWhatSuchVoxelsCannotHold) {
  EXPECT_EQ(complaint(inMetres()), "");
  EXPECT_EQ(
      complaint(inMetres(), 0.0005),
      "rule set 'metric': random_tree.length is 80 to 120 voxel widths at a voxel of 0.0005 m; expected "
      "0.1 to 60");
  EXPECT_EQ(complaint(inMetres(), 0.004),
            "rule set 'metric': bias.twist.radius is 75 voxel widths at a voxel of 0.004 m; expected more "
            "than 0, at most 64");
  RuleSet thick = inMetres();
  thick.stem.radius = {3.0, true};
  EXPECT_EQ(
      complaint(thick),
      "rule set 'metric': stem.radius is 150 voxel widths at a voxel of 0.02 m; expected at least 1e-06, "
      "at most 100");
  RuleSet thin = inMetres();  // in single precision it would be as thick as nothing
  thin.stem.radius = {1e-300};
  EXPECT_EQ(
      complaint(thin),
      "rule set 'metric': stem.radius is 1e-300 voxel widths at a voxel of 0.02 m; expected at least 1e-06, "
      "at most 100");
  thin.stem.radius = {1e-6};
  EXPECT_EQ(complaint(thin), "");
  RuleSet crossed = inMetres();
  crossed.require.proximity_min = {4.5};
  EXPECT_EQ(
      complaint(crossed),
      "rule set 'metric': require.proximity.min is 4.5 and require.proximity.max is 4 voxel widths at a "
      "voxel of 0.02 m; expected the first to be less than the second");
  EXPECT_EQ(complaint(crossed, 0.01), "");
  RuleSet large = inMetres();
  large.elements[1].size = 1e5;
  EXPECT_EQ(complaint(large),
            "rule set 'metric': elements[1] has a corner 2e+05 voxel widths away at a voxel of 0.02 m; "
            "expected at most 100000");
  RuleSet top;
  top.otherwise = sharedCopy(crossed);
  EXPECT_EQ(complaint(top).find("rule set 'metric', otherwise: require.proximity.min is "), 0u);
}

/// A rule set in metres, and the same in voxel widths of 2 cm.
TEST(VoxelWidths, TheSamePlantGrowsOfNumbersAndOfLengths) {
  RuleSet numbers = tests::lively(), lengths = numbers;
  const double voxel_m = tests::wallPlot().frame().voxel_m;
  lengths.random_tree.length = {numbers.random_tree.length.value.low * voxel_m, true};
  lengths.bias.twist_radius = {numbers.bias.twist_radius.number * voxel_m, true};
  lengths.require.proximity_max = {numbers.require.proximity_max.number * voxel_m, true};
  lengths.prefer.proximity = {numbers.prefer.proximity.number * voxel_m, true};
  lengths.elements[0].size = voxel_m;
  lengths.elements[0].size_metres = true;
  const auto grown = [](const RuleSet& rules) {
    sim::World world = tests::wallPlot();
    return sim::grow(world, tests::planting(world, rules, {tests::kOpenSeed}), tests::brightSettings(8));
  };
  const auto a = grown(numbers).plants[0], b = grown(lengths).plants[0];
  ASSERT_GT(a.skeleton.size(), 15);
  ASSERT_EQ(a.skeleton.size(), b.skeleton.size());
  for (std::size_t i = 0; i < a.skeleton.position_vx.size(); ++i)
    EXPECT_NEAR(glm::distance(a.skeleton.position_vx[i], b.skeleton.position_vx[i]), 0.0, 1e-9);
  EXPECT_EQ(a.elements.size(), b.elements.size());
}

TEST(LayersNeeded, AreTheFarthestThatIsAskedAndOneMore) {
  const auto layers = [](const RuleSet& rules, double voxel_m = kVoxel) {
    return layersNeeded(rules, voxel_m, 500.0).layers;
  };
  RuleSet rules;
  EXPECT_EQ(layers(rules), 0) << "nothing is asked";
  rules.require.proximity_max = {3.0};
  EXPECT_EQ(layers(rules), 4);
  rules.require.proximity_max = {3.2};
  EXPECT_EQ(layers(rules), 5);
  rules.require.proximity_max = {0.07, true};
  EXPECT_EQ(layers(rules), 5);
  EXPECT_EQ(layers(rules, 0.01), 8) << "0.07 / 0.01 is a little more than 7 in binary";
  rules.prefer.proximity = {6.0};
  EXPECT_EQ(layers(rules), 5) << "nothing is preferred";
  rules.prefer.has_proximity = true;
  EXPECT_EQ(layers(rules), 7);
  rules.require.proximity_max = {};
  rules.require.proximity_min = {8.0};
  rules.require.proximity_max = {kNoLimit};
  EXPECT_EQ(layers(rules), 9);
  rules.require.proximity_max = {501.0};
  EXPECT_EQ(layers(rules), 9) << "as far as that no voxel is from another";
  RuleSet top;
  top.others = RegionRule{false, sharedCopy(rules)};
  EXPECT_EQ(layers(top), 9);
  EXPECT_EQ(layersNeeded(top, kVoxel, 500.0).asked_by,
            "rule set 'unnamed', regions.others: require.proximity.min is 8 voxel widths");
}

/// A square of so many voxel widths, so often on a segment, in full light so much larger and more often.
RuleSet squares(double side, double per_segment, double boost, std::size_t polygons = 1) {
  RuleSet rules;
  rules.name = "square";
  rules.light.boost = boost;
  Element square;
  square.per_segment = per_segment;
  square.polygons.assign(polygons, {{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}});
  rules.elements = {square};
  return rules;
}

TEST(VoxelWidths, ElementsOfASegmentAreBoundedBeforeAnyIsTiled) {
  EXPECT_EQ(complaint(squares(50, 100, 1.0)), "");
  EXPECT_EQ(complaint(squares(5, 100, 10.0)).find("rule set 'square': elements may take 5"), 0u)
      << "in full light ten times as many, ten times as long and wide";
  EXPECT_NE(complaint(squares(1000, 0.1, 1.0)), "") << "one may come, however seldom";
  EXPECT_NE(complaint(squares(100, 1, 1.0, 256)), "");
  EXPECT_EQ(complaint(squares(1000, 100, 10.0)),
            "rule set 'square': elements may take 2e+11 voxels on one segment at a voxel of 0.02 m in full "
            "light, most of them elements[0] (size, polygons, per_segment, light.boost); expected at most "
            "1000000");
  RuleSet curved = squares(1, 1, 1.0);
  curved.elements[0].size.kind = Value::Kind::curve;
  curved.elements[0].size.curve = {{0.0, 1.0}, {0.9, 1.0}, {1.0, 2000.0}};
  EXPECT_NE(complaint(curved), "") << "large only where the curve says so";
  RuleSet many = squares(100, 1, 1.0);
  many.elements.resize(64, many.elements[0]);
  EXPECT_NE(complaint(many), "") << "together";
  RuleSet hidden;
  hidden.name = "top";
  hidden.otherwise = sharedCopy(squares(2000, 1, 1.0));
  EXPECT_EQ(complaint(hidden).find("rule set 'square', otherwise: elements may take"), 0u);
}

TEST(VoxelWidths, AnElementThatHasNoRoomInTheWorldIsRefused) {
  const sim::Frame frame{{0, 0, 0}, kVoxel, {30, 40, 120}};  // 130 from corner to corner
  EXPECT_NO_THROW(requireElementsFit(squares(129, 1, 1.0), frame));
  try {
    requireElementsFit(squares(131, 1, 1.0), frame);
    FAIL();
  } catch (const sim::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "rule set 'square': elements[0] is at least 131 voxel widths long at a voxel of 0.02 m, and "
                 "nothing longer than 130 has room in this world of 30 x 40 x 120 voxels");
  }
  RuleSet in_the_dark = squares(250, 1, 0.5);  // half as long in full light
  EXPECT_NO_THROW(requireElementsFit(in_the_dark, frame));
  RuleSet hidden;
  hidden.otherwise = sharedCopy(squares(131, 1, 1.0));
  EXPECT_THROW(requireElementsFit(hidden, frame), sim::InputError);
}

}  // namespace
}  // namespace espalier::rules
