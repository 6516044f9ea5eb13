#include <gtest/gtest.h>

#include "sim/base/parallel.h"
#include "sim/grow/state.h"
#include "tests/support/crossings.h"
#include "tests/support/lively.h"
#include "tests/support/plots.h"

/// Cover as dense as leaves can be laid: they share voxels and never cross.
namespace espalier {
namespace {

using sim::Vec3;

/// Creeps over a wall, with more leaves than there is room for.
rules::RuleSet creeper() {
  rules::RuleSet rules = tests::lively();
  rules.bias = {};
  rules.bias.toward = 0.1;
  rules.require.exposure_min = 0.0;
  rules.require.proximity_max = {3.0};
  rules.prefer = {true, {1.5}};
  rules.light.boost = 1.0;
  rules.random_tree.wander_deg = 40.0;
  rules.random_tree.branch_age_max = 2;
  rules.elements[0].per_segment = 6.0;
  rules.elements[0].polygons = {{{0, 0.2, 0}, {-0.6, 0.6, -0.1}, {0, 1.4, 0}},
                                {{0, 0.2, 0}, {0, 1.4, 0}, {0.6, 0.6, -0.1}}};
  return rules;
}

constexpr sim::Voxel kYard{26, 24, 16};

std::vector<sim::Planting> plantings(const sim::World& world) {
  auto all = tests::planting(world, creeper(), {{6, 2, 11}, {19, 2, 11}});
  all.push_back(tests::planting(world, creeper(), {{12, 2, 11}}, "another")[0]);
  return all;
}

struct Covered {
  sim::World world = tests::wallPlot(kYard);
  sim::Growth growth;
  explicit Covered(int iterations = 18)
      : growth(sim::grow(world, plantings(world), tests::brightSettings(iterations))) {}
};

double areaOf(const sim::Plant& plant) {
  double area = 0.0;
  for (const auto& e : plant.elements) {
    for (const auto& polygon : plant.shapes[0].polygons) {
      const Vec3 a = sim::placed(e, polygon[0]), b = sim::placed(e, polygon[1]),
                 c = sim::placed(e, polygon[2]);
      area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
  }
  return area;
}

TEST(Cover, IsDenserThanVoxelsAndNothingCrosses) {
  const Covered covered;
  const auto& plants = covered.growth.plants;
  double area = 0.0;
  std::size_t leaves = 0, voxels = 0;
  for (const sim::Plant& plant : plants) {
    EXPECT_GT(plant.skeleton.size(), 20);
    area += areaOf(plant);
    leaves += plant.elements.size();
  }
  for (const auto& tiled : covered.world.surfaces())
    voxels += covered.world.part(tiled.surface.part).kind == sim::PartKind::element;
  // Each leaf lies in three or four voxels: had it to have them for itself, there would be room for a third.
  EXPECT_GT(static_cast<double>(leaves), 1.2 * static_cast<double>(voxels));
  constexpr double kWall = kYard.x * (kYard.y * 2.0 / 3.0);
  EXPECT_GT(area, 6.0 * kWall);  // and it reaches no farther than three voxels from it
  EXPECT_EQ(tests::crossings(plants), 0u);
  EXPECT_EQ(tests::piercings(plants), 0u);
}

TEST(Cover, IsTheSameOnAnyNumberOfThreadsAndResumed) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 5}) {
    sim::onThreads(threads, [&] {
      const Covered covered;
      hashes.push_back(sim::stateHash(covered.world, covered.growth));
    });
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);

  sim::World first = tests::wallPlot(kYard), second = tests::wallPlot(kYard);
  const sim::BitVolume site = first.occupied();
  const auto half = sim::grow(first, plantings(first), tests::brightSettings(9));
  const auto planted = plantings(second);
  sim::Growing growing(
      second, planted, tests::brightSettings(18),
      sim::restore(sim::readState(sim::stateBytes({}, first, site, half), "f"), second, planted, "f"));
  while (growing.step()) {
  }
  EXPECT_EQ(sim::stateHash(second, growing.growth()), hashes[0]);
  const Covered shorter(17);
  EXPECT_NE(sim::stateHash(shorter.world, shorter.growth), hashes[0]);  // an iteration less would show
}

}  // namespace
}  // namespace espalier
