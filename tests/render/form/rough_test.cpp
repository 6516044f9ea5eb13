#include "render/form/rough.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/form/fbm.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/tile/tiling.h"
#include "tests/support/random_trees.h"
#include "tests/support/worlds.h"

namespace espalier {
namespace {

using sim::NodeId;
using sim::Vec3;
using Rough = sim::StemForm::Rough;

std::size_t at(NodeId n) {
  return static_cast<std::size_t>(n);
}

sim::Plant roughened(const sim::Plant& plant, const Rough& rough, const sim::World& world) {
  return render::roughened(plant, rough, world, [&](sim::Voxel v) { return world.occupied().at(v); });
}

sim::World openWorld(sim::Voxel size = sim::Voxel(200)) {
  return sim::World(tests::unitFrame(size));
}

void fill(sim::World& world, sim::Voxel low, sim::Voxel high) {
  const sim::PartId part = world.addPart(tests::scenePart("wall"));
  std::vector<sim::TiledVoxel> voxels;
  for (int y = low.y; y <= high.y; ++y) {
    for (int z = low.z; z <= high.z; ++z) {
      for (int x = low.x; x <= high.x; ++x) voxels.push_back({{x, y, z}, {.part = part, .coverage = 1.0f}});
    }
  }
  world.occupy(voxels);
}

/// A tree about the middle of the open world.
sim::Plant tree(std::uint32_t number) {
  sim::Plant plant;
  plant.skeleton = tests::randomTree(number, 120);
  for (Vec3& place : plant.skeleton.position_vx) place += Vec3(100.0, 60.0, 100.0);
  for (NodeId n = 0; n < plant.skeleton.size(); ++n)
    plant.skeleton.columns["number"].push_back(static_cast<float>(n));
  plant.key = number;
  return plant;
}

/// One limb of segments of two voxel widths, along x.
sim::Plant straightLimb(Vec3 from, int segments) {
  sim::Plant plant;
  for (int i = 0; i <= segments; ++i) {
    plant.skeleton.parent.push_back(i - 1);
    plant.skeleton.position_vx.push_back(from + Vec3(2.0 * i, 0.0, 0.0));
    plant.skeleton.born.push_back(i);
  }
  plant.key = 77;
  return plant;
}

/// Where each old node lies among the new ones: cut in their order.
std::vector<NodeId> placesOf(const sim::Plant& before, double detail_vx) {
  std::vector<NodeId> places;
  NodeId next = 0;
  for (NodeId n = 0; n < before.skeleton.size(); ++n) {
    const NodeId parent = before.skeleton.parent[at(n)];
    if (parent != sim::kNoNode) {
      const double length =
          glm::distance(before.skeleton.position_vx[at(n)], before.skeleton.position_vx[at(parent)]);
      next += std::max(1, static_cast<int>(std::lround(length / detail_vx))) - 1;
    }
    places.push_back(next++);
  }
  return places;
}

TEST(Roughened, KeepsForksJoinedAndSeedsAndTipsInTheirPlaces) {
  for (std::uint32_t number = 1; number <= 5; ++number) {
    const sim::Plant before = tree(number);
    const sim::Plant after = roughened(before, {0.6, 0.7, 4.0, 0.5}, openWorld());
    const std::vector<NodeId> places = placesOf(before, 0.5);
    ASSERT_EQ(after.skeleton.size(), places.back() + 1);
    std::vector<int> children(places.size(), 0);
    for (NodeId n = 0; n < before.skeleton.size(); ++n)
      if (before.skeleton.parent[at(n)] != sim::kNoNode) ++children[at(before.skeleton.parent[at(n)])];
    double moved = 0.0;
    for (NodeId n = 0; n < before.skeleton.size(); ++n) {
      const double far =
          glm::distance(before.skeleton.position_vx[at(n)], after.skeleton.position_vx[at(places[at(n)])]);
      moved = std::max(moved, far);
      const NodeId parent = before.skeleton.parent[at(n)];
      if (children[at(n)] == 0 || parent == sim::kNoNode) {
        EXPECT_LT(far, 1e-9) << "node " << n;
      }
      if (parent == sim::kNoNode) continue;
      // The pieces of a segment hang together from its parent's own place on.
      NodeId piece = places[at(n)];
      int pieces = 0;
      for (; piece != places[at(parent)] && pieces < 100; ++pieces) {
        EXPECT_EQ(after.skeleton.born[at(piece)], before.skeleton.born[at(n)]);
        EXPECT_EQ(after.skeleton.columns.at("number")[at(piece)], static_cast<float>(n));
        const NodeId below = after.skeleton.parent[at(piece)];
        ASSERT_LT(below, piece);
        // No leap: what a piece strays is a few deviations of the noise over its length.
        EXPECT_LT(glm::distance(after.skeleton.position_vx[at(piece)], after.skeleton.position_vx[at(below)]),
                  0.75 + 6.0 * 0.7 * std::pow(0.75 / 4.0, 0.6));
        piece = below;
      }
      ASSERT_EQ(piece, places[at(parent)]);
    }
    EXPECT_GT(moved, 0.5);
  }
}

TEST(Roughened, StraysByTheExponentThatWasAskedFor) {
  for (const double hurst : {0.3, 0.5, 0.7}) {
    const sim::World world = openWorld({2100, 80, 80});
    const sim::Plant after =
        roughened(straightLimb({20.0, 40.0, 40.0}, 1000), {hurst, 0.3, 2.0, 0.25}, world);
    const auto spread = [&](std::size_t lag) {
      double sum = 0.0;
      const auto& places = after.skeleton.position_vx;
      for (std::size_t i = lag; i < places.size(); ++i) {
        const Vec3 way = places[i] - places[i - lag];
        sum += way.y * way.y + way.z * way.z;
      }
      return sum / static_cast<double>(places.size() - lag);
    };
    EXPECT_NEAR(0.5 * std::log2(spread(64) / spread(1)) / 6.0, hurst, 0.06);
    EXPECT_NEAR(std::sqrt(0.5 * spread(8)), 0.3, 0.06) << "over two voxel widths, along an axis";
  }
}

TEST(Roughened, FollowsFromThePlantsKeyOnAnyNumberOfThreads) {
  const sim::World world = openWorld();
  const Rough rough{0.6, 0.7, 4.0, 0.5};
  sim::Plant plant = tree(3);
  const auto places = roughened(plant, rough, world).skeleton.position_vx;
  for (const int threads : {1, 2, 5}) {
    sim::onThreads(
        threads, [&] { EXPECT_EQ(roughened(plant, rough, world).skeleton.position_vx, places) << threads; });
  }
  plant.key += 1;
  EXPECT_NE(roughened(plant, rough, world).skeleton.position_vx, places);
  const auto calm = roughened(plant, {0.6, 0.0, 4.0, 100.0}, world);
  EXPECT_EQ(calm.skeleton.position_vx, plant.skeleton.position_vx) << "no amplitude, no pieces";
}

TEST(Roughened, StaysOutOfSolidsAndInTheWorld) {
  for (std::uint64_t key = 1; key <= 12; ++key) {
    sim::World world = openWorld({120, 24, 24});
    // A passage five voxels wide, through a hole of one.
    fill(world, {20, 0, 0}, {60, 9, 23});
    fill(world, {20, 15, 0}, {60, 23, 23});
    fill(world, {70, 0, 0}, {70, 23, 11});
    fill(world, {70, 0, 13}, {70, 23, 23});
    sim::Plant plant = straightLimb({2.0, 12.0, 12.0}, 57);
    plant.key = key;
    const sim::Plant after = roughened(plant, {0.6, 6.0, 20.0, 0.5}, world);
    std::vector<sim::Voxel> voxels;
    double strayed = 0.0, in_passage = 0.0;
    for (NodeId n = 1; n < after.skeleton.size(); ++n) {
      const Vec3 place = after.skeleton.position_vx[at(n)];
      sim::tileSegment(after.skeleton.position_vx[at(n - 1)], place, voxels);
      const double off = std::hypot(place.y - 12.0, place.z - 12.0);
      strayed = std::max(strayed, off);
      if (place.x > 30 && place.x < 50) in_passage = std::max(in_passage, off);
    }
    for (const sim::Voxel voxel : voxels) {
      ASSERT_TRUE(sim::contains(world.frame().size, voxel)) << "key " << key;
      ASSERT_FALSE(world.occupied().at(voxel)) << voxel.x << ' ' << voxel.y << ' ' << voxel.z;
    }
    EXPECT_GT(strayed, 3.0) << "where there is room it takes it";
    EXPECT_GT(in_passage, 0.02) << "and some in the passage";
  }
}

TEST(Roughened, StraysAlongASurfaceThatIsNear) {
  sim::World world = openWorld({140, 30, 60});
  fill(world, {0, 0, 0}, {139, 5, 59});
  const auto spreads = [&] {
    const sim::Plant after = roughened(straightLimb({10.0, 7.0, 30.0}, 60), {0.6, 2.0, 10.0, 0.5}, world);
    Vec3 most(0.0);
    for (const Vec3 place : after.skeleton.position_vx)
      most = glm::max(most, glm::abs(place - Vec3(place.x, 7.0, 30.0)));
    return most;
  };
  EXPECT_GT(spreads().y, 0.4) << "without boundary layers nothing is near";
  world.setLayers(4);
  EXPECT_GT(spreads().z, 2.0);
  EXPECT_LT(spreads().y, 1e-6);
}

TEST(Roughened, TakesWhatIsPlacedAlong) {
  sim::Plant plant = straightLimb({20.0, 60.0, 60.0}, 40);
  for (const double share : {0.0, 0.3, 1.0}) {
    sim::PlacedElement element;
    element.node = 21;
    element.position_vx = Vec3(60.0 + 2.0 * share, 60.0, 60.0);
    plant.elements.push_back(element);
  }
  const sim::Plant after = roughened(plant, {0.6, 2.0, 10.0, 0.2}, openWorld());
  for (const sim::PlacedElement& element : after.elements) {
    const Vec3 to = after.skeleton.position_vx[at(element.node)],
               from = after.skeleton.position_vx[at(after.skeleton.parent[at(element.node)])];
    const double share = glm::dot(element.position_vx - from, to - from) / glm::dot(to - from, to - from);
    EXPECT_GE(share, -1e-6);
    EXPECT_LE(share, 1.0 + 1e-6);
    EXPECT_LT(glm::distance(element.position_vx, glm::mix(from, to, share)), 1e-6) << "on its piece";
    EXPECT_GT(glm::distance(from, Vec3(from.x, 60.0, 60.0)), 0.1) << "which strays";
  }
}

TEST(Roughened, RefusesWhatIsNoLengthAndTooManyPieces) {
  const sim::World world = openWorld({20, 20, 20});
  const sim::Plant plant = straightLimb({2.0, 10.0, 10.0}, 5);
  EXPECT_THROW(roughened(plant, {0.6, 1.0, 4.0, 0.0}, world), sim::InputError);
  EXPECT_THROW(roughened(plant, {0.6, 1.0, 0.0, 1.0}, world), sim::InputError);
  EXPECT_THROW(roughened(plant, {0.6, -1.0, 4.0, 1.0}, world), sim::InputError);
  EXPECT_THROW(roughened(plant, {1.0, 1.0, 4.0, 1.0}, world), sim::InputError);
  EXPECT_THROW(roughened(plant, {0.6, 1.0, 4.0, 1e-7}, world), sim::InputError);
}

}  // namespace
}  // namespace espalier
