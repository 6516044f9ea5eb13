#include "sim/grow/claims.h"

#include <gtest/gtest.h>

#include <map>

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "sim/sense/intersection.h"

namespace espalier::sim {
namespace {

struct ByPlace {
  bool operator()(Voxel a, Voxel b) const { return std::tie(a.y, a.z, a.x) < std::tie(b.y, b.z, b.x); }
};

std::vector<Voxel> drawn(Draws& draws, Voxel size, int count) {
  std::vector<Voxel> voxels;
  for (int i = 0; i < count; ++i)
    voxels.emplace_back(draws.whole(0, size.x - 1), draws.whole(0, size.y - 1), draws.whole(0, size.z - 1));
  return voxels;
}

// Against what the header says, kept in a map: few claims and many, so that the table grows and shrinks.
TEST(Claims, KnowWhoTookAVoxelFirst) {
  const Voxel size(40, 30, 20);
  Claims claims(size);
  for (int iteration = 0; iteration < 12; ++iteration) {
    std::map<Voxel, Claims::Node, ByPlace> taken;
    const int segments = iteration % 3 == 1 ? 900 : 15;
    for (int i = 0; i < segments; ++i) {
      Draws draws({11, static_cast<std::uint32_t>(1000 * iteration + i)}, Purpose::custom);
      const Claims::Node node{static_cast<std::size_t>(draws.whole(0, 3)), draws.whole(0, 5)};
      std::vector<Voxel> voxels = drawn(draws, size, 12);
      const Voxel start = voxels.front();
      bool for_node = true, for_plant = true;
      for (const Voxel v : voxels) {
        const auto at = taken.find(v);
        if (at == taken.end()) continue;
        for_node = for_node && besides(v, start) && at->second == node;
        for_plant = for_plant && at->second.first == node.first;
      }
      ASSERT_EQ(claims.allow(voxels, node, start), for_node);
      ASSERT_EQ(claims.allow(voxels, node.first), for_plant);
      std::vector<Voxel> free = voxels;
      std::erase_if(free, [&](Voxel v) { return taken.contains(v); });
      std::vector<Voxel> left = voxels;
      claims.keepFree(left);
      ASSERT_EQ(left, free);
      claims.take(voxels, node);
      for (const Voxel v : voxels) taken.emplace(v, node);
    }
    if (segments > 100) {
      EXPECT_GT(taken.size(), 5000u);
    }
    claims.clear();
    std::vector<Voxel> all;
    for (const auto& [voxel, node] : taken) all.push_back(voxel);
    std::vector<Voxel> left = all;
    claims.keepFree(left);
    EXPECT_EQ(left, all);
  }
}

TEST(Claims, RefuseVoxelsOutsideOfTheWorld) {
  Claims claims(Voxel(4));
  const std::vector<Voxel> outside = {Voxel(1), Voxel(1, 4, 1)};
  EXPECT_THROW(claims.take(outside, {0, 0}), BrokenContract);
}

}  // namespace
}  // namespace espalier::sim
