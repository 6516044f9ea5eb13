#include <gtest/gtest.h>

#include <algorithm>
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

TEST(Layers, OfAnEmptyWorldAreEmpty) {
  World world(tests::unitFrame(Voxel(10)));
  world.setLayers(4);
  EXPECT_EQ(world.layers(), 4);
  EXPECT_FALSE(world.nearnessAt(Voxel(5)));
}

TEST(Layers, AreTheSameOnAnyNumberOfThreads) {
  const auto make = [](int threads) {
    Random random{std::mt19937(3)};
    World world = randomWorld(random, {60, 40, 50}, 300, 5);
    sim::onThreads(threads, [&] { world.setLayers(4); });
    return world;
  };
  const World one = make(1);
  tests::expectSameWorld(one, make(2));
  tests::expectSameWorld(one, make(5));
}

TEST(Layers, RefuseANumberOutOfRange) {
  World world(tests::unitFrame(Voxel(3)));
  EXPECT_THROW(world.setLayers(-1), InputError);
  EXPECT_THROW(world.setLayers(100000), InputError);
}

}  // namespace
}  // namespace espalier::sim
