#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/grow/faults.h"
#include "sim/grow/grow.h"
#include "sim/grow/state.h"
#include "tests/support/plots.h"
#include "tests/support/processes.h"

namespace espalier {
namespace {

using sim::Outcome;
using sim::Vec3;
using sim::Voxel;
using tests::Creeper;
using tests::Tiler;

/// A floor with two plantings of tiles and one of creepers on it, which get in each other's way.
std::vector<sim::Planting> plantings(const sim::Frame& frame,
                                     std::shared_ptr<const sim::Process> creeper = nullptr) {
  if (!creeper) creeper = std::make_shared<Creeper>();
  const auto tiler = std::make_shared<Tiler>();
  return {{"tiles", tiler, sim::seedsAt(frame, {{10, 3, 10}, {30, 3, 10}})},
          {"creeper", creeper, sim::seedsAt(frame, {{12, 3, 11}, {24, 4, 30}})},
          {"others", tiler, sim::seedsAt(frame, {{16, 3, 13}})}};
}

sim::GrowthSettings settings(int iterations = 12) {
  sim::GrowthSettings s;
  s.iterations = iterations;
  return s;
}

std::uint64_t hashOf(int threads, std::shared_ptr<const sim::Process> creeper = nullptr) {
  std::uint64_t hash = 0;
  sim::onThreads(threads, [&] {
    sim::World world = tests::wallPlot();
    const auto growth = sim::grow(world, plantings(world.frame(), std::move(creeper)), settings());
    hash = sim::stateHash(world, growth);
  });
  return hash;
}

TEST(Growing, ProcessesOfAllKindsShareAWorld) {
  sim::World world = tests::wallPlot();
  const auto growth = sim::grow(world, plantings(world.frame()), settings());
  ASSERT_EQ(growth.plants.size(), 5u);
  std::size_t tiles = 0;
  for (const std::size_t i : {0u, 1u, 4u}) {
    EXPECT_EQ(growth.plants[i].skeleton.size(), 1);
    for (const auto& e : growth.plants[i].elements) {
      EXPECT_EQ(e.node, 0);
      EXPECT_GT(e.scale, 0.9);
    }
    tiles += growth.plants[i].elements.size();
  }
  EXPECT_EQ(tiles,
            static_cast<std::size_t>(Tiler::kStore) -
                static_cast<std::size_t>(sim::column<std::int64_t>(growth.commons.at("tiles"), "left")[0]));
  EXPECT_GT(tiles, 40u);
  EXPECT_GT(growth.plants[2].skeleton.size() + growth.plants[3].skeleton.size(), 40);
  EXPECT_EQ(growth.plants[2].skeleton.columns.at("step_vx").size(), growth.plants[2].skeleton.parent.size());
  // Tiles of a planting are told apart exactly, though they share voxels.
  std::vector<Vec3> middles;
  for (const std::size_t i : {0u, 1u}) {
    for (const auto& e : growth.plants[i].elements) middles.push_back(e.position_vx);
  }
  for (std::size_t i = 0; i < middles.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT(glm::distance(middles[i], middles[k]), Tiler::kSide - 1e-9);
  }
  EXPECT_GT(growth.tallies[0].sites[static_cast<std::size_t>(Outcome::claimed)], 0u);
}

TEST(Growing, OneHashOnAnyNumberOfThreads) {
  const std::uint64_t one = hashOf(1);
  const sim::Shaken shaken;
  for (const int threads : {1, 2, 3, 5, 8, 16}) EXPECT_EQ(hashOf(threads), one) << threads;
}

/// Draws from a counter that all threads share: what must not be done.
class Careless : public Creeper {
 private:
  Vec3 direction(sim::Slots&) const override {
    const double drawn = 0.6180339887498949 * static_cast<double>(counter_++);
    return sim::inCone(Vec3(0, 1, 0), -1.0, drawn - std::floor(drawn), 0.4);
  }
  mutable std::atomic<std::uint64_t> counter_ = 0;
};

TEST(Growing, ThatTestCanTellADifference) {
  const sim::Shaken shaken;
  std::set<std::uint64_t> hashes;
  for (int i = 0; i < 40 && hashes.size() < 2; ++i) hashes.insert(hashOf(8, std::make_shared<Careless>()));
  EXPECT_EQ(hashes.size(), 2u);
}

TEST(Growing, StepsAreTheWholeAndCanBeLookedAt) {
  sim::World stepped = tests::wallPlot(), whole = tests::wallPlot();
  const auto all = sim::grow(whole, plantings(whole.frame()), settings());
  sim::Growing growing(stepped, plantings(stepped.frame()), settings());
  int steps = 0;
  while (growing.step()) {
    ++steps;
    EXPECT_EQ(growing.growth().iterations, steps);
  }
  EXPECT_EQ(steps, 12);
  EXPECT_FALSE(growing.step());
  EXPECT_EQ(sim::stateHash(stepped, growing.growth()), sim::stateHash(whole, all));
  sim::World shorter = tests::wallPlot();
  const auto fewer = sim::grow(shorter, plantings(shorter.frame()), settings(11));
  EXPECT_NE(sim::stateHash(shorter, fewer), sim::stateHash(whole, all));  // a step less would show
}

TEST(Growing, ACopiedWorldGrowsTheSame) {
  const sim::World site = tests::wallPlot();
  sim::World copy = site;
  sim::World fresh = tests::wallPlot();
  const auto a = sim::grow(copy, plantings(copy.frame()), settings());
  const auto b = sim::grow(fresh, plantings(fresh.frame()), settings());
  EXPECT_EQ(sim::stateHash(copy, a), sim::stateHash(fresh, b));
  EXPECT_NE(sim::stateHash(site, a), sim::stateHash(fresh, b));              // and not without the world
  EXPECT_EQ(site.occupied().words(), tests::wallPlot().occupied().words());  // and the first is as it was
  const sim::World grown = copy;
  EXPECT_EQ(grown.occupied().words(), copy.occupied().words());
  EXPECT_EQ(grown.parts().size(), copy.parts().size());
}

TEST(Growing, ASiteCanBeAskedAgain) {
  sim::World world = tests::wallPlot();
  sim::Growing growing(world, plantings(world.frame()), settings());
  for (int i = 0; i < 6; ++i) growing.step();
  const sim::Due due = growing.due();
  const auto& sites = due.sites;
  ASSERT_EQ(sites.size(), 3u);
  std::vector<std::vector<sim::Proposal>> foreseen(3);
  const std::uint64_t before = sim::stateHash(world, growing.growth());
  for (std::size_t p = 0; p < 3; ++p) {
    for (const sim::Site& site : sites[p]) foreseen[p].push_back(growing.propose(due, p, site));
  }
  EXPECT_EQ(sim::stateHash(world, growing.growth()), before);
  sim::Growth other = growing.growth();
  sim::column<std::int64_t>(other.commons.at("tiles"), "left")[0] += 1;
  EXPECT_NE(sim::stateHash(world, other), before);  // nothing of what is remembered could change unseen
  for (const sim::Proposal& p : foreseen[0])
    EXPECT_NE(p.outcome, Outcome::no_trial);  // it knows what due() left
  const std::vector<sim::Plant> old = growing.growth().plants;
  growing.step();
  std::set<std::pair<std::int32_t, double>> wanted;
  for (std::size_t i = 0; i < sites[1].size(); ++i) {
    const sim::Proposal& proposal = foreseen[1][i];
    ASSERT_EQ(proposal.attempts.size(), 1u);
    EXPECT_EQ(proposal.attempts[0].outcome, proposal.outcome);
    if (proposal.segment) wanted.insert({sites[1][i].plant, proposal.segment->to_vx.x});
  }
  EXPECT_GT(wanted.size(), 3u);
  std::size_t grown = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& plant = growing.growth().plants[2 + k];
    for (auto n = static_cast<std::size_t>(old[2 + k].skeleton.size()); n < plant.skeleton.parent.size();
         ++n) {
      EXPECT_TRUE(wanted.contains({static_cast<std::int32_t>(k), plant.skeleton.position_vx[n].x}));
      ++grown;
    }
  }
  EXPECT_GT(grown, 3u);
  EXPECT_THROW(growing.propose(due, 7, sites[0][0]), sim::InputError);
  EXPECT_THROW(growing.propose(due, 1, {0, 1'000'000, 0, {}}), sim::BrokenContract);
}

TEST(Growing, PlantsThatDoNotMeetDoNotKnowOfEachOther) {
  const auto creeper = std::make_shared<Creeper>();
  const auto grownWith = [&](std::vector<sim::Planting> all, std::size_t which) {
    sim::World world = tests::wallPlot({400, 48, 40});
    return sim::grow(world, all, settings(8)).plants[which];
  };
  const sim::Frame frame = tests::wallPlot({400, 48, 40}).frame();
  const auto seeds = [&](const std::vector<Vec3>& places) { return sim::seedsAt(frame, places); };
  const auto alone = grownWith({{"a", creeper, seeds({{300, 12, 30}})}}, 0);
  const auto seeded = grownWith({{"a", creeper, seeds({{20, 12, 30}, {100, 9, 9}, {300, 12, 30}})}}, 2);
  const auto planted = grownWith(
      {{"b", std::make_shared<Tiler>(), seeds({{20, 3, 30}})}, {"a", creeper, seeds({{300, 12, 30}})}}, 1);
  for (const auto& other : {seeded, planted}) {
    EXPECT_EQ(alone.skeleton.parent, other.skeleton.parent);
    EXPECT_EQ(alone.skeleton.position_vx, other.skeleton.position_vx);
    EXPECT_EQ(alone.skeleton.columns, other.skeleton.columns);
    EXPECT_EQ(alone.key, other.key);
  }
  // A planting by another name draws other numbers, and so does a seed with a key of its own.
  EXPECT_NE(alone.skeleton.position_vx,
            grownWith({{"b", creeper, seeds({{300, 12, 30}})}}, 0).skeleton.position_vx);
  const auto named = [&](Vec3 at) {
    return grownWith({{"a", creeper, {{at, sim::keyOfName("north door")}}}}, 0).skeleton.position_vx;
  };
  const auto here = named({300, 12, 30}), there = named({200, 12, 30});
  EXPECT_NE(alone.skeleton.position_vx, here);
  EXPECT_NEAR(here[1].x - here[0].x, there[1].x - there[0].x,
              1e-9);  // a plant that was moved goes on as it was
}

/// Goes up by one voxel at a time, so many in each iteration.
class Climber : public Creeper {
 public:
  explicit Climber(int in_each, bool names_sites = true) : in_each_(in_each), names_sites_(names_sites) {}
  std::vector<sim::Site> due(const sim::StandView& stand, sim::Columns& memory,
                             sim::Commons&) const override {
    const sim::Skeleton& s = stand.plants[0].skeleton;
    const bool later = (s.size() - 1) % in_each_ != 0;
    sim::column<std::int32_t>(memory, "rounds").push_back(stand.iteration);
    if (later && !names_sites_) return {};
    return {{0, s.size() - 1, 0, s.position_vx.back()}};
  }
  sim::Proposal propose(const sim::SiteView&, const sim::Site& site, const sim::RandomKey&) const override {
    const Vec3 to = site.at_vx + Vec3(0, 1, 0);
    sim::Proposal proposal{.outcome = Outcome::grown};
    proposal.segment = sim::ProposedSegment{to, {sim::voxelAt(to)}, sim::Passage::through, {1.0f}};
    return proposal;
  }
  void settle(const sim::StandView&, std::span<const sim::Verdict>, sim::Columns&,
              sim::Commons&) const override {}
  bool goesOn(const sim::StandView& stand, const sim::Columns&) const override {
    return (stand.plants[0].skeleton.size() - 1) % in_each_ != 0;
  }
  std::size_t alive(const sim::Columns&, const sim::Commons&) const override { return 1; }

 private:
  int in_each_;
  bool names_sites_;
};

TEST(Growing, AProcessMayGoOnWithinAnIteration) {
  sim::World world = tests::wallPlot();
  const auto creeper = std::make_shared<Creeper>();
  const auto growth =
      sim::grow(world,
                {{"climber", std::make_shared<Climber>(3), sim::seedsAt(world.frame(), {{10, 3, 10}})},
                 {"creeper", creeper, sim::seedsAt(world.frame(), {{24, 4, 30}})}},
                settings(4));
  const sim::Skeleton& s = growth.plants[0].skeleton;
  ASSERT_EQ(s.size(), 13);
  for (int n = 1; n < 13; ++n) {
    EXPECT_EQ(s.born[static_cast<std::size_t>(n)], (n - 1) / 3);
    EXPECT_EQ(s.position_vx[static_cast<std::size_t>(n)], Vec3(10, 3 + n, 10));
  }
  EXPECT_EQ(sim::column<std::int32_t>(growth.stands[0].memory, "rounds"),
            (std::vector<std::int32_t>{0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3}));
  // The others have one turn in each, and grow what they would without it.
  sim::World other = tests::wallPlot();
  const auto alone =
      sim::grow(other, {{"creeper", creeper, sim::seedsAt(other.frame(), {{24, 4, 30}})}}, settings(4));
  EXPECT_EQ(growth.plants[1].skeleton.position_vx, alone.plants[0].skeleton.position_vx);
  // One that goes on and has nothing more would go on for ever.
  sim::World third = tests::wallPlot();
  EXPECT_THROW(sim::grow(third,
                         {{"climber", std::make_shared<Climber>(3, false),
                           sim::seedsAt(third.frame(), {{10, 3, 10}})}},
                         settings(4)),
               sim::BrokenContract);
}

TEST(Growing, SeedsStandInThingsOnlyWhereTheirPlantingMay) {
  sim::World world = tests::wallPlot();
  std::vector<sim::Planting> in_soil{
      {"creeper", std::make_shared<Creeper>(), sim::seedsAt(world.frame(), {{10, 0, 10}})}};
  EXPECT_THROW(sim::grow(world, in_soil, settings(1)), sim::InputError);
  in_soil[0].anywhere = true;
  EXPECT_EQ(sim::grow(world, in_soil, settings(1)).plants.size(), 1u);
  in_soil[0].seeds = sim::seedsAt(world.frame(), {{10, -3, 10}});
  EXPECT_THROW(sim::grow(world, in_soil, settings(1)), sim::InputError);
}

TEST(Growing, SeedsAreCheckedBeforeTheWorldIsTouched) {
  sim::World world = tests::wallPlot();
  const std::size_t parts = world.parts().size();
  const auto creeper = std::make_shared<Creeper>();
  const auto grow = [&](std::vector<sim::Seed> seeds) {
    sim::grow(world, {{"good", creeper, sim::seedsAt(world.frame(), {{5, 5, 5}})}, {"bad", creeper, seeds}},
              settings(1));
  };
  EXPECT_THROW(grow(sim::seedsAt(world.frame(), {{10, 10, 20}})), sim::InputError);   // in the wall
  EXPECT_THROW(grow(sim::seedsAt(world.frame(), {{10, -10, 20}})), sim::InputError);  // below the world
  EXPECT_THROW(grow({{{5, 9, 5}, 1}, {{9, 9, 9}, 1}}), sim::InputError);              // one key for two
  EXPECT_THROW(
      sim::grow(world, {{"one", creeper, {{{5, 5, 5}, 1}}}, {"one", creeper, {{{9, 9, 9}, 1}}}}, settings(1)),
      sim::InputError);  // one name and key for two
  EXPECT_EQ(world.parts().size(), parts);
  EXPECT_EQ(sim::seedsAt(world.frame(), {{5, 5, 5}, {5, 5, 5}, {5, 5, 5}}).size(), 3u);
  grow(sim::seedsAt(world.frame(), {{5, 9, 5}, {5, 9, 5}}));  // in one place, but told apart
}

TEST(Growing, SaysAllThatIsWrongWithItsPlantings) {
  class Unwilling final : public Creeper {
    void begin(const sim::StandView&, sim::Columns&, sim::Commons&) const override {
      throw sim::InputError("it has no wish to");
    }
  };
  using Found = std::vector<std::pair<std::size_t, std::optional<std::size_t>>>;
  sim::World world = tests::wallPlot();
  const auto found = [&](const std::vector<sim::Planting>& of) {
    Found all;
    try {
      const sim::Growing growing(world, of, settings(1));
    } catch (const sim::PlantingFaults& error) {
      EXPECT_EQ(error.what(), error.faults().front().text);
      for (const sim::PlantingFault& fault : error.faults()) all.emplace_back(fault.planting, fault.seed);
    }
    return all;
  };
  const auto creeper = std::make_shared<Creeper>();
  const auto unwilling = std::make_shared<Unwilling>();
  const auto at = [&](const std::vector<Vec3>& places) { return sim::seedsAt(world.frame(), places); };
  EXPECT_EQ(found({{"a", creeper, at({{5, 5, 5}, {10, 10, 20}, {10, -10, 20}})},
                   {"b", unwilling, {{{5, 9, 5}, 1}, {{9, 9, 9}, 1}}}}),
            (Found{{0, 1}, {0, 2}, {1, 1}}));
  EXPECT_EQ(found({{"a", creeper, at({{5, 5, 5}})}, {"b", unwilling, at({{5, 9, 5}})}, {"c", unwilling, {}}}),
            (Found{{1, std::nullopt}, {2, std::nullopt}}));
}

TEST(Growing, AProcessThatWantsATableOfTheSkyGetsTheUsualOneOrNeedsOne) {
  class Gazer final : public Creeper {
    sim::Wants wants() const override { return {.sky_table = true}; }
  };
  sim::World world = tests::wallPlot();
  const std::vector<sim::Planting> gazer = {
      {"gazer", std::make_shared<Gazer>(), sim::seedsAt(world.frame(), {{5, 5, 5}})}};
  EXPECT_NO_THROW(sim::grow(world, gazer, settings(1)));
  sim::GrowthSettings without = settings(1);
  without.sky_table = nullptr;
  EXPECT_THROW(sim::grow(world, gazer, without), sim::InputError);
}

/// Breaks the contract in a way of choice.
class Unruly : public Creeper {
 public:
  enum class Way { order, node, place, segment, voxel, quantities };
  explicit Unruly(Way way) : way_(way) {}
  std::vector<sim::Site> due(const sim::StandView& stand, sim::Columns& memory,
                             sim::Commons& commons) const override {
    auto sites = Creeper::due(stand, memory, commons);
    if (way_ == Way::order) sites.push_back(sites.front());
    if (way_ == Way::node) sites.back().node = 99;
    if (way_ == Way::place) sites.back().at_vx.y = -3.0;
    return sites;
  }
  sim::Proposal propose(const sim::SiteView& view, const sim::Site& site,
                        const sim::RandomKey& key) const override {
    auto proposal = Creeper::propose(view, site, key);
    proposal.outcome = Outcome::grown;
    proposal.segment = {site.at_vx, {sim::voxelAt(site.at_vx)}, sim::Passage::around, {1.0f}};
    if (way_ == Way::segment) proposal.segment->to_vx.x = 1e6;
    if (way_ == Way::voxel) proposal.segment->takes = {Voxel(0, 0, 40)};
    if (way_ == Way::quantities) proposal.segment->quantities.clear();
    return proposal;
  }

 private:
  Way way_;
};

TEST(Growing, APlantingWithoutAProcessIsABrokenContract) {
  sim::World world = tests::wallPlot();
  const std::vector<sim::Planting> some = {
      {"vine", std::make_shared<Creeper>(), sim::seedsAt(world.frame(), {{5, 5, 5}})}, {"moss", nullptr, {}}};
  EXPECT_THROW(sim::grow(world, some, settings(2)), sim::BrokenContract);
  sim::Growth grown;
  grown.stands.resize(2);
  EXPECT_THROW(sim::Growing(world, some, settings(2), std::move(grown)), sim::BrokenContract);
  EXPECT_THROW(sim::restore({}, world, some, "growth.state"), sim::BrokenContract);
}

TEST(Growing, ABrokenContractIsSaidInEveryBuild) {
  using Way = Unruly::Way;
  for (const Way way : {Way::order, Way::node, Way::place, Way::segment, Way::voxel, Way::quantities}) {
    sim::World world = tests::wallPlot();
    EXPECT_THROW(
        sim::grow(world,
                  {{"unruly", std::make_shared<Unruly>(way), sim::seedsAt(world.frame(), {{5, 5, 5}})}},
                  settings(2)),
        sim::BrokenContract)
        << static_cast<int>(way);
  }
}

}  // namespace
}  // namespace espalier
