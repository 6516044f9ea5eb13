#include "sim/world/ray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>
#include <vector>

namespace espalier::sim {
namespace {

using Rng = std::mt19937_64;

double between(Rng& rng, double low, double high) {
  return low + (high - low) * (static_cast<double>(rng() >> 11) * 0x1.0p-53);
}

BitVolume randomWorld(Rng& rng, Voxel size, double density) {
  BitVolume world(size);
  for (int y = 0; y < size.y; ++y)
    for (int z = 0; z < size.z; ++z)
      for (int x = 0; x < size.x; ++x)
        if (between(rng, 0, 1) < density) world.set({x, y, z});
  return world;
}

/// Slow and plain: lists every plane that the ray crosses within the world's reach, sorts the crossings by
/// (t, axis), and walks them one by one.
std::optional<RayHit> slowHit(const BitVolume& world, Vec3 origin_vx, Vec3 direction) {
  std::vector<std::tuple<double, int>> crossings;
  Voxel voxel = voxelAt(origin_vx);
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    const double inverse = 1.0 / direction[axis];
    const int reach = world.size()[axis] + 64;
    for (int plane = -64; plane <= reach; ++plane) {
      const bool passed = direction[axis] > 0 ? plane > voxel[axis] : plane <= voxel[axis];
      if (passed) crossings.emplace_back((plane - (origin_vx[axis] + 0.5)) * inverse, axis);
    }
  }
  std::sort(crossings.begin(), crossings.end());
  RayHit hit{voxel, Voxel(0), 0.0};
  if (world.at(voxel)) return hit;
  for (const auto& [t, axis] : crossings) {
    hit.t = t;
    hit.face = Voxel(0);
    hit.face[axis] = direction[axis] > 0 ? -1 : 1;
    hit.voxel[axis] -= hit.face[axis];
    if (world.at(hit.voxel)) return hit;
  }
  return std::nullopt;
}

::testing::AssertionResult same(const std::optional<RayHit>& a, const std::optional<RayHit>& b) {
  if (a.has_value() != b.has_value())
    return ::testing::AssertionFailure()
           << (a ? "a hit" : "a miss") << " against " << (b ? "a hit" : "a miss");
  if (!a || (a->voxel == b->voxel && a->face == b->face && a->t == b->t))
    return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "voxel " << a->voxel.x << ' ' << a->voxel.y << ' ' << a->voxel.z << " at " << a->t << " against "
         << b->voxel.x << ' ' << b->voxel.y << ' ' << b->voxel.z << " at " << b->t;
}

Vec3 randomDirection(Rng& rng) {
  while (true) {
    const Vec3 d(between(rng, -1, 1), between(rng, -1, 1), between(rng, -1, 1));
    const double length = glm::length(d);
    if (length > 0.1 && length < 1.0) return d / length;
  }
}

/// Directions in small whole numbers and origins on quarters: these meet planes, edges and corners all the
/// time.
Vec3 awkwardDirection(Rng& rng) {
  while (true) {
    const Vec3 d(static_cast<int>(rng() % 5) - 2, static_cast<int>(rng() % 5) - 2,
                 static_cast<int>(rng() % 5) - 2);
    if (d != Vec3(0.0)) return glm::normalize(d);
  }
}

/// The same ray, begun somewhere on its free way.
std::optional<RayHit> fromFreeWay(const BitVolume& world, const Bricks& bricks, Vec3 origin, Vec3 direction,
                                  const std::optional<RayHit>& hit, double share) {
  return firstHit(world, bricks, origin, direction, share * (hit ? hit->t : 150.0));
}

TEST(FirstHit, AgreesWithTheSlowWalkOnRandomRays) {
  Rng rng(1);
  const std::vector<Voxel> sizes = {{1, 1, 1}, {8, 8, 8}, {17, 9, 23}, {64, 5, 3}, {70, 31, 40}, {130, 3, 9}};
  int hits = 0;
  for (const Voxel size : sizes) {
    for (const double density : {0.0, 0.001, 0.02, 0.3}) {
      const BitVolume world = randomWorld(rng, size, density);
      const Bricks bricks(world);
      for (int i = 0; i < 400; ++i) {
        Vec3 origin;
        for (int axis = 0; axis < 3; ++axis) origin[axis] = between(rng, -30, size[axis] + 30);
        // Half of the rays aim into the world.
        Vec3 direction = randomDirection(rng);
        if (i % 2 == 0)
          direction = glm::normalize(
              Vec3(size) * Vec3(between(rng, 0, 1), between(rng, 0, 1), between(rng, 0, 1)) - origin);
        const auto fast = firstHit(world, bricks, origin, direction);
        ASSERT_TRUE(same(fast, slowHit(world, origin, direction))) << "ray " << i << " density " << density;
        ASSERT_TRUE(same(fast, fromFreeWay(world, bricks, origin, direction, fast, between(rng, 0, 0.999))));
        hits += fast.has_value();
      }
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(FirstHit, AgreesWithTheSlowWalkAlongPlanesEdgesAndCorners) {
  Rng rng(2);
  int hits = 0, inside = 0;
  for (int round = 0; round < 12; ++round) {
    const Voxel size(5 + static_cast<int>(rng() % 40), 5 + static_cast<int>(rng() % 40),
                     5 + static_cast<int>(rng() % 80));
    const BitVolume world = randomWorld(rng, size, round % 3 == 0 ? 0.2 : 0.005);
    const Bricks bricks(world);
    for (int i = 0; i < 2000; ++i) {
      Vec3 origin;
      for (int axis = 0; axis < 3; ++axis)
        origin[axis] = 0.25 * static_cast<double>(
                                  static_cast<int>(rng() % static_cast<unsigned>(4 * size[axis] + 32)) - 16);
      const Vec3 direction = awkwardDirection(rng);
      const auto fast = firstHit(world, bricks, origin, direction);
      ASSERT_TRUE(same(fast, slowHit(world, origin, direction)))
          << "from " << origin.x << ' ' << origin.y << ' ' << origin.z << " along " << direction.x << ' '
          << direction.y << ' ' << direction.z;
      // Often to where planes, edges and corners are crossed.
      const double share = 0.125 * static_cast<double>(rng() % 8);
      ASSERT_TRUE(same(fast, fromFreeWay(world, bricks, origin, direction, fast, share)));
      hits += fast.has_value();
      inside += fast && fast->face == Voxel(0);
    }
  }
  EXPECT_GT(hits, 2000);
  EXPECT_GT(inside, 200);
}

/// Independent of any walk: the nearest cube by the slab test against each occupied voxel.
TEST(FirstHit, FindsTheNearestCube) {
  Rng rng(3);
  const Voxel size(20, 14, 27);
  const BitVolume world = randomWorld(rng, size, 0.01);
  const Bricks bricks(world);
  for (int i = 0; i < 500; ++i) {
    const Vec3 origin(between(rng, -9, 29), between(rng, -9, 23), between(rng, -9, 36));
    const Vec3 direction = randomDirection(rng);
    double nearest = 1e30;
    for (int y = 0; y < size.y; ++y) {
      for (int z = 0; z < size.z; ++z) {
        for (int x = 0; x < size.x; ++x) {
          if (!world.at({x, y, z})) continue;
          const Vec3 a = (Vec3(x, y, z) - 0.5 - origin) / direction,
                     b = (Vec3(x, y, z) + 0.5 - origin) / direction;
          const Vec3 in = glm::min(a, b), out = glm::max(a, b);
          const double enter = std::max({in.x, in.y, in.z, 0.0}), leave = std::min({out.x, out.y, out.z});
          if (enter <= leave) nearest = std::min(nearest, enter);
        }
      }
    }
    const auto hit = firstHit(world, bricks, origin, direction);
    ASSERT_EQ(hit.has_value(), nearest < 1e29) << i;
    if (!hit) continue;
    ASSERT_NEAR(hit->t, nearest, 1e-9) << i;
  }
}

TEST(FirstHit, NamesTheFaceAndTheDistance) {
  BitVolume world({10, 10, 10});
  world.set({4, 5, 6});
  const Bricks bricks(world);
  const auto from_below = firstHit(world, bricks, {4, 0, 6}, {0, 1, 0});
  ASSERT_TRUE(from_below);
  EXPECT_EQ(from_below->voxel, Voxel(4, 5, 6));
  EXPECT_EQ(from_below->face, Voxel(0, -1, 0));
  EXPECT_DOUBLE_EQ(from_below->t, 4.5);
  const auto from_outside = firstHit(world, bricks, {100, 5, 6}, {-1, 0, 0});
  ASSERT_TRUE(from_outside);
  EXPECT_EQ(from_outside->face, Voxel(1, 0, 0));
  EXPECT_DOUBLE_EQ(from_outside->t, 95.5);
  const auto within = firstHit(world, bricks, {4.3, 5.1, 5.8}, {0, 0, 1});
  ASSERT_TRUE(within);
  EXPECT_EQ(within->face, Voxel(0));
  EXPECT_EQ(within->t, 0.0);
  EXPECT_FALSE(firstHit(world, bricks, {100, 5, 6}, {1, 0, 0}));
}

TEST(FirstHit, APlaneBetweenVoxelsBelongsToThePositiveSide) {
  BitVolume world({4, 4, 4});
  world.set({2, 1, 1});
  const Bricks bricks(world);
  EXPECT_TRUE(firstHit(world, bricks, {1.5, 1, -5}, {0, 0, 1}));
  EXPECT_FALSE(firstHit(world, bricks, {2.5, 1, -5}, {0, 0, 1}));
}

TEST(FirstHit, SurvivesFarAndSenselessOrigins) {
  BitVolume world({9, 9, 9});
  for (int i = 0; i < 9; ++i) world.set({i, i, i});
  const Bricks bricks(world);
  const double nan = std::nan("");
  EXPECT_TRUE(firstHit(world, bricks, {4, 1e12, 4}, {0, -1, 0}));
  EXPECT_FALSE(firstHit(world, bricks, {1e300, 1e300, 1e300}, {0, 1, 0}));
  EXPECT_FALSE(firstHit(world, bricks, {nan, 1, 1}, {1, 0, 0}));
  EXPECT_FALSE(firstHit(world, bricks, {nan, 1, 1}, {-1, 0, 0}));
  EXPECT_FALSE(firstHit(world, bricks, {1, 1, HUGE_VAL}, {0, 0, -1}));
  EXPECT_FALSE(firstHit(BitVolume(), Bricks(BitVolume()), {0, 0, 0}, {1, 0, 0}));
}

}  // namespace
}  // namespace espalier::sim
