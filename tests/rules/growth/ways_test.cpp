#include "rules/growth/ways.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "sim/sweep/lanes.h"
#include "tests/support/lively.h"
#include "tests/support/plain_trials.h"
#include "tests/support/plots.h"

/// Trials in lanes against trials one by one, bit for bit, with every vector instruction set that this
/// processor has.
namespace espalier::rules {
namespace {

sim::Vec3 anyUnit(std::mt19937& random) {
  const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
  const double x = number(), y = number(), z = number();
  return glm::normalize(sim::Vec3(x, y, z) + sim::Vec3(1e-3));
}

/// Of two points to as many as may be, with gaps.
std::vector<glm::dvec2> anyTable(std::mt19937& random) {
  std::vector<glm::dvec2> table;
  double share = 0.0;
  for (std::size_t left = random() % 4 == 0 ? kMostAngles : 2 + random() % 5; left > 0; --left) {
    share += (1.0 + static_cast<double>(random() % 1000)) / 2000.0;
    table.emplace_back(share, random() % 3 == 0 ? 0.0 : static_cast<double>(random() % 1000));
  }
  table.back().y = 1.0;
  return table;
}

/// Rules in which each quantity is a number, a range, or nothing.
RuleSet anyRules(std::mt19937& random) {
  const auto any = [&](double low, double high) {
    switch (random() % 3) {
      case 0:
        return Value(low);
      case 1:
        return Value(high);
      default:
        return tests::range(low, high);
    }
  };
  RuleSet rules;
  rules.random_tree.length = {any(0.5, 7.5)};
  rules.random_tree.wander_deg = any(0.0, 180.0);
  constexpr std::array kDistributions{AngleDistribution::cone, AngleDistribution::cone,
                                      AngleDistribution::gaussian, AngleDistribution::table};
  rules.random_tree.wander_distribution = kDistributions[random() % kDistributions.size()];
  if (rules.random_tree.distribution() == AngleDistribution::table)
    rules.random_tree.wander_table = anyTable(random);
  rules.random_tree.branch_angle_deg = any(0.0, 180.0);
  rules.random_tree.trials_min = 1 + static_cast<int>(random() % 100);
  rules.random_tree.trials_max = rules.random_tree.trials_min + static_cast<int>(random() % 100);
  rules.bias.up = any(0.0, 0.4);
  rules.bias.gravity = any(0.0, 1.0);
  rules.bias.light = any(0.0, 0.9);
  rules.bias.away = any(0.0, 0.3);
  rules.bias.toward = any(0.0, 0.3);
  rules.bias.twist = any(-1.0, 1.0);
  if (random() % 2 == 0) rules.require.proximity_max = {3.0};
  if (random() % 3 == 0) rules.require.proximity_min = {1.2};
  if (random() % 2 == 0) rules.prefer = {true, {1.7}};
  rules.require.clear = random() % 4 != 0;
  return rules;
}

Surroundings anySurroundings(std::mt19937& random, sim::Vec3 at_vx) {
  Surroundings around;
  around.at_vx = at_vx;
  around.voxel = sim::voxelAt(at_vx);
  if (random() % 5 != 0) around.heading = random() % 5 == 0 ? sim::Vec3(0, 1, 0) : anyUnit(random);
  if (random() % 4 != 0) around.away = anyUnit(random);
  return around;
}

Senses anySenses(std::mt19937& random) {
  Senses senses;
  if (random() % 4 != 0) senses.light = anyUnit(random);
  if (random() % 4 != 0) senses.twist = anyUnit(random);
  senses.circumstance = {0.5, 3.0, 0.4};
  return senses;
}

class Levels : public ::testing::Test {
 protected:
  void TearDown() override { sim::lanes::useLevel(sim::lanes::levels().front()); }
};

TEST_F(Levels, TrialsInLanesEndWherePlainOnesDo) {
  for (const std::string& level : sim::lanes::levels()) {
    sim::lanes::useLevel(level);
    std::mt19937 random(5);
    for (int round = 0; round < 300; ++round) {
      const RuleSet rules = anyRules(random);
      const Surroundings around = anySurroundings(random, {20.3, 11.0, 7.7});
      const sim::RandomKey key{random(), static_cast<std::uint32_t>(random()),
                               static_cast<std::uint32_t>(random() % 3),
                               static_cast<std::uint32_t>(random() % 100)};
      const auto set = static_cast<unsigned>(random() % 3);
      const sim::Voxel size = random() % 5 == 0 ? sim::Voxel(50, 1, 50) : sim::Voxel(50, 40, 50);
      const Ways ways = waysOf(rules, around, anySenses(random), key, set, size);
      sim::Offsets ends;
      const auto first = static_cast<unsigned>(random() % 150);
      const std::size_t count = 1 + random() % sim::Offsets::kMost;
      trialEnds(ways, first, count, ends);
      for (std::size_t i = 0; i < count; ++i) {
        const sim::Fixed plain = tests::plainTrialEnd(ways, key, set, static_cast<int>(first + i));
        ASSERT_EQ(plain, sim::Fixed(ends.x[i], ends.y[i], ends.z[i]))
            << level << ", round " << round << ", trial " << first + i;
      }
    }
  }
}

TEST_F(Levels, TheBestOfManyIsTheBestOfThemOneByOne) {
  sim::World world = tests::wallPlot();
  std::mt19937 strewn(3);
  std::vector<sim::TiledVoxel> twigs;
  const sim::PartId twig = world.addPart({"vine", "stem", sim::PartKind::stem, 0});
  for (int i = 0; i < 9000; ++i) {
    const int x = static_cast<int>(strewn() % 48), y = static_cast<int>(strewn() % 48),
              z = static_cast<int>(strewn() % 40);
    twigs.push_back({{x, y, z}, {twig, sim::Colour(0.1f), 0.2f}});
  }
  world.occupy(twigs);
  sim::Plant plant;
  sim::Kin kin;
  sim::Columns memory;
  sim::Commons commons;
  const sim::PieceGrid pieces(world.frame().size);
  const sim::SiteView view{world, plant, kin, memory, commons, pieces};
  for (const std::string& level : sim::lanes::levels()) {
    sim::lanes::useLevel(level);
    std::mt19937 random(9);
    int found = 0;
    for (int round = 0; round < 200; ++round) {
      const RuleSet rules = anyRules(random);
      const auto along = [&](unsigned size) {
        return static_cast<double>(random() % (4096 * (size - 1))) / 4096.0;
      };
      const double x = along(48), y = along(48), z = along(40);
      Surroundings around = anySurroundings(random, {x, y, z});
      around.attachment = {around.voxel, around.voxel + sim::Voxel(0, 1, 0),
                           around.voxel - sim::Voxel(9, 0, 0)};
      const Senses senses = anySenses(random);
      const sim::RandomKey key{1, static_cast<std::uint32_t>(round), 0, 0};
      sim::Proposal proposal;
      sim::OutcomeCounts plain_trials{};
      const auto plain = tests::plainBestTrial(view, rules, around, senses, key, 0, plain_trials);
      const auto best = bestStep(view, rules, around, senses, key, 0, proposal);
      ASSERT_EQ(proposal.trials, plain_trials) << level << ", round " << round;
      ASSERT_EQ(best.has_value(), plain.has_value()) << level << ", round " << round;
      if (!best) continue;
      ++found;
      EXPECT_EQ(best->to_vx, plain->to_vx);
      EXPECT_EQ(best->proximity_vx, plain->proximity_vx);
      EXPECT_FALSE(best->takes.empty());
      EXPECT_EQ(sim::voxelAt(best->to_vx), best->passes.back());
    }
    EXPECT_GT(found, 20);
    EXPECT_LT(found, 190);
  }
}

}  // namespace
}  // namespace espalier::rules
