#include "sim/world/plant_voxels.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>

namespace espalier::sim {
namespace {

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
      voxels.add(v, surface);
    } else if (i % 3 == 0) {
      const float coverage = at->second.coverage;
      voxels.takeOver(v, surface);
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
