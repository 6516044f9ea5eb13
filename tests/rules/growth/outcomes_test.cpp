#include <gtest/gtest.h>

#include "rules/growth/buds.h"
#include "rules/growth/make_process.h"
#include "sim/base/error.h"
#include "sim/grow/grow.h"
#include "tests/support/lively.h"
#include "tests/support/plots.h"

/// What becomes of a site under several rule sets.
namespace espalier::rules {
namespace {

using sim::Outcome;
using tests::failing;
using tests::lively;

struct Outcomes {
  sim::OutcomeCounts sites;
  int segments = 0;
  std::size_t alive = 0;
  std::uint64_t hash = 0;
  std::uint64_t of(Outcome outcome) const { return sites[static_cast<std::size_t>(outcome)]; }
};

Outcomes outcomesOf(const RuleSet& rules, int iterations, sim::Vec3 seed = tests::kOpenSeed) {
  sim::World world = tests::wallPlot();
  sim::Growing growing(world, tests::planting(world, rules, {seed}), tests::brightSettings(iterations));
  while (growing.step()) {
  }
  const sim::Growth& growth = growing.growth();
  return {sim::total(growth).sites, growth.plants[0].skeleton.size() - 1, growing.alive(),
          sim::stateHash(world, growth)};
}

RuleSet tooDark() {
  RuleSet rules = lively();
  rules.require.exposure_min = 0.999;
  return rules;
}

RuleSet tooBright() {
  RuleSet rules = lively();
  rules.require.exposure_max = 0.001;
  return rules;
}

RuleSet withOtherwise(RuleSet first, RuleSet second) {
  first.otherwise = std::make_shared<RuleSet>(std::move(second));
  return first;
}

TEST(Outcomes, ASetFailsWhereItIsTooDarkOrTooBrightOrNoTrialIsGood) {
  for (const RuleSet& first : {tooDark(), tooBright(), failing()}) {
    EXPECT_EQ(outcomesOf(first, 4).segments, 0);
    EXPECT_GT(outcomesOf(withOtherwise(first, lively()), 4).segments, 1);
    EXPECT_GT(outcomesOf(withOtherwise(first, withOtherwise(failing(), lively())), 4).segments, 1);
  }
}

TEST(Outcomes, SayWhyASiteDidNotGrow) {
  const auto why = [](const RuleSet& rules) {
    const Outcomes result = outcomesOf(rules, 1);
    for (std::size_t k = 0; k < sim::kOutcomes; ++k) {
      if (result.sites[k] > 0) return static_cast<Outcome>(k);
    }
    return Outcome::grown;
  };
  EXPECT_EQ(why(tooDark()), Outcome::too_dark);
  EXPECT_EQ(why(tooBright()), Outcome::too_bright);
  EXPECT_EQ(why(failing()), Outcome::no_trial);
  EXPECT_EQ(why(withOtherwise(tooDark(), tooBright())), Outcome::too_dark);  // the first set's word
  EXPECT_EQ(why(withOtherwise(tooDark(), failing())), Outcome::no_trial);    // which got farther
  EXPECT_EQ(why(withOtherwise(failing(), tooDark())), Outcome::no_trial);
  RuleSet forbids = lively();
  forbids.others = RegionRule{true, nullptr};
  EXPECT_EQ(why(forbids), Outcome::forbidden);
  EXPECT_EQ(why(withOtherwise(tooDark(), forbids)), Outcome::too_dark);
  EXPECT_EQ(why(withOtherwise(forbids, lively())), Outcome::forbidden);  // ends it: otherwise is not tried
}

TEST(Outcomes, RestingDoesNotGoOnToOtherwise) {
  RuleSet first = lively();
  first.light.boost = 6.0;
  first.bias = {};  // with this and what follows it never fails, so far from the world's rim
  first.require = {};
  first.require.clear = false;
  first.random_tree.trials_max = 300;
  const auto grownFar = [](const RuleSet& rules) { return outcomesOf(rules, 4, {24, 16, 27}); };
  const Outcomes alone = grownFar(first);
  EXPECT_GT(alone.of(Outcome::resting), 0u);
  EXPECT_EQ(alone.of(Outcome::no_trial), 0u);
  RuleSet other = lively();
  other.random_tree.length = {5.0};
  EXPECT_EQ(alone.hash, grownFar(withOtherwise(first, other)).hash);
  EXPECT_NE(alone.hash, grownFar(withOtherwise(other, first)).hash);  // were it tried first, that would show
}

TEST(Outcomes, ASecondSetMayRestInThePlaceOfTheFirst) {
  RuleSet second = lively();
  second.light.boost = 10.0;
  const Outcomes result = outcomesOf(withOtherwise(tooDark(), second), 5);
  EXPECT_GT(result.of(Outcome::resting), 0u);
  EXPECT_EQ(result.of(Outcome::too_dark), 0u);
  EXPECT_GT(result.alive, 0u);
}

TEST(Outcomes, ElementsAreThoseOfTheSetThatGrew) {
  RuleSet first = failing(), second = lively();
  first.elements.assign(2, second.elements[0]);
  sim::World world = tests::wallPlot();
  const auto growth =
      sim::grow(world, tests::planting(world, withOtherwise(first, second), {tests::kOpenSeed}),
                tests::brightSettings(5));
  ASSERT_GT(growth.plants[0].elements.size(), 3u);
  for (const auto& element : growth.plants[0].elements) EXPECT_EQ(element.shape, 2);
}

TEST(Outcomes, ASeedThatFoundNoWayTriesAgainAndNoOther) {
  const Outcomes failed = outcomesOf(failing(), 5);
  EXPECT_EQ(failed.of(Outcome::no_trial), 5u);
  EXPECT_EQ(failed.alive, 1u);
  const Outcomes dark = outcomesOf(tooDark(), 5);
  EXPECT_EQ(dark.of(Outcome::too_dark), 1u);
  EXPECT_EQ(dark.alive, 0u);
  // Buds that are no seeds retire: up along the column of light, and no farther than the roof.
  RuleSet up = lively();
  up.bias = {};
  up.bias.up = 1.0;
  up.prefer = {};
  up.require = {};
  up.elements.clear();
  up.light.boost = 1.0;
  up.random_tree.branch_age_min = up.random_tree.branch_age_max = 100;
  const Outcomes ended = outcomesOf(up, 40);
  EXPECT_EQ(ended.of(Outcome::no_trial), 1u);
  EXPECT_EQ(ended.segments, 18);  // of 2.4 in 45.5 voxel widths
}

sim::Verdict verdict(const sim::Site& site, const sim::Proposal& proposal, Outcome outcome,
                     sim::NodeId node = sim::kNoNode) {
  return {site, &proposal, outcome, node};
}

/// A plant of a chain of nodes.
struct Chain {
  explicit Chain(int nodes) : world({sim::Vec3(0.0), 0.04, {40, 40, 40}}) {
    for (int i = 0; i < nodes; ++i) {
      plant.skeleton.parent.push_back(i - 1);
      plant.skeleton.position_vx.push_back({2.0 * i, 1, 1});
      plant.skeleton.born.push_back(i);
    }
    kin = sim::Kin(plant.skeleton);
  }
  sim::StandView at(int iteration) const { return {world, {&plant, 1}, {&kin, 1}, iteration}; }

  sim::World world;
  sim::Plant plant;
  sim::Kin kin;
};

TEST(Buds, SproutWhenTheyGrewAndRetireOrWaitWhenNot) {
  const Chain chain(4);
  sim::Columns memory;
  beginBuds(chain.at(0), memory);
  const std::vector<sim::Site> seed = dueBuds(chain.at(0), memory);
  ASSERT_EQ(seed, (std::vector<sim::Site>{{0, 0, 0, {0, 1, 1}}}));

  sim::Proposal grew;
  grew.outcome = Outcome::grown;
  grew.sprouts = {{0, 1}, {1, 3}};
  settleBuds(chain.at(0), std::vector{verdict(seed[0], grew, Outcome::grown, 1)}, memory);
  EXPECT_EQ(countBuds(memory), 2u);
  const sim::Site tip{0, 1, 0, {2, 1, 1}}, side{0, 1, 1, {2, 1, 1}};
  EXPECT_EQ(dueBuds(chain.at(1), memory), std::vector{tip});

  // Another took its voxels first: it tries again, though its proposal would retire it.
  settleBuds(chain.at(1), std::vector{verdict(tip, grew, Outcome::claimed)}, memory);
  EXPECT_EQ(dueBuds(chain.at(2), memory), std::vector{tip});
  sim::Proposal rests;
  rests.outcome = Outcome::resting;
  rests.retire = false;
  settleBuds(chain.at(2), std::vector{verdict(tip, rests, Outcome::resting)}, memory);
  EXPECT_EQ(dueBuds(chain.at(3), memory), (std::vector{tip, side}));
  sim::Proposal failed;
  settleBuds(chain.at(3),
             std::vector{verdict(tip, failed, Outcome::no_trial), verdict(side, failed, Outcome::no_trial)},
             memory);
  EXPECT_EQ(countBuds(memory), 0u);
}

TEST(Buds, OfASingleSegmentThatFoundNoWayLeaveItToTheSeed) {
  const Chain chain(2);
  sim::Columns memory;
  beginBuds(chain.at(0), memory);
  const sim::Site seed = dueBuds(chain.at(0), memory)[0];
  sim::Proposal grew, failed;
  grew.outcome = Outcome::grown;
  grew.sprouts = {{0, 1}, {1, 3}};
  settleBuds(chain.at(0), std::vector{verdict(seed, grew, Outcome::grown, 1)}, memory);
  const sim::Site tip{0, 1, 0, {2, 1, 1}}, side{0, 1, 1, {2, 1, 1}};
  settleBuds(chain.at(1), std::vector{verdict(tip, failed, Outcome::no_trial)}, memory);
  EXPECT_EQ(dueBuds(chain.at(3), memory), std::vector{side});  // it may find one yet
  settleBuds(chain.at(3), std::vector{verdict(side, failed, Outcome::no_trial)}, memory);
  EXPECT_EQ(dueBuds(chain.at(3), memory), std::vector<sim::Site>{});
  EXPECT_EQ(dueBuds(chain.at(4), memory), std::vector{seed});
  // In the dark another segment would be as dark.
  settleBuds(chain.at(4), std::vector{verdict(seed, grew, Outcome::grown, 1)}, memory);
  settleBuds(chain.at(7),
             std::vector{verdict(tip, failed, Outcome::too_dark), verdict(side, failed, Outcome::too_dark)},
             memory);
  EXPECT_EQ(countBuds(memory), 0u);
}

TEST(Buds, OfAForeignMemoryAreRefused) {
  const Chain chain(2);
  sim::Columns memory;
  beginBuds(chain.at(0), memory);
  sim::column<std::int32_t>(memory, "bud_node") = {2};
  EXPECT_THROW(dueBuds(chain.at(0), memory), sim::BrokenContract);
  sim::column<std::int32_t>(memory, "bud_node") = {1};
  EXPECT_NO_THROW(dueBuds(chain.at(0), memory));
  sim::column<std::int32_t>(memory, "bud_number") = {-1};
  EXPECT_THROW(dueBuds(chain.at(0), memory), sim::BrokenContract);
  sim::column<std::int32_t>(memory, "bud_number") = {};
  EXPECT_THROW(dueBuds(chain.at(0), memory), sim::BrokenContract);
}

}  // namespace
}  // namespace espalier::rules
