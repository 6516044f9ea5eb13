#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/world/world.h"
#include "tests/support/worlds.h"

namespace espalier::sim {
namespace {

struct Random {
  std::mt19937 bits;
  int below(int n) { return static_cast<int>(bits() % static_cast<unsigned>(n)); }
};

/// Parts in any order, some of a plant, which must not count.
World randomWorld(Random& random, Voxel size, int voxels, int parts) {
  World world(tests::unitFrame(size));
  for (int i = 0; i < parts; ++i) {
    world.addPart(i % 4 == 2 ? tests::stemPart("part") : tests::scenePart("part"));
  }
  std::vector<TiledVoxel> tiles;
  for (int i = 0; i < voxels; ++i) {
    const PartId part = 1 + random.below(parts);
    tiles.push_back({{random.below(size.x), random.below(size.y), random.below(size.z)}, {.part = part}});
  }
  world.occupy(tiles);
  return world;
}

void expectLayers(const World& world, int layers) {
  std::vector<std::pair<Voxel, PartId>> scene;
  for (const auto& [voxel, surface] : world.surfaces()) {
    if (world.part(surface.part).kind == PartKind::scene) scene.emplace_back(voxel, surface.part);
  }
  const Voxel size = world.frame().size;
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        int layer = layers + 1;
        std::pair<int, PartId> nearest{1 << 30, kFree};
        for (const auto& [voxel, part] : scene) {
          const Voxel d = glm::abs(voxel - Voxel(x, y, z));
          layer = std::min(layer, std::max({d.x, d.y, d.z}));
          nearest = std::min(nearest, {d.x * d.x + d.y * d.y + d.z * d.z, part});
        }
        const auto found = world.nearnessAt({x, y, z});
        ASSERT_EQ(found.has_value(), layer <= layers) << x << ' ' << y << ' ' << z;
        const double steps = 256.0 * (found && layers > 0 ? std::sqrt(nearest.first) : layers + 1.0);
        ASSERT_NEAR(world.nearSteps().at({x, y, z}), steps, 0.51);
        if (!found) continue;
        ASSERT_EQ(found->layer, layer);
        ASSERT_EQ(found->part, nearest.second) << x << ' ' << y << ' ' << z;
        ASSERT_EQ(found->distance_vx, std::sqrt(static_cast<float>(nearest.first)));
      }
    }
  }
}

TEST(Layers, EqualBruteForceInSmallWorlds) {
  Random random{std::mt19937(1)};
  for (int layers = 0; layers <= 6; ++layers) {
    for (int i = 0; i < 6; ++i) {
      const Voxel size(1 + random.below(30), 1 + random.below(24), 1 + random.below(24));
      World world = randomWorld(random, size, 1 + random.below(i % 2 == 0 ? 5 : 120), 1 + random.below(7));
      world.setLayers(layers);
      EXPECT_EQ(world.layers(), layers);
      expectLayers(world, layers);
      if (testing::Test::HasFailure()) FAIL() << "layers " << layers << " of world " << i;
    }
  }
}

TEST(Layers, CanBeManyAndLongKeysAgreeWithShortOnes) {
  Random random{std::mt19937(2)};
  World world = randomWorld(random, {50, 45, 55}, 4, 3);
  world.setLayers(20);
  expectLayers(world, 20);
  for (int i = 0; i < (1 << 18); ++i)
    world.addPart(tests::scenePart("filler"));  // part numbers too long for 32 bits
  world.setLayers(20);
  expectLayers(world, 20);
}

TEST(Layers, AnswerAcrossWordAndBlockBorders) {
  World world(tests::unitFrame({140, 3, 3}));
  for (int i = 0; i < 3; ++i) world.addPart(tests::scenePart("a"));
  world.occupy(std::vector<TiledVoxel>{
      {{63, 1, 1}, {.part = 3}}, {{64, 1, 1}, {.part = 1}}, {{128, 0, 2}, {.part = 2}}});
  for (const int layers : {1, 7, 8, 33, 64}) {
    world.setLayers(layers);
    expectLayers(world, layers);
  }
}

TEST(Layers, ReplaceWhatWasKnownAndIgnorePlants) {
  World world(tests::unitFrame(Voxel(12)));
  const PartId wall = world.addPart(tests::scenePart("wall"));
  const PartId stem = world.addPart(tests::stemPart("ivy"));
  world.occupy(std::vector<TiledVoxel>{{{2, 2, 2}, {.part = wall}}, {{8, 8, 8}, {.part = stem}}});
  world.setLayers(3);
  EXPECT_TRUE(world.nearnessAt({5, 5, 5}));
  EXPECT_FALSE(world.nearnessAt({8, 8, 8}));
  world.setLayers(1);
  EXPECT_FALSE(world.nearnessAt({5, 5, 5}));
  EXPECT_EQ(world.nearnessAt({3, 3, 3})->distance_vx, std::sqrt(3.0f));
}

TEST(Layers, StepsLieWhereNearStepsSays) {
  World world(tests::unitFrame({20, 30, 40}));
  const PartId wall = world.addPart(tests::scenePart("wall"));
  EXPECT_EQ(world.nearSteps().at({3, 12, 33}), 256);  // nothing is known: farther than no layer
  world.occupy(std::vector<TiledVoxel>{{{3, 12, 33}, {.part = wall}}});
  world.setLayers(3);
  const NearSteps near = world.nearSteps();
  EXPECT_EQ(near.blocks, Voxel(3, 4, 5));
  const std::uint32_t begin = near.block[(1 * 5 + 4) * 3 + 0];  // y 8 to 15, z 32 to 39, x 0 to 7
  EXPECT_EQ(begin % 512, 0u);
  EXPECT_GT(begin, 0u);
  EXPECT_EQ(near.steps[begin + (4 << 6 | 1 << 3 | 3)], 0);
  EXPECT_EQ(near.steps[begin + (4 << 6 | 1 << 3 | 5)], 512);
  EXPECT_EQ(near.steps[begin + (4 << 6 | 2 << 3 | 4)], 362);   // 256 sqrt(2)
  EXPECT_EQ(near.steps[begin + (7 << 6 | 4 << 3 | 6)], 1330);  // 256 sqrt(27): farther than a fourth layer
  EXPECT_EQ(near.steps[begin + (4 << 6 | 5 << 3 | 3)], 4 * 256);
  EXPECT_EQ(near.block[0], 0u);
  EXPECT_EQ(near.steps[0], 4 * 256);
  std::uint32_t last = 0;  // that 32 bits can be loaded from anywhere is for the sanitizers to see
  const std::size_t blocks = 3 * 4 * 5;
  std::memcpy(&last, near.steps + *std::max_element(near.block, near.block + blocks) + 511, sizeof last);
  EXPECT_EQ(last & 0xffff, 4u * 256);
}

TEST(Layers, StepsOfTheFarthestFit) {
  World world(tests::unitFrame({130, 130, 130}));
  world.addPart(tests::scenePart("grain"));
  world.occupy(std::vector<TiledVoxel>{{{0, 0, 0}, {.part = 1}}});
  world.setLayers(128);
  EXPECT_EQ(world.nearSteps().at(Voxel(128)), 56756);  // 256 * 128 sqrt(3)
  EXPECT_EQ(world.nearSteps().at(Voxel(129)), 129 * 256);
}

TEST(Layers, OfAnEmptyWorldAreEmpty) {
  World world(tests::unitFrame(Voxel(10)));
  world.setLayers(4);
  EXPECT_EQ(world.layers(), 4);
  EXPECT_FALSE(world.nearnessAt(Voxel(5)));
}

TEST(Layers, AreTheSameOnAnyNumberOfThreads) {
  const auto make = [](int threads, int layers = 4) {
    Random random{std::mt19937(3)};
    World world = randomWorld(random, {60, 40, 50}, 300, 5);
    sim::onThreads(threads, [&] { world.setLayers(layers); });
    return world;
  };
  const World one = make(1);
  EXPECT_EQ(tests::differenceOf(one, make(2)), "");
  EXPECT_EQ(tests::differenceOf(one, make(5)), "");
  EXPECT_NE(tests::differenceOf(one, make(1, 3)), "");  // which it would tell
}

TEST(Layers, RefuseANumberOutOfRange) {
  World world(tests::unitFrame(Voxel(3)));
  EXPECT_THROW(world.setLayers(-1), InputError);
  EXPECT_THROW(world.setLayers(129), InputError);
}

}  // namespace
}  // namespace espalier::sim
