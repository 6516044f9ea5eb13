#include "rules/growth/given_skeleton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/grow/state.h"
#include "sim/tile/tiling.h"
#include "tests/support/lively.h"
#include "tests/support/numbers.h"
#include "tests/support/plots.h"

/// Skeletons that were made elsewhere: all of them stand, at their pace, in their dress.
namespace espalier {
namespace {

using rules::GivenTree;
using sim::Vec3;

/// A trunk with a branch to one side of it, and a twig on that.
GivenTree forked() {
  return {{-1, 0, 1, 2, 1, 4, 5, 4},
          {{24, 4, 8},
           {24, 10, 8},
           {24, 16, 8},
           {24, 30, 8},
           {30, 13, 8},
           {36, 16, 8},
           {40, 17, 8},
           {30, 20, 8}}};
}

rules::RuleSet leafy() {
  rules::RuleSet rules = tests::lively();
  rules.require = {};
  rules.prefer = {};
  return rules;
}

sim::Growth grown(sim::World& world, const rules::RuleSet& rules, const std::vector<GivenTree>& trees,
                  int iterations = 10) {
  std::vector<Vec3> roots;
  for (const GivenTree& tree : trees) roots.push_back(tree.position_vx.front());
  const auto process =
      rules::makeGivenSkeleton(std::make_shared<rules::RuleSet>(rules), world.frame(), trees, iterations);
  return sim::grow(world, {{"given", process, sim::seedsAt(world.frame(), roots), true}},
                   tests::brightSettings(iterations));
}

/// Segments by their two ends, in an order of their own.
std::vector<std::pair<std::array<double, 3>, std::array<double, 3>>> segmentsOf(
    const std::vector<sim::NodeId>& parent, const std::vector<Vec3>& position) {
  std::vector<std::pair<std::array<double, 3>, std::array<double, 3>>> all;
  for (std::size_t n = 1; n < parent.size(); ++n) {
    const Vec3 a = position[static_cast<std::size_t>(parent[n])], b = position[n];
    all.push_back({{a.x, a.y, a.z}, {b.x, b.y, b.z}});
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Anywhere in the world, in steps from far below a voxel to many voxels.
GivenTree scattered(std::uint64_t seed, int nodes) {
  tests::Numbers numbers(seed);
  GivenTree tree{{-1}, {{24, 20, 20}}};
  while (static_cast<int>(tree.parent.size()) < nodes) {
    const auto parent = static_cast<sim::NodeId>(numbers.chance(0.8) ? tree.parent.size() - 1
                                                                     : numbers.below(tree.parent.size()));
    const double step = std::pow(10.0, numbers.uniform(-3.0, 1.2));
    Vec3 to = tree.position_vx[static_cast<std::size_t>(parent)];
    for (int axis = 0; axis < 3; ++axis)
      to[axis] = std::clamp(to[axis] + step * numbers.uniform(-1, 1), 0.0, 39.0);
    if (to == tree.position_vx[static_cast<std::size_t>(parent)]) continue;
    tree.parent.push_back(parent);
    tree.position_vx.push_back(to);
  }
  return tree;
}

TEST(GivenSkeleton, StandsAtTheEndWhateverItMeets) {
  for (const int iterations : {1, 3, 40}) {
    sim::World world = tests::wallPlot();
    const GivenTree tree = scattered(7, 400);
    const sim::Growth growth = grown(world, leafy(), {tree}, iterations);
    EXPECT_EQ(growth.iterations, iterations);
    const sim::Skeleton& s = growth.plants[0].skeleton;
    EXPECT_EQ(segmentsOf(s.parent, s.position_vx), segmentsOf(tree.parent, tree.position_vx));
    EXPECT_EQ(*std::max_element(s.born.begin(), s.born.end()), iterations - 1);
    EXPECT_GT(growth.plants[0].elements.size(), 50u);
    // What lies in the wall is counted.
    const sim::World bare = tests::wallPlot();
    std::uint64_t met = 0;
    for (std::size_t n = 1; n < tree.parent.size(); ++n) {
      std::vector<sim::Voxel> passes;
      sim::tileSegment(tree.position_vx[static_cast<std::size_t>(tree.parent[n])], tree.position_vx[n],
                       passes);
      met += std::any_of(passes.begin(), passes.end(), [&](sim::Voxel v) {
        return !sim::besides(v, sim::voxelAt(tree.position_vx[0])) && bare.occupied().at(v);
      });
    }
    EXPECT_GT(met, 5u);
    EXPECT_EQ(sim::timesOf(growth.tallies[0].trials, sim::Outcome::blocked), met);
    EXPECT_EQ(sim::timesOf(growth.tallies[0].trials, sim::Outcome::grown), 399 - met);
    // And takes no voxel of it.
    for (const auto& [voxel, surface] : world.surfaces()) {
      if (!bare.occupied().at(voxel)) continue;
      EXPECT_EQ(surface.part, bare.partAt(voxel));
    }
  }
}

TEST(GivenSkeleton, GrowsFromItsRootAtOneSpeed) {
  sim::World world = tests::wallPlot();
  GivenTree pole{{-1}, {{10, 4, 8}}}, half = pole;
  half.position_vx[0].x = 30;
  for (int i = 1; i <= 20; ++i) {
    pole.parent.push_back(i - 1);
    pole.position_vx.emplace_back(10, 4 + i, 8);
    if (i > 10) continue;
    half.parent.push_back(i - 1);
    half.position_vx.emplace_back(30, 4 + i, 8);
  }
  const sim::Growth growth = grown(world, {}, {pole, half}, 5);
  for (const sim::Plant& plant : growth.plants) {
    for (std::size_t n = 1; n < plant.skeleton.parent.size(); ++n)
      EXPECT_EQ(plant.skeleton.born[n], (static_cast<int>(n) - 1) / 4) << plant.name << n;
  }
  EXPECT_EQ(growth.plants[1].skeleton.size(), 11);
}

TEST(GivenSkeleton, IsTheSameOnAnyNumberOfThreadsAndStepByStep) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 5}) {
    sim::onThreads(threads, [&] {
      sim::World world = tests::wallPlot();
      hashes.push_back(sim::stateHash(world, grown(world, leafy(), {scattered(9, 300), forked()})));
    });
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  // From its state, after each iteration.
  const std::vector<GivenTree> trees{scattered(9, 300), forked()};
  for (const int before : {0, 1, 6, 9}) {
    sim::World world = tests::wallPlot();
    const auto process =
        rules::makeGivenSkeleton(std::make_shared<rules::RuleSet>(leafy()), world.frame(), trees, 10);
    const std::vector<sim::Planting> plantings{
        {"given", process,
         sim::seedsAt(world.frame(), {trees[0].position_vx.front(), trees[1].position_vx.front()}), true}};
    const sim::BitVolume bare = world.occupied();
    const sim::Growth part = sim::grow(world, plantings, tests::brightSettings(before));
    const std::string bytes = sim::stateBytes({}, world, bare, part);
    sim::World again = tests::wallPlot();
    sim::Growth kept = sim::restore(sim::readState(bytes, "f"), again, plantings, "f");
    sim::Growing growing(again, plantings, tests::brightSettings(10), std::move(kept));
    while (growing.step()) {
    }
    EXPECT_EQ(sim::stateHash(again, growing.growth()), hashes[0]) << before;
    // A memory of another skeleton is no memory of this one.
    sim::World other = tests::wallPlot();
    kept = sim::restore(sim::readState(bytes, "f"), other, plantings, "f");
    sim::column<std::int64_t>(kept.stands[0].memory, "given_left")[0] += 1;
    sim::Growing broken(other, plantings, tests::brightSettings(10), std::move(kept));
    EXPECT_THROW(broken.due(), sim::BrokenContract);
  }
}

TEST(GivenSkeleton, HasLimbsByRadiusThenByTipsThenByStraightness) {
  const auto orders = [](GivenTree tree) {
    std::vector<int> found;
    const auto made = rules::arranged({tree}, 1);
    for (const Vec3 at : tree.position_vx) {
      const auto& places = made[0].tree.position_vx;
      found.push_back(
          made[0]
              .order[static_cast<std::size_t>(std::find(places.begin(), places.end(), at) - places.begin())]);
    }
    return found;
  };
  EXPECT_EQ(orders(forked()), (std::vector<int>{0, 0, 1, 1, 0, 0, 0, 1}));  // two tips against one
  GivenTree thick = forked();
  thick.radius_vx = {1, 1, 0.9f, 0.9f, 0.5f, 0.2f, 0.2f, 0.4f};
  EXPECT_EQ(orders(thick), (std::vector<int>{0, 0, 0, 0, 1, 2, 2, 1}));
  EXPECT_EQ(orders({{-1, 0, 1, 1}, {{5, 1, 5}, {5, 5, 5}, {9, 8, 5}, {6, 9, 5}}}),
            (std::vector<int>{0, 0, 1, 0}));
}

TEST(GivenSkeleton, WearsWhatEachOrderAndRegionSays) {
  rules::RuleSet rules;
  auto twigs = std::make_shared<rules::RuleSet>(leafy());
  twigs->elements[0].per_segment = 4.0;
  rules.branches = twigs;
  GivenTree tree = forked();
  tree.radius_vx = {1, 1, 0.9f, 0.9f, 0.5f, 0.2f, 0.2f, 0.4f};
  sim::World world = tests::wallPlot();
  const sim::Growth growth = grown(world, rules, {tree});
  const sim::Plant& plant = growth.plants[0];
  EXPECT_GT(plant.elements.size(), 8u);
  const auto& order = *sim::find(plant.skeleton, "order");
  for (const sim::PlacedElement& e : plant.elements) EXPECT_GE(order[static_cast<std::size_t>(e.node)], 1.0f);
  EXPECT_EQ(*std::max_element(order.begin(), order.end()), 2.0f);

  // Bare where a region forbids, and in the dark.
  rules::RuleSet shy = leafy();
  shy.regions["soil"].forbidden = true;
  sim::World near_soil = tests::wallPlot({48, 48, 40}, 40);
  const sim::Growth bare = grown(near_soil, shy, {{{-1, 0}, {{10, 2, 5}, {14, 2, 5}}}});
  EXPECT_EQ(bare.plants[0].skeleton.size(), 2);
  EXPECT_TRUE(bare.plants[0].elements.empty());
  rules::RuleSet light = leafy();
  light.require.exposure_min = 0.9;
  sim::World dark = tests::wallPlot();
  const sim::Growth below = grown(dark, light, {{{-1, 0}, {{10, 2, 18}, {14, 2, 18}}}});
  EXPECT_EQ(below.plants[0].skeleton.size(), 2);
  EXPECT_TRUE(below.plants[0].elements.empty());
}

TEST(GivenSkeleton, KeepsItsRadiiWhereItHasSome) {
  GivenTree tree = forked();
  sim::World world = tests::wallPlot();
  EXPECT_EQ(sim::find(grown(world, {}, {tree}).plants[0].skeleton, sim::kRadiusColumn), nullptr);
  tree.radius_vx = {1, 1, 0.9f, 0.9f, 0.5f, 0.2f, 0.2f, 0.4f};
  sim::World other = tests::wallPlot();
  const sim::Growth growth = grown(other, {}, {tree});
  const sim::Skeleton& s = growth.plants[0].skeleton;
  const auto& radii = *sim::find(s, sim::kRadiusColumn);
  for (std::size_t n = 1; n < radii.size(); ++n) {
    const auto old = std::find(tree.position_vx.begin(), tree.position_vx.end(), s.position_vx[n]);
    EXPECT_EQ(radii[n], tree.radius_vx[static_cast<std::size_t>(old - tree.position_vx.begin())]);
  }
}

TEST(GivenSkeleton, MayStandInTheGroundAndMustStandInTheWorld) {
  sim::World world = tests::wallPlot();
  const sim::Growth rooted = grown(world, leafy(), {{{-1, 0}, {{10, 0, 8}, {10, 6, 8}}}});
  EXPECT_EQ(rooted.plants[0].skeleton.size(), 2);
  EXPECT_EQ(sim::timesOf(rooted.tallies[0].trials, sim::Outcome::blocked), 0u);  // it stands on something
  EXPECT_TRUE(rules::standsIn({48, 48, 40}, {47.4, 0, 0}));
  EXPECT_FALSE(rules::standsIn({48, 48, 40}, {47.5, 0, 0}));
  EXPECT_FALSE(rules::standsIn({48, 48, 40}, {std::nextafter(47.5, 0.0), 0, 0}));  // rounds to the next voxel
  EXPECT_FALSE(rules::standsIn({48, 48, 40}, {0, std::nan(""), 0}));
  EXPECT_THROW(grown(world, {}, {{{-1, 0}, {{10, 4, 8}, {10, 60, 8}}}}), sim::BrokenContract);
}

TEST(GivenSkeleton, IsPlacedWholeHoweverDeepItIs) {
  GivenTree deep{{-1}, {{4, 4, 4}}};
  for (int i = 1; i < 5'000; ++i) {
    deep.parent.push_back(i - 1);
    deep.position_vx.emplace_back(4.0 + 0.008 * i, 4.0, 4.0);
  }
  sim::World world = tests::wallPlot();
  const sim::Growth growth = grown(world, {}, {deep}, 2);
  EXPECT_EQ(growth.plants[0].skeleton.size(), 5'000);
  EXPECT_EQ(growth.iterations, 2);
}

}  // namespace
}  // namespace espalier
