#include "sim/sense/mass.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/bit_worlds.h"

namespace espalier {
namespace {

using sim::Voxel;

/// Every voxel of the cube asked.
std::optional<sim::Vec3> plainly(const sim::BitVolume& bits, Voxel about, double radius_vx) {
  const int reach = static_cast<int>(radius_vx);
  glm::i64vec3 sum(0);
  std::int64_t count = 0;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dz = -reach; dz <= reach; ++dz) {
      for (int dx = -reach; dx <= reach; ++dx) {
        if (dx * dx + dy * dy + dz * dz > radius_vx * radius_vx || !bits.at(about + Voxel(dx, dy, dz)))
          continue;
        sum += glm::i64vec3(dx, dy, dz);
        ++count;
      }
    }
  }
  if (count == 0) return std::nullopt;
  return sim::Vec3(about) + sim::Vec3(sum) / static_cast<double>(count);
}

TEST(CentreOfMass, IsThatOfEveryVoxelInTheBall) {
  std::mt19937 random(2);
  for (const Voxel size :
       {Voxel(200, 30, 40), Voxel(61, 64, 66), Voxel(1, 20, 20), Voxel(64, 1, 9), Voxel(3, 3, 3)}) {
    for (const double chance : {0.001, 0.3, 1.0}) {
      const auto bits = tests::randomBits(size, chance, 21);
      for (const double radius_vx : {0.0, 0.9, 1.0, 2.5, 7.0, 17.3, 64.0}) {
        const Voxel inside(static_cast<int>(random() % static_cast<unsigned>(size.x)),
                           static_cast<int>(random() % static_cast<unsigned>(size.y)),
                           static_cast<int>(random() % static_cast<unsigned>(size.z)));
        for (const Voxel about : {Voxel(0), size - 1, inside, Voxel(-5, 3, 4), size + 2})
          ASSERT_EQ(sim::centreOfMass(bits, about, radius_vx), plainly(bits, about, radius_vx));
      }
    }
  }
}

TEST(CentreOfMass, IsNowhereWhereNothingStands) {
  EXPECT_FALSE(sim::centreOfMass(sim::BitVolume({9, 9, 9}), {4, 4, 4}, 3.0));
}

}  // namespace
}  // namespace espalier
