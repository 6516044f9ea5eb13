#include "rules/growth/elements.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <tuple>

#include "sim/grow/pieces.h"
#include "sim/tile/tiling.h"
#include "tests/support/crossings.h"
#include "tests/support/lively.h"
#include "tests/support/plots.h"

namespace espalier::rules {
namespace {

using sim::Vec3;

/// A segment from [10, 10, 10] to [12, 10, 10] in a world, asked for its elements.
std::vector<sim::ProposedElement> elementsOf(const sim::World& world, const RuleSet& rules,
                                             double vigour = 1.0) {
  sim::Plant plant;
  plant.skeleton.parent = {sim::kNoNode};
  plant.skeleton.position_vx = {Vec3(10, 10, 10)};
  sim::PieceGrid pieces(world.frame().size);
  for (const Element& element : rules.elements) {
    plant.element_parts.push_back(static_cast<sim::PartId>(plant.element_parts.size() + 1));
    pieces.addPart(plant.element_parts.back(), 0,
                   std::make_shared<sim::FacetShape>(sim::facetShape(element.polygons)));
  }
  const sim::Kin kin;
  const sim::Columns memory;
  const sim::Commons commons;
  const sim::SiteView view{world, plant, kin, memory, commons, pieces};
  Surroundings around;
  around.at_vx = Vec3(10, 10, 10);
  around.voxel = {10, 10, 10};
  around.heading = Vec3(1, 0, 0);
  Senses senses;
  senses.vigour = vigour;
  const Vec3 to(12, 10, 10);
  std::vector<sim::Voxel> segment;
  sim::tileSegment(around.at_vx, to, segment);
  return proposeElements(view, {0, 0, 0, around.at_vx}, rules, around, senses, to, segment, 0,
                         {sim::streamOf(1, "vine", 2), 3, 0, 4});
}

sim::World emptyWorld(sim::Voxel size) {
  return sim::World({Vec3(0.0), 0.04, size});
}

RuleSet with(Element element) {
  RuleSet rules;
  rules.elements = {std::move(element)};
  return rules;
}

Element square(double side) {
  Element element;
  element.polygons = {{{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}}};
  element.per_segment = 1.0;
  return element;
}

// At 10,000 trials of 9 numbers each, trials once ran into each other's numbers.
TEST(Elements, MayBeTriedTenThousandTimesInVain) {
  sim::World world = emptyWorld({22, 21, 21});
  for (const int y : {8, 12}) tests::addBox(world, "slab", {0, y, 0}, {21, y, 20});
  for (const int z : {8, 12}) tests::addBox(world, "slab", {0, 9, z}, {21, 11, z});
  for (const int x : {8, 14}) tests::addBox(world, "slab", {x, 9, 9}, {x, 11, 11});
  Element element = square(6.5);  // the chamber is 5 x 3 x 3
  element.trials = 10'000;
  EXPECT_EQ(elementsOf(world, with(element)).size(), 0u);
  element.polygons = square(0.5).polygons;
  EXPECT_EQ(elementsOf(world, with(element)).size(), 1u);
}

TEST(Elements, FarLargerThanTheWorldCostNoTimeOrMemory) {
  const sim::World world = emptyWorld({55, 55, 30});
  Element element = square(1000.0);
  element.trials = 10'000;
  element.size = 100.0;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(elementsOf(world, with(element), 10.0).size(), 0u);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));  // a small part of one
}

TEST(Elements, AsManyAsTheRuleLanguageAllowsAllDrawTheirOwnNumbers) {
  const sim::World world = emptyWorld({22, 21, 21});
  RuleSet rules;
  Element speck = square(1e-9);  // in nobody's way
  speck.per_segment = 100.0;
  rules.elements.assign(64, speck);
  const auto placed = elementsOf(world, rules, 10.0);
  EXPECT_EQ(placed.size(), 64'000u);
  std::set<std::tuple<double, double, double>> attitudes;
  for (const auto& p : placed) attitudes.insert({p.element.position_vx.x, p.element.z.x, p.element.y.x});
  EXPECT_EQ(attitudes.size(), placed.size());
  EXPECT_EQ(placed.back().element.shape, 63);
}

TEST(Elements, OfOneSegmentShareVoxelsAndDoNotCross) {
  const sim::World world = emptyWorld({22, 21, 21});
  Element element = square(2.0);
  element.per_segment = 40.0;
  element.trials = 100;
  const auto placed = elementsOf(world, with(element));
  EXPECT_GT(placed.size(), 10u);
  std::set<std::tuple<int, int, int>> taken;
  std::size_t takes = 0;
  double area = 0.0, covered = 0.0;
  for (const auto& p : placed) {
    EXPECT_FALSE(p.takes.empty());
    for (const sim::Voxel v : p.takes) taken.insert({v.x, v.y, v.z});
    takes += p.takes.size();
    area += 4.0;
    covered += static_cast<double>(p.coverage) * static_cast<double>(p.takes.size());
  }
  EXPECT_GT(takes, 2 * taken.size());
  EXPECT_NEAR(covered, area, 1e-3);
  sim::Plant plant;
  plant.shapes = {{"square", element.polygons}};
  for (const auto& p : placed) plant.elements.push_back(p.element);
  EXPECT_EQ(tests::crossings({plant}), 0u);
}

TEST(Elements, CastShadeByWhatTheirPictureLeaves) {
  const sim::World world = emptyWorld({22, 21, 21});
  Element element = square(3.0);
  const auto whole = elementsOf(world, with(element));
  element.opacity = 0.25;
  const auto quarter = elementsOf(world, with(element));
  ASSERT_EQ(whole.size(), 1u);
  ASSERT_EQ(quarter.size(), 1u);
  EXPECT_EQ(quarter[0].takes, whole[0].takes);
  EXPECT_NEAR(quarter[0].coverage / whole[0].coverage, 0.25, 1e-6);
}

TEST(Elements, ThatCrossTakeNoHeedOfEachOther) {
  const sim::World world = emptyWorld({22, 21, 21});
  Element element = square(5.0);
  element.per_segment = 12.0;
  element.trials = 3;
  const std::size_t apart = elementsOf(world, with(element)).size();
  EXPECT_LT(apart, 12u);
  element.crosses = true;
  const auto all = elementsOf(world, with(element));
  EXPECT_EQ(all.size(), 12u);
  for (const auto& one : all) EXPECT_EQ(one.passage, sim::Passage::through);
}

TEST(Elements, StandInAnOrderWhereOneIsGiven) {
  const sim::World world = emptyWorld({22, 21, 21});
  Element element = square(0.3);
  element.phyllotaxis.emplace();
  element.phyllotaxis->spacing = {0.4};
  element.petiole.value = 1.0;
  const auto placed = elementsOf(world, with(element));
  ASSERT_EQ(placed.size(), 5u);  // along 2
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const Vec3 at = placed[i].element.position_vx;
    EXPECT_NEAR(at.x, 10.0 + 0.4 * static_cast<double>(i + 1), 1e-9);
    EXPECT_NEAR(glm::length(Vec3(0, at.y - 10.0, at.z - 10.0)), 1.0, 1e-9) << "a petiole away from the stem";
  }
}

}  // namespace
}  // namespace espalier::rules
