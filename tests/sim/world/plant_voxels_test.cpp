#include "sim/world/plant_voxels.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>

namespace espalier::sim {
namespace {

/// Parts 1 and 2 are plant 0's, 3 and 4 plant 1's, 5 plant 2's.
int plantOf(PartId part) {
  return (part - 1) / 2;
}

using Key = std::tuple<int, int, int>;

Key keyOf(Voxel v) {
  return {v.y, v.z, v.x};
}

void expectEqual(const Surface& a, const Surface& b) {
  EXPECT_EQ(a.part, b.part);
  EXPECT_EQ(a.colour, b.colour);
  EXPECT_EQ(a.coverage, b.coverage);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.offset_vx, b.offset_vx);
}

void expectHolds(const PlantVoxels& voxels, Voxel size, const std::map<Key, Surface>& wanted) {
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        const auto at = wanted.find({y, z, x});
        ASSERT_EQ(voxels.partAt({x, y, z}), at == wanted.end() ? kFree : at->second.part);
        const auto found = voxels.surfaceAt({x, y, z});
        ASSERT_EQ(found.has_value(), at != wanted.end());
        if (found) expectEqual(*found, at->second);
      }
    }
  }
  const auto wordAt = [&](Voxel first, int plant) {  // -1: of any
    std::uint64_t bits = 0;
    for (int i = 0; i < 64; ++i) {
      const auto at = wanted.find({first.y, first.z, first.x + i});
      if (at != wanted.end() && (plant < 0 || plantOf(at->second.part) == plant))
        bits |= std::uint64_t{1} << i;
    }
    return bits;
  };
  for (const auto& [key, surface] : wanted) {
    const auto& [y, z, x] = key;
    const Voxel first(x - x % 5, y, z);
    const std::uint64_t among = 0x5af3'17c9'0b6d'e842u * static_cast<unsigned>(x + 1);
    EXPECT_EQ(voxels.takenAmong(first, among), among & wordAt(first, -1));
    for (int plant = 0; plant < 4; ++plant)
      ASSERT_EQ(voxels.ofPlant(first, among, plant, plantOf), among & wordAt(first, plant));
  }
  std::map<Key, Surface> visited;
  voxels.forEach(
      [&](Voxel v, const Surface& surface) { EXPECT_TRUE(visited.emplace(keyOf(v), surface).second); });
  ASSERT_EQ(visited.size(), wanted.size());
  for (const auto& [key, surface] : visited) expectEqual(surface, wanted.at(key));
}

TEST(PlantVoxels, HoldWhatWasPutIntoThem) {
  const Voxel size(19, 9, 17);  // no multiples of a block's side
  PlantVoxels voxels(size);
  std::map<Key, Surface> wanted;
  std::mt19937 random(3);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  Surface surface;
  for (int i = 0; i < 40000; ++i) {
    const Voxel v(below(size.x), below(size.y), below(size.z));
    if (i % 7 == 0) {
      const auto shade = static_cast<float>(below(3));
      surface = {1 + below(5), Colour(0.25f, shade, 0.0f), 0.0f, Vec3f(shade, 0.0f, 1.0f), shade - 1.0f};
    }
    surface.coverage = 0.125f * static_cast<float>(below(9));
    const auto [at, fresh] = wanted.try_emplace(keyOf(v), surface);
    if (fresh) {
      voxels.add(v, surface, plantOf(surface.part));
    } else if (i % 3 == 0) {
      const float coverage = at->second.coverage;
      voxels.takeOver(v, surface, plantOf(surface.part));
      at->second = surface;
      at->second.coverage = coverage;
    } else {
      at->second.coverage += surface.coverage;
      EXPECT_EQ(voxels.addCoverage(v, surface.coverage), at->second.coverage);
    }
    if (i == 40) expectHolds(voxels, size, wanted);
  }
  expectHolds(voxels, size, wanted);
  EXPECT_EQ(wanted.size(), 19u * 9u * 17u);  // full blocks too

  PlantVoxels copy = voxels;
  copy.addCoverage(Voxel(1), 1.0f);
  expectHolds(voxels, size, wanted);
}

TEST(PlantVoxels, AreNoneAtFirst) {
  const PlantVoxels voxels(Voxel(9));
  EXPECT_EQ(voxels.partAt(Voxel(8)), kFree);
  EXPECT_FALSE(voxels.surfaceAt(Voxel(0)));
  voxels.forEach([](Voxel, const Surface&) { FAIL(); });
}

}  // namespace
}  // namespace espalier::sim
