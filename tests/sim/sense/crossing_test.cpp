#include "sim/sense/crossing.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/plain_crossing.h"

namespace espalier::sim {
namespace {

LatticePoint somewhere(std::mt19937& random, int reach) {
  const auto one = [&] {
    return static_cast<int>(random() % (2u * static_cast<unsigned>(reach) + 1)) - reach;
  };
  const int x = one(), y = one(), z = one();
  return {x, y, z};
}

LatticeTriangle triangleIn(std::mt19937& random, int reach) {
  const LatticePoint a = somewhere(random, reach), b = somewhere(random, reach), c = somewhere(random, reach);
  return {a, b, c};
}

LatticeTriangle turned(const LatticeTriangle& t, int way) {
  const auto i = static_cast<std::size_t>(way % 3);
  LatticeTriangle other = {t[i], t[(i + 1) % 3], t[(i + 2) % 3]};
  if (way >= 3) std::swap(other[1], other[2]);
  return other;
}

TEST(Crossing, IsThatAnEdgeOfOnePassesThroughTheOther) {
  std::mt19937 random(3);
  for (const int reach : {12, 4096, 500'000, 1 << 25}) {  // the last ones need more than 64 bits
    int crossing = 0, compared = 0;
    for (int i = 0; i < 4000; ++i) {
      const LatticeTriangle a = triangleIn(random, reach), b = triangleIn(random, reach);
      if (!tests::general(a, b)) continue;
      ++compared;
      const bool plain = tests::plainlyCross(a, b);
      crossing += plain;
      for (int way = 0; way < 6; ++way) {
        ASSERT_EQ(cross(turned(a, way), b), plain) << i;
        ASSERT_EQ(cross(b, turned(a, way)), plain) << i;
      }
    }
    EXPECT_GT(compared, 2000);
    EXPECT_GT(crossing, 200);
    EXPECT_LT(crossing, compared - 200);
  }
}

TEST(Crossing, TouchingIsNone) {
  const LatticeTriangle floor = {LatticePoint(0, 0, 0), {8, 0, 0}, {0, 0, 8}};
  const auto crosses = [&](const LatticeTriangle& t) {
    bool any = false, all = true;
    for (int way = 0; way < 6; ++way) {
      for (const bool c : {cross(turned(t, way), floor), cross(floor, turned(t, way))}) any |= c, all &= c;
    }
    EXPECT_EQ(any, all);
    return any;
  };
  EXPECT_FALSE(crosses({LatticePoint(2, 0, 2), {2, 5, 2}, {3, 5, 2}}));     // stands on it with a corner
  EXPECT_FALSE(crosses({LatticePoint(1, 0, 2), {3, 0, 2}, {2, 5, 2}}));     // with an edge
  EXPECT_FALSE(crosses({LatticePoint(0, 0, 0), {8, 0, 0}, {3, 5, 0}}));     // on its edge
  EXPECT_FALSE(crosses({LatticePoint(0, 0, 0), {-4, 2, 0}, {-4, -2, 1}}));  // at a corner, from outside
  EXPECT_TRUE(crosses({LatticePoint(0, 0, 0), {4, 2, 4}, {4, -2, 4}}));     // from its corner inwards
  EXPECT_TRUE(crosses({LatticePoint(2, -1, 2), {2, 5, 2}, {3, 5, 2}}));
  // In its plane.
  EXPECT_TRUE(crosses(floor));
  EXPECT_TRUE(crosses({LatticePoint(1, 0, 1), {2, 0, 1}, {1, 0, 2}}));
  EXPECT_FALSE(crosses({LatticePoint(8, 0, 0), {0, 0, 8}, {8, 0, 8}}));  // side by side
  EXPECT_FALSE(crosses({LatticePoint(0, 0, 0), {-8, 0, 0}, {0, 0, -8}}));
  EXPECT_TRUE(crosses({LatticePoint(7, 0, 0), {0, 0, 7}, {8, 0, 8}}));
  EXPECT_FALSE(crosses({LatticePoint(1, 1, 1), {2, 1, 1}, {1, 1, 2}}));  // above it
  // Without area.
  EXPECT_FALSE(crosses({LatticePoint(2, -4, 2), {2, 0, 2}, {2, 4, 2}}));
  EXPECT_FALSE(crosses({LatticePoint(2, 0, 2), {2, 0, 2}, {2, 0, 2}}));
}

TEST(Crossing, ALineThatPiercesPassesThePlaneOnce) {
  std::mt19937 random(5);
  int pierced = 0, compared = 0;
  for (int i = 0; i < 20'000; ++i) {
    const int reach = i % 2 ? 4096 : 1 << 25;
    const LatticeTriangle t = triangleIn(random, reach);
    const LatticePoint p = somewhere(random, reach), q = somewhere(random, reach);
    const bool plain = tests::plainlyPierces(p, q, t);
    if (plain) {
      ASSERT_TRUE(pierces(p, q, t));
      ASSERT_TRUE(pierces(q, p, turned(t, 4)));
    } else if (tests::general(t, {p, q, somewhere(random, reach)})) {
      ASSERT_FALSE(pierces(p, q, t));
      ++compared;
    }
    pierced += plain;
  }
  EXPECT_GT(pierced, 500);
  EXPECT_GT(compared, 5000);
  // A way that has its node in the plane, or runs in it for a while, passes once; one that turns back not at
  // all or twice.
  const LatticeTriangle t = {LatticePoint(0, 0, 0), {9, 0, 0}, {0, 0, 9}};
  const auto times = [&](std::vector<LatticePoint> way) {
    int sum = 0;
    for (std::size_t i = 1; i < way.size(); ++i) sum += pierces(way[i - 1], way[i], t);
    return sum;
  };
  EXPECT_EQ(times({{2, 3, 2}, {2, 0, 2}, {2, -3, 2}}), 1);
  EXPECT_EQ(times({{2, -3, 2}, {2, 0, 2}, {2, 3, 2}}), 1);
  EXPECT_EQ(times({{2, 3, 2}, {2, 0, 2}, {3, 0, 2}, {3, -1, 2}}), 1);
  EXPECT_EQ(times({{2, 3, 2}, {2, 0, 2}, {3, 3, 2}}) % 2, 0);
  EXPECT_EQ(times({{2, -3, 2}, {2, 0, 2}, {3, -3, 2}}) % 2, 0);
  EXPECT_EQ(times({{8, 3, 8}, {8, -3, 8}}), 0);
}

}  // namespace
}  // namespace espalier::sim
