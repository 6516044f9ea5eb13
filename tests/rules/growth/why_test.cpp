// Why here: a site of a saved state asked again.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "rules/growth/make_process.h"
#include "sim/grow/grow.h"
#include "sim/grow/state.h"
#include "sim/light/sky.h"
#include "sim/light/sun.h"
#include "tests/support/plots.h"

namespace espalier {
namespace {

using sim::Outcome;

rules::RuleSet climber() {
  rules::RuleSet rules;
  rules.random_tree.trials_min = 20;
  rules.random_tree.trials_max = 40;
  rules.require.proximity_max = {3.0};
  rules.require.exposure_min = 0.2;
  rules.prefer = {true, {1.5}};
  return rules;
}

std::vector<sim::Planting> plantings(const sim::Frame& frame) {
  return {{"vine", rules::makeProcess(std::make_shared<rules::RuleSet>(climber()), frame.voxel_m),
           sim::seedsAt(frame, {{12, 2, 23}, {30, 2, 23}})}};
}

sim::GrowthSettings settings(int iterations) {
  sim::GrowthSettings s;
  s.iterations = iterations;
  s.light.sky = sim::makeSky({.directions = 64}).directions;
  s.light.sun = sim::makeSun({20.0, 180.0, 24}).directions;
  return s;
}

TEST(Why, EverySiteOfASavedStateTellsItsTrialsAndGrowsAsItSays) {
  sim::World grown = tests::wallPlot();
  const sim::BitVolume site = grown.occupied();
  const auto growth = sim::grow(grown, plantings(grown.frame()), settings(12));
  const std::string bytes = sim::stateBytes({}, grown, site, growth);

  sim::World world = tests::wallPlot();
  const auto planted = plantings(world.frame());
  sim::Growing growing(world, planted, settings(13),
                       sim::restore(sim::readState(bytes, "f"), world, planted, "f"));
  const sim::Due due = growing.due();
  const auto& sites = due.sites.front();
  ASSERT_GT(sites.size(), 20u);
  std::map<Outcome, std::size_t> met;
  for (const sim::Site& s : sites) {
    const sim::Proposal proposal = growing.propose(due, 0, s);
    sim::OutcomeCounts told{};
    std::size_t taken = 0;
    for (const sim::Attempt& attempt : proposal.attempts) {
      ++told[static_cast<std::size_t>(attempt.outcome)];
      taken += attempt.taken ? 1u : 0u;
      EXPECT_EQ(attempt.from_vx, s.at_vx);
      if (attempt.taken) {
        EXPECT_EQ(attempt.to_vx, proposal.segment->to_vx);
      }
    }
    EXPECT_EQ(told, proposal.trials);
    EXPECT_EQ(taken, proposal.outcome == Outcome::grown ? 1u : 0u);
    ++met[proposal.outcome];
    if (proposal.outcome == Outcome::no_trial) {
      EXPECT_EQ(proposal.attempts.size(), 40u);
      EXPECT_EQ(told[static_cast<std::size_t>(Outcome::grown)], 0u);
    }
  }
  EXPECT_GT(met[Outcome::grown], 5u);
  EXPECT_GT(met[Outcome::no_trial] + met[Outcome::too_dark], 3u);

  const auto before = sim::total(growing.growth());
  ASSERT_TRUE(growing.step());
  const auto after = sim::total(growing.growth());
  const auto more = [&](Outcome outcome) {
    return after.sites[static_cast<std::size_t>(outcome)] - before.sites[static_cast<std::size_t>(outcome)];
  };
  for (const Outcome outcome : {Outcome::no_trial, Outcome::too_dark, Outcome::too_bright, Outcome::resting})
    EXPECT_EQ(more(outcome), met[outcome]) << sim::nameOf(outcome);
  EXPECT_EQ(more(Outcome::grown) + more(Outcome::claimed), met[Outcome::grown]);
}

}  // namespace
}  // namespace espalier
