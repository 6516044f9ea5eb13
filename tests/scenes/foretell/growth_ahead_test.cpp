#include "scenes/foretell/growth_ahead.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/worlds.h"

namespace espalier::scenes {
namespace {

constexpr int kSide = 256, kHigh = 24;

sim::World floorWorld() {
  sim::World world({sim::Vec3(0.0), 0.1, {kSide, kHigh, kSide}});
  const sim::PartId part = world.addPart({"floor", "stone", sim::PartKind::scene, -1});
  std::vector<sim::TiledVoxel> floor;
  for (int z = 0; z < kSide; ++z)
    for (int x = 0; x < kSide; ++x) floor.push_back({{x, 0, z}, {part, sim::Colour(0.5f), 1.0f}});
  world.occupy(floor);
  return world;
}

/// A cover that spreads by a voxel an iteration from a corner of a floor, as far as `reach`, and lays a node
/// in each voxel `thick` times, one after the other.
sim::Plant coverAfter(int iterations, int thick, int reach = kSide) {
  sim::Plant plant;
  sim::Skeleton& s = plant.skeleton;
  for (int z = 0; z < kSide; ++z) {
    for (int x = 0; x < kSide; ++x) {
      const int comes = static_cast<int>(std::hypot(x, z));
      if (comes >= reach) continue;
      for (int i = 0; i < thick && comes + i <= iterations; ++i) {
        s.parent.push_back(s.parent.empty() ? sim::kNoNode : 0);
        s.position_vx.push_back({x, 1.0 + i, z});
        s.born.push_back(comes + i);
      }
    }
  }
  return plant;
}

double segmentsOf(const sim::Plant& plant) {
  return static_cast<double>(plant.skeleton.parent.size()) - 1.0;
}

TEST(GrowthAhead, OfACoverThatSpreadsAndOneThatHasFilledItsFloor) {
  const sim::World world = floorWorld();
  const sim::Bricks near = bricksNearSurfaces(world);
  for (const int thick : {1, 3}) {
    for (const auto& [known, wanted] : {std::pair{60, 120}, {60, 180}, {120, 240}, {150, 500}, {300, 400}}) {
      const std::vector<sim::Plant> plants{coverAfter(known, thick)};
      const double truth = segmentsOf(coverAfter(wanted, thick));
      const double told = segmentsAhead(plants, near, known, wanted - known);
      EXPECT_GT(told, truth / 1.5) << known << " " << wanted << " " << thick;
      EXPECT_LT(told, truth * 1.5) << known << " " << wanted << " " << thick;
    }
  }
}

TEST(GrowthAhead, GrowthThatEndedHasEnded) {
  const sim::World world = floorWorld();
  const sim::Bricks near = bricksNearSurfaces(world);
  const std::vector<sim::Plant> plants{coverAfter(200, 1, 60)};
  EXPECT_NEAR(segmentsAhead(plants, near, 200, 100), segmentsOf(plants[0]), 0.02 * segmentsOf(plants[0]));
  EXPECT_EQ(segmentsAhead(plants, near, 200, 0), segmentsOf(plants[0]));
}

TEST(GrowthAhead, SurfacesThatCannotBeReachedDoNotCount) {
  // The same floor, and a second one far above it.
  sim::World world = floorWorld();
  const sim::Bricks one = bricksNearSurfaces(world);
  sim::World two({sim::Vec3(0.0), 0.1, {kSide, 64, kSide}});
  const sim::PartId part = two.addPart({"floor", "stone", sim::PartKind::scene, -1});
  std::vector<sim::TiledVoxel> floors;
  for (const int y : {0, 40})
    for (int z = 0; z < kSide; ++z)
      for (int x = 0; x < kSide; ++x) floors.push_back({{x, y, z}, {part, sim::Colour(0.5f), 1.0f}});
  two.occupy(floors);
  const std::vector<sim::Plant> plants{coverAfter(200, 1)};
  EXPECT_EQ(segmentsAhead(plants, one, 200, 300), segmentsAhead(plants, bricksNearSurfaces(two), 200, 300));
}

TEST(GrowthAhead, SeedsAloneForetellNothing) {
  const sim::World world = floorWorld();
  sim::Plant seed;
  seed.skeleton.parent = {sim::kNoNode};
  seed.skeleton.position_vx = {sim::Vec3(3.0)};
  seed.skeleton.born = {0};
  EXPECT_EQ(segmentsAhead(std::vector{seed}, bricksNearSurfaces(world), 0, 50), 0.0);
  EXPECT_EQ(segmentsAhead({}, bricksNearSurfaces(world), 0, 50), 0.0);
}

}  // namespace
}  // namespace espalier::scenes
