#include "scenes/job/seed_failure.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "rules/growth/make_process.h"
#include "scenes/job/seed_failure_words.h"
#include "sim/light/sky.h"
#include "tests/support/plots.h"

namespace espalier::scenes {
namespace {

using sim::Outcome;

/// Seeds in a plot of soil and a wall of brick, grown for six iterations.
class SeedFailures : public testing::Test {
 protected:
  SeedFailures() {
    rules_.random_tree.trials_min = 10;
    rules_.random_tree.trials_max = 20;
  }
  std::vector<std::optional<SeedFailure>> grown(const std::vector<sim::Vec3>& seeds_vx) {
    const auto rules = std::make_shared<const rules::RuleSet>(rules_);
    const std::vector<sim::Planting> plantings = {
        {"vine", rules::makeProcess(rules, world_.frame().voxel_m), sim::seedsAt(world_.frame(), seeds_vx)}};
    sim::GrowthSettings settings;
    settings.iterations = 6;
    settings.light.sky = sim::makeSky({.directions = 200}).directions;
    const sim::BitVolume scene = world_.occupied();
    const auto lights = lightOfSeeds(plantings, world_, settings.light);
    const sim::Growth growth = sim::grow(world_, plantings, settings);
    return seedFailures(rules, world_, scene, growth.plants, growth.tallies, lights);
  }
  SeedFailure failureAt(sim::Vec3 seed_vx) {
    const auto failures = grown({seed_vx});
    EXPECT_TRUE(failures.front());
    return failures.front().value_or(SeedFailure());
  }

  rules::RuleSet rules_;
  sim::World world_ = tests::wallPlot();
};

std::string startOf(const std::string& text) {
  return text.substr(0, text.find(" ("));
}

TEST_F(SeedFailures, NothingIsSaidOfOneThatGrew) {
  const auto failures = grown({{12, 2, 30}, {30, 2, 30}});
  ASSERT_EQ(failures.size(), 2u);
  EXPECT_FALSE(failures[0]);
  EXPECT_FALSE(failures[1]);
}

TEST_F(SeedFailures, TooFarNamesTheDistanceOfTheNearestWall) {
  rules_.require.proximity_max = {3.0};
  const SeedFailure failure = failureAt({20, 13, 37});
  EXPECT_EQ(failure.reason, Outcome::too_far);
  EXPECT_EQ(failure.region, "");  // beyond the boundary layers
  ASSERT_TRUE(failure.wall_vx);
  EXPECT_EQ(*failure.wall_vx, 13.0);
  EXPECT_EQ(startOf(whyItDidNotGrow(failure)),
            "no trial stayed within 3 voxel widths of the scene: the nearest wall is 13 away");
  SeedFailure written_in_metres = failure;
  written_in_metres.sets.front().proximity_max.metres = true;
  EXPECT_EQ(startOf(whyItDidNotGrow(written_in_metres)),
            "no trial stayed within 12 cm of the scene: the nearest wall is 52 cm away");
  SeedFailure lost = failure;
  lost.wall_vx.reset();
  EXPECT_EQ(startOf(whyItDidNotGrow(lost)),
            "no trial stayed within 3 voxel widths of the scene: the nearest wall is more than 256 away");
}

TEST_F(SeedFailures, TooNearNamesItToo) {
  rules_.require.proximity_min = {9.0};
  rules_.random_tree.length = {1.0};
  const SeedFailure failure = failureAt({20, 2, 30});
  EXPECT_EQ(failure.reason, Outcome::too_near);
  EXPECT_EQ(startOf(whyItDidNotGrow(failure)),
            "no trial kept 9 voxel widths from the scene: the nearest wall is 2 away");
}

TEST_F(SeedFailures, TooDarkAndTooBrightNameTheLightAsTheRulesCountIt) {
  rules_.light.sun = 0.0;
  rules_.require.exposure_min = 0.9;
  const SeedFailure dark = failureAt({20, 2, 22});
  EXPECT_EQ(dark.reason, Outcome::too_dark);
  ASSERT_EQ(dark.sets.size(), 1u);
  EXPECT_GT(dark.sets[0].exposure, 0.3);
  EXPECT_LT(dark.sets[0].exposure, 0.6);
  EXPECT_EQ(whyItDidNotGrow(dark),
            fmt::format("the seed sees {:.2f} of the light; the rules ask for at least 0.90",
                        dark.sets[0].exposure));
  world_ = tests::wallPlot();
  rules_.require = {};
  rules_.require.exposure_max = 0.2;
  const std::string bright = whyItDidNotGrow(failureAt({20, 2, 22}));
  EXPECT_TRUE(bright.ends_with("of the light; the rules ask for at most 0.20")) << bright;
}

TEST_F(SeedFailures, EverySetThatWasTriedIsToldOf) {
  rules_.light.sun = 0.0;
  rules_.require.exposure_min = 0.95;
  auto otherwise = std::make_shared<rules::RuleSet>(rules_);
  otherwise->require.exposure_min = 0.8;
  auto brick = std::make_shared<rules::RuleSet>(rules_);
  brick->require.exposure_min = 0.9;
  brick->otherwise = otherwise;
  rules_.regions["brick"] = {false, brick};
  const SeedFailure failure = failureAt({20, 5, 22});
  EXPECT_EQ(failure.region, "brick");
  ASSERT_EQ(failure.sets.size(), 2u);
  EXPECT_EQ(failure.sets[0].path, "regions.brick");
  EXPECT_EQ(failure.sets[1].path, "regions.brick.otherwise");
  const std::string words = whyItDidNotGrow(failure);
  EXPECT_NE(
      words.find("'regions.brick' asks for at least 0.90, 'regions.brick.otherwise' asks for at least 0.80"),
      std::string::npos)
      << words;
}

TEST_F(SeedFailures, ForbiddenNamesTheRegionAndTheKey) {
  rules_.regions["soil"] = {true, nullptr};
  SeedFailure failure = failureAt({20, 2, 30});
  EXPECT_EQ(failure.reason, Outcome::forbidden);
  EXPECT_EQ(whyItDidNotGrow(failure),
            "the nearest region is 'soil', and 'regions.soil' forbids growth there");
  world_ = tests::wallPlot();
  rules_.regions.clear();
  rules_.others = rules::RegionRule{true, nullptr};
  EXPECT_EQ(failureAt({20, 2, 30}).forbidden_by, "regions.others");
}

TEST_F(SeedFailures, BlockedCountsWhatIsTakenAroundTheSeed) {
  tests::addBox(world_, "jar", {18, 1, 28}, {22, 5, 28});
  tests::addBox(world_, "jar", {18, 1, 32}, {22, 5, 32});
  tests::addBox(world_, "jar", {18, 1, 29}, {18, 5, 31});
  tests::addBox(world_, "jar", {22, 1, 29}, {22, 5, 31});
  tests::addBox(world_, "jar", {19, 1, 29}, {21, 1, 31});
  tests::addBox(world_, "jar", {19, 3, 29}, {21, 5, 31});
  rules_.random_tree.length = {6.0};
  const SeedFailure failure = failureAt({20, 2, 30});
  EXPECT_EQ(failure.reason, Outcome::blocked);
  EXPECT_EQ(failure.taken, 18);
  EXPECT_EQ(whyItDidNotGrow(failure),
            "every trial was blocked: 18 of the 26 voxels around the seed are taken");
}

TEST_F(SeedFailures, OutOfTheWorldNamesHowNearItsRimIs) {
  rules_.random_tree.length = {60.0};
  rules_.require.clear = false;
  const SeedFailure failure = failureAt({20, 40, 36});
  EXPECT_EQ(failure.reason, Outcome::out_of_world);
  EXPECT_EQ(failure.rim_vx, 3);
  EXPECT_EQ(startOf(whyItDidNotGrow(failure)), "no trial stayed in the world: its rim is 3 voxels away");
}

TEST_F(SeedFailures, RestingNamesHowSeldomItGrows) {
  rules_.light.sun = 0.0;
  rules_.require.exposure_min = 1.0;
  const double seen = failureAt({20, 2, 22}).sets.at(0).exposure;
  world_ = tests::wallPlot();
  rules_.require.exposure_min = seen - 1e-4;  // it is only just bright enough
  rules_.light.boost = 1e5;
  const SeedFailure failure = failureAt({20, 2, 22});
  EXPECT_EQ(failure.reason, Outcome::resting);
  ASSERT_EQ(failure.sets.size(), 1u);
  EXPECT_NEAR(failure.sets[0].pace, 1e-5 + 1e-4 / (1.0 - seen), 1e-6);
  EXPECT_EQ(
      whyItDidNotGrow(failure),
      fmt::format("it rested in all 6 iterations: with {:.2f} of the light the rules let it grow in one "
                  "of {:.3g}",
                  seen, 1.0 / failure.sets[0].pace));
}

Report::Growth::Plant plantOf(const std::string& planting, int number, std::size_t segments) {
  Report::Growth::Plant plant;
  plant.planting = planting;
  plant.name = planting + " " + std::to_string(number);
  plant.segments = segments;
  return plant;
}

TEST(PoorPlants, ManyOfOneReasonAreOneLine) {
  std::vector<Report::Growth::Plant> plants;
  for (int i = 1; i <= 2000; ++i) {
    plants.push_back(plantOf("ivy", i, 0));
    SeedFailure& failure = plants.back().failure.emplace();
    failure.reason = Outcome::forbidden;
    failure.region = "path";
    failure.forbidden_by = "regions.path";
  }
  plants.push_back(plantOf("ivy", 2001, 90));
  EXPECT_EQ(poorPlants(plants),
            "note: 2000 of 2001 seeds of 'ivy' did not grow, growth is forbidden there: ivy 1, ivy 2, ivy 3 "
            "and 1997 "
            "more. Of 'ivy 1': the nearest region is 'path', and 'regions.path' forbids growth there\n");
  EXPECT_EQ(poorPlants({plants.back()}), "");
}

TEST(PoorPlants, AreToldOfInEightLinesAtMost) {
  std::vector<Report::Growth::Plant> plants;
  for (int i = 1; i <= 20; ++i) {
    plants.push_back(plantOf("kind " + std::to_string(i), 1, 0));
    plants.back().failure.emplace().reason = Outcome::claimed;
  }
  const std::string text = poorPlants(plants);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 8);
  EXPECT_NE(text.find("and 13 more such lines"), std::string::npos) << text;
}

TEST_F(SeedFailures, UnmetIsNoForbiddenRegion) {
  rules_.senses = {{"rise", rules::SenseSpec::Measure::height, "scene", {6.0}}};
  rules_.require.senses = {{"rise", 0.5}};  // metres
  const SeedFailure failure = failureAt({20, 2, 30});
  EXPECT_EQ(failure.reason, Outcome::unmet);
  const std::string words = whyItDidNotGrow(failure);
  EXPECT_NE(words.find("require.senses"), std::string::npos) << words;
  std::vector<Report::Growth::Plant> plants{plantOf("ivy", 1, 0), plantOf("ivy", 2, 0)};
  for (auto& plant : plants) plant.failure = failure;
  EXPECT_NE(poorPlants(plants).find("did not grow, what they require did not hold: ivy 1"), std::string::npos)
      << poorPlants(plants);
}

TEST_F(SeedFailures, NoTrialEndsWhereItIsRequired) {
  rules_.senses = {{"rise", rules::SenseSpec::Measure::height, "scene", {6.0}}};
  rules_.require.along = {{"rise", 30.0}};  // metres
  const SeedFailure failure = failureAt({20, 2, 30});
  EXPECT_EQ(failure.reason, Outcome::unmet);
  EXPECT_NE(whyItDidNotGrow(failure).find("no trial met require.along"), std::string::npos)
      << whyItDidNotGrow(failure);
}

TEST(PoorPlants, ThatSoonStoppedAreToldOfWhereTheOthersThrive) {
  std::vector<Report::Growth::Plant> plants = {plantOf("ivy", 1, 200), plantOf("ivy", 2, 3),
                                               plantOf("ivy", 3, 90)};
  plants[1].tally.sites[static_cast<std::size_t>(Outcome::no_trial)] = 4;
  EXPECT_EQ(
      poorPlants(plants),
      "note: 1 of 3 plants of 'ivy' stopped at fewer than 5 segments: ivy 2; of their buds 4 found no way, 0 "
      "were too dark, 0 too bright, 0 in forbidden regions\n");
  plants[1].tally.sites[static_cast<std::size_t>(Outcome::unmet)] = 2;
  EXPECT_NE(poorPlants(plants).find("regions, 2 not of the age, region or senses that they require\n"),
            std::string::npos);
  plants[0].segments = 20;
  plants[2].segments = 20;
  EXPECT_EQ(poorPlants(plants), "");
}

}  // namespace
}  // namespace espalier::scenes
