#include "sim/world/world.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "sim/base/error.h"
#include "sim/world/world_grids.h"
#include "tests/support/worlds.h"

namespace espalier::sim {
namespace {

TiledVoxel tile(Voxel v, PartId part, float shade = 0.5f) {
  return {v, {.part = part, .colour = Colour(shade), .coverage = 0.25f, .normal = Vec3f(0, 1, 0)}};
}

TEST(World, TellsBackWhatOccupiesIt) {
  World world(tests::unitFrame({40, 33, 70}));
  const PartId wall = world.addPart({.object = "house", .region = "wall"});
  const PartId leaf =
      world.addPart({.object = "ivy", .region = "leaf", .kind = PartKind::element, .plant = 0});
  EXPECT_EQ(wall, 1);
  EXPECT_EQ(leaf, 2);
  EXPECT_EQ(world.part(leaf).region, "leaf");
  const std::vector<TiledVoxel> voxels{tile({39, 32, 69}, wall, 0.1f), tile({0, 0, 0}, leaf, 0.2f),
                                       tile({7, 8, 64}, wall, 0.3f)};
  world.occupy(voxels);
  for (const auto& [voxel, surface] : voxels) {
    EXPECT_EQ(world.partAt(voxel), surface.part);
    const auto found = world.surfaceAt(voxel);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->part, surface.part);
    EXPECT_EQ(found->colour, surface.colour);
    EXPECT_EQ(found->coverage, surface.coverage);
    EXPECT_EQ(found->normal, surface.normal);
    EXPECT_TRUE(world.occupied().at(voxel));
  }
  for (const Voxel v : {Voxel(1, 0, 0), Voxel(20), Voxel(-1, 0, 0), Voxel(0, 33, 0), Voxel(1 << 30)}) {
    EXPECT_EQ(world.partAt(v), kFree);
    EXPECT_FALSE(world.surfaceAt(v));
    EXPECT_FALSE(world.nearnessAt(v));
  }
}

TEST(World, AnOccupiedVoxelKeepsWhatItHas) {
  World world(tests::unitFrame(Voxel(8)));
  const PartId first = world.addPart(tests::scenePart("first"));
  const PartId second = world.addPart(tests::scenePart("second"));
  world.occupy(std::vector{tile(Voxel(3), first), tile(Voxel(3), second), tile(Voxel(4), first)});
  world.occupy(std::vector{tile(Voxel(4), second), tile(Voxel(5), second)});
  EXPECT_EQ(world.partAt(Voxel(3)), first);
  EXPECT_EQ(world.partAt(Voxel(4)), first);
  EXPECT_EQ(world.partAt(Voxel(5)), second);
  EXPECT_EQ(world.occupied().count(), 3u);
  EXPECT_EQ(world.solid().words(), world.occupied().words());
}

/// A world with a part of each kind and of another plant, and what a voxel of it becomes.
struct Mixed {
  World world{tests::unitFrame(Voxel(16))};
  PartId wall = world.addPart(tests::scenePart("wall"));
  PartId stem = world.addPart(tests::stemPart("ivy"));
  PartId leaf = world.addPart(tests::elementPart("ivy"));
  PartId other_stem = world.addPart(tests::stemPart("vine"));
  PartId other_leaf = world.addPart(tests::elementPart("vine"));

  static Surface surface(PartId part, float coverage) {
    const auto shade = static_cast<float>(part);
    return {part, Colour(shade / 8), coverage, Vec3f(shade, 0, 0), shade / 16};
  }
  void add(PartId part, float coverage, Voxel v = Voxel(3)) {
    world.occupy(std::vector<TiledVoxel>{{v, surface(part, coverage)}});
  }
  /// All but the coverage as it was given for a part.
  void expect(PartId part, float coverage, bool solid) {
    const Surface found = world.surfaceAt(Voxel(3)).value_or(Surface{});
    const Surface given = surface(part, coverage);
    EXPECT_EQ(found.part, part);
    EXPECT_EQ(world.partAt(Voxel(3)), part);
    EXPECT_EQ(found.colour, given.colour);
    EXPECT_EQ(found.normal, given.normal);
    EXPECT_EQ(found.offset_vx, given.offset_vx);
    EXPECT_EQ(found.coverage, coverage);
    EXPECT_TRUE(world.occupied().at(Voxel(3)));
    EXPECT_EQ(world.solid().at(Voxel(3)), solid);
  }
};

TEST(World, ElementsShareAVoxelAndTheirCoveragesAddUp) {
  Mixed m;
  m.add(m.leaf, 0.25f);
  m.expect(m.leaf, 0.25f, false);
  m.add(m.leaf, 0.5f);
  m.add(m.other_leaf, 0.75f);
  m.expect(m.leaf, 1.5f, false);
  EXPECT_EQ(m.world.solid().count(), 0u);
}

TEST(World, AStemTakesAVoxelOverFromElements) {
  Mixed m;
  m.add(m.leaf, 0.25f);
  m.add(m.other_leaf, 0.5f);
  m.add(m.other_stem, 0.125f);
  m.expect(m.other_stem, 0.875f, true);
}

TEST(World, AStemKeepsItsVoxel) {
  Mixed m;
  m.add(m.stem, 0.5f);
  m.expect(m.stem, 0.5f, true);
  m.add(m.leaf, 0.25f);
  m.add(m.other_stem, 0.75f);
  m.expect(m.stem, 1.5f, true);
}

TEST(World, TheSceneKeepsItsVoxelAndTakesNoneFromPlants) {
  Mixed m;
  m.add(m.wall, 0.5f);
  for (const PartId part : {m.stem, m.leaf, m.wall}) m.add(part, 0.25f);
  m.expect(m.wall, 0.5f, true);
  Mixed grown;
  grown.add(grown.leaf, 0.5f);
  grown.add(grown.wall, 1.0f);
  grown.expect(grown.leaf, 0.5f, false);
  const Surface wall = Mixed::surface(grown.wall, 1.0f);
  grown.world.occupyClear(std::vector<TiledVoxel>{{Voxel(3), wall}, {Voxel(4), wall}});
  grown.world.occupyBlocks(std::vector<TiledVoxel>{{Voxel(8), wall}});
  grown.expect(grown.leaf, 0.5f, false);
  EXPECT_TRUE(grown.world.solid().at(Voxel(4)));
  EXPECT_EQ(grown.world.solid().count(), 1u + 512u);
  grown.add(grown.leaf, 0.5f, Voxel(9));
  EXPECT_EQ(grown.world.partAt(Voxel(9)), grown.wall);
}

/// Of leaves upon leaves and stems through them: what takes light is that of a world which got the sums at
/// once, as one does that is restored.
TEST(World, WhatTakesLightFollowsFromPlaceKindAndCoverage) {
  Mixed m;
  std::mt19937 random(11);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::size_t opaque = 0;
  for (int round = 0; round < 8; ++round) {
    for (int i = 0; i < 1500; ++i) {
      const PartId part = i % 50 == 0 ? m.wall : i % 5 == 0 ? m.stem : m.leaf;
      m.add(part, 0.125f * static_cast<float>(1 + below(6)), {below(16), below(16), below(16)});
    }
    World at_once(m.world.frame());
    for (const Part& part : m.world.parts()) at_once.addPart(part);
    at_once.occupy(m.world.surfaces());
    EXPECT_EQ(tests::differenceOf(at_once, m.world), "");
    EXPECT_GT(m.world.opaque().count(), opaque);
    opaque = m.world.opaque().count();
  }
  for (int i = 0; i < 24; ++i) m.add(m.leaf, 0.125f, Voxel(5, 6, 7));
  EXPECT_TRUE(m.world.opaque().at({5, 6, 7}));  // three leaf areas of a face stop every ray
  for (int x = 0; x < 16; ++x) {
    World world(tests::unitFrame(Voxel(16)));
    world.addPart(tests::stemPart("ivy"));
    world.occupy(std::vector<TiledVoxel>{{{x, 0, 0}, {.part = 1, .coverage = 2.0f}}});
    EXPECT_EQ(world.opaque().count(), 1u);
  }
}

TEST(World, ACopyIsTheSameAndStandsForItself) {
  Mixed m;
  m.add(m.wall, 1.0f, {2, 9, 9});
  m.add(m.leaf, 0.5f);
  m.add(m.stem, 0.5f, {12, 3, 3});
  m.add(m.leaf, 0.5f, {12, 3, 3});
  m.world.setLayers(2);
  auto original = std::make_unique<Mixed>(m);
  Mixed copy(*original);
  original.reset();
  EXPECT_EQ(tests::differenceOf(copy.world, m.world), "");
  copy.add(copy.stem, 0.25f);
  copy.expect(copy.stem, 0.75f, true);
  m.expect(m.leaf, 0.5f, false);
  copy.world.setLayers(4);
  EXPECT_EQ(m.world.nearSteps().at({2, 9, 5}), 3 * 256);
  EXPECT_EQ(copy.world.nearSteps().at({2, 9, 5}), 4 * 256);
}

// Of every kind of edit, in a world whose bricks reach beyond it.
TEST(World, KeepsTheBricksInWhichAnythingTakesLight) {
  const Voxel size(75, 50, 66);
  World world(tests::unitFrame(size));
  const PartId parts[] = {world.addPart(tests::scenePart("wall")), world.addPart(tests::stemPart("ivy")),
                          world.addPart(tests::elementPart("ivy"))};
  std::mt19937 random(41);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto voxels = [&](int count, PartId part) {
    std::vector<TiledVoxel> tiled;
    for (int i = 0; i < count; ++i)
      tiled.push_back({{below(size.x), below(size.y), below(size.z)},
                       {.part = part, .coverage = 0.1f * static_cast<float>(below(30))}});
    return tiled;
  };
  EXPECT_TRUE(tests::keepsItsBricks(world));
  for (int round = 0; round < 12; ++round) {
    const auto before = world.opaque().count();
    const World copy(world);
    for (const PartId part : parts) world.occupy(voxels(3, part));
    world.occupyClear(voxels(2, parts[0]));
    BitVolume more(size);
    for (const TiledVoxel& tiled : voxels(2, parts[0])) more.set(tiled.voxel);
    world.addOpaque(more);
    const Voxel block(8 * below(9), 8 * below(6), 8 * below(8));
    if (!Bricks(world.occupied()).bits().at(block / 8))
      world.occupyBlocks(std::vector<TiledVoxel>{{block, {.part = parts[0]}}});
    ASSERT_TRUE(tests::keepsItsBricks(world));
    EXPECT_GT(world.opaque().count(), before);
    // The copy stands for itself, and so does one that is changed.
    ASSERT_TRUE(tests::keepsItsBricks(copy));
    World other = copy;
    other.occupy(voxels(5, parts[1]));
    ASSERT_TRUE(tests::keepsItsBricks(other));
    ASSERT_TRUE(tests::keepsItsBricks(copy));
    World moved(std::move(other));
    moved.occupy(voxels(5, parts[2]));
    ASSERT_TRUE(tests::keepsItsBricks(moved));
    other = world;
    ASSERT_TRUE(tests::keepsItsBricks(other));
  }
}

TEST(World, RefusesVoxelsOutsideInEveryBuild) {
  World world(tests::unitFrame(Voxel(8)));
  const PartId part = world.addPart(tests::scenePart("wall"));
  for (const Voxel v : {Voxel(8, 0, 0), Voxel(0, -1, 0), Voxel(3, 3, 1000)}) {
    EXPECT_THROW(world.occupy(std::vector{tile(v, part)}), BrokenContract);
  }
  EXPECT_EQ(world.occupied().count(), 0u);
}

TEST(World, EditsRaiseTheVersion) {
  World world(tests::unitFrame(Voxel(8)));
  const PartId part = world.addPart(tests::scenePart("a"));
  const auto before = world.version();
  world.occupy(std::vector{tile(Voxel(1), part)});
  const auto after = world.version();
  EXPECT_GT(after, before);
  world.setLayers(1);
  EXPECT_GT(world.version(), after);
}

TEST(World, GridsAgreeWithItAndShareOneTransform) {
  const Frame frame{.origin_m = {1.5, -2.0, 10.0}, .voxel_m = 0.25, .size = {30, 20, 25}};
  World world(frame);
  world.addPart(tests::scenePart("a"));
  world.addPart(tests::scenePart("b"));
  std::mt19937 random(5);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<TiledVoxel> voxels;
  for (int i = 0; i < 400; ++i) {
    voxels.push_back(tile({below(30), below(20), below(25)}, 1 + below(2), static_cast<float>(i)));
  }
  world.occupy(voxels);
  world.setLayers(2);
  const World::Grids& grids = world.grids();
  EXPECT_EQ(grids.part->activeVoxelCount(), world.occupied().count());
  EXPECT_EQ(grids.layer->activeVoxelCount(), grids.nearest->activeVoxelCount());
  EXPECT_EQ(grids.layer->activeVoxelCount(), grids.distance_vx->activeVoxelCount());
  std::size_t near = 0;
  for (int y = 0; y < frame.size.y; ++y) {
    for (int z = 0; z < frame.size.z; ++z) {
      for (int x = 0; x < frame.size.x; ++x) {
        const Voxel v(x, y, z);
        const openvdb::Coord at = coordOf(v);
        EXPECT_EQ(grids.part->tree().getValue(at), world.partAt(v));
        EXPECT_EQ(grids.colour->tree().isValueOn(at), world.occupied().at(v));
        const Surface s = world.surfaceAt(v).value_or(Surface{});
        EXPECT_EQ(grids.colour->tree().getValue(at).x(), s.colour.x);
        EXPECT_EQ(grids.coverage->tree().getValue(at), s.coverage);
        const auto n = world.nearnessAt(v);
        ASSERT_EQ(grids.layer->tree().isValueOn(at), n.has_value());
        EXPECT_EQ(grids.layer->tree().getValue(at), n ? n->layer : -1);
        EXPECT_EQ(grids.distance_vx->tree().getValue(at),
                  n ? n->distance_vx : std::numeric_limits<float>::infinity());
        near += n ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(near, grids.layer->activeVoxelCount());
  for (const openvdb::GridBase::Ptr& grid :
       {openvdb::GridBase::Ptr(grids.part), openvdb::GridBase::Ptr(grids.distance_vx)}) {
    const openvdb::Vec3d p = grid->transform().indexToWorld(openvdb::Coord(2, 3, 4));
    const Vec3 expected = worldFromVoxel(frame, Vec3(2, 3, 4));
    EXPECT_EQ(Vec3(p.x(), p.y(), p.z()), expected);
  }
}

TEST(World, ListsItsSurfacesInRows) {
  World world(tests::unitFrame({70, 10, 10}));
  const PartId part = world.addPart(tests::scenePart("a"));
  const std::vector<Voxel> rows{{69, 0, 0}, {3, 0, 1}, {64, 0, 1}, {0, 2, 0}, {0, 2, 9}, {1, 9, 0}};
  for (std::size_t i = rows.size(); i-- > 0;) world.occupy(std::vector{tile(rows[i], part)});
  const auto all = world.surfaces();
  ASSERT_EQ(all.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(all[i].voxel, rows[i]);
}

TEST(World, CanBeMoved) {
  World world(tests::unitFrame(Voxel(9)));
  world.addPart(tests::scenePart("a"));
  world.occupy(std::vector{tile(Voxel(2), 1)});
  world.setLayers(1);
  World moved(std::move(world));
  EXPECT_EQ(moved.partAt(Voxel(2)), 1);
  EXPECT_EQ(moved.nearnessAt(Voxel(3))->layer, 1);
}

}  // namespace
}  // namespace espalier::sim
