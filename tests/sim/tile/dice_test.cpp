#include "sim/tile/dice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <ranges>
#include <utility>
#include <vector>

#include "sim/base/frame.h"

namespace espalier::sim::dicing {
namespace {

const Voxel kSize(12, 9, 14);

struct Cut {
  Voxel voxel;
  std::vector<Vec3> corners;
};

using Corners = std::array<Vec3, 3>;
using Point = std::array<double, 3>;

std::vector<Cut> cutsOf(const Corners& triangle) {
  std::vector<Cut> cuts;
  dice(triangle, kSize, [&](Voxel voxel, std::span<const Vec3> corners) {
    cuts.push_back({voxel, {corners.begin(), corners.end()}});
  });
  return cuts;
}

Vec3 areaOf(std::span<const Vec3> corners) {
  Vec3 twice(0.0);
  for (std::size_t i = 2; i < corners.size(); ++i)
    twice += glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return 0.5 * twice;
}

bool isIn(const Cut& cut) {
  return std::ranges::all_of(cut.corners, [&](const Vec3& p) {
    const Vec3 from = p - Vec3(cut.voxel);
    return std::max({std::abs(from.x), std::abs(from.y), std::abs(from.z)}) <= 0.5;
  });
}

/// How often an edge is gone along, against the other way: 0 where the two sides of it match.
using Edges = std::map<std::pair<Point, Point>, int>;

void addEdges(Edges& edges, std::span<const Vec3> corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 &p = corners[i], &q = corners[(i + 1) % corners.size()];
    const Point a{p.x, p.y, p.z}, b{q.x, q.y, q.z};
    if (a < b) ++edges[{a, b}];
    if (b < a) --edges[{b, a}];
  }
}

/// Triangles of every size, some with corners on planes between voxels, and such as lie in them.
class RandomTriangles {
 public:
  Vec3 place(double beyond = 0.0) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = -0.5 - beyond + uniform() * (kSize[axis] + 2 * beyond);
      if (random_() % 4 == 0) p[axis] = std::floor(p[axis]) + 0.5;
    }
    return p;
  }
  Corners next(double beyond = 0.0) {
    const Vec3 a = place(beyond);
    const double size = random_() % 2 == 0 ? 1.0 : 0.1;
    return {a, glm::mix(a, place(beyond), size), glm::mix(a, place(beyond), size)};
  }

 private:
  double uniform() { return static_cast<double>(random_()) / 4294967296.0; }
  std::mt19937 random_{11};
};

TEST(Dice, FragmentsLieInTheirVoxelsAndFillTheTriangleAsItIsWound) {
  RandomTriangles triangles;
  std::size_t most = 0;
  for (int i = 0; i < 3000; ++i) {
    const Corners t = triangles.next();
    const Vec3 whole = areaOf(t);
    Vec3 sum(0.0);
    double areas = 0.0;
    const auto cuts = cutsOf(t);
    most = std::max(most, cuts.size());
    for (const Cut& cut : cuts) {
      ASSERT_TRUE(isIn(cut)) << i;
      ASSERT_TRUE(contains(kSize, cut.voxel));
      sum += areaOf(cut.corners);
      areas += glm::length(areaOf(cut.corners));
    }
    ASSERT_NEAR(areas, glm::length(whole), 1e-9 * glm::length(whole)) << i;
    ASSERT_LE(glm::length(sum - whole), 1e-9 * glm::length(whole)) << i;
  }
  EXPECT_GT(most, 100u);
}

TEST(Dice, NothingGapesBetweenFragmentsNorBetweenTrianglesThatShareAnEdge) {
  RandomTriangles triangles;
  for (int i = 0; i < 500; ++i) {
    // All around a point, each edge to it once each way.
    const Vec3 hub = triangles.place();
    std::array<Vec3, 5> rim;
    for (Vec3& p : rim) p = triangles.place();
    Edges edges;
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const Vec3 &p = rim[k], &q = rim[(k + 1) % rim.size()];
      std::array<Corners, 3> turned{{{hub, p, q}, {p, q, hub}, {q, hub, p}}};
      for (const Cut& cut : cutsOf(turned[k % 3])) addEdges(edges, cut.corners);
    }
    for (const auto& [edge, sides] : edges) {
      if (sides == 0) continue;  // those on the rim alone have one side
      const Vec3 a(edge.first[0], edge.first[1], edge.first[2]),
          b(edge.second[0], edge.second[1], edge.second[2]);
      const bool on_rim =
          std::ranges::any_of(std::views::iota(std::size_t{0}, rim.size()), [&](std::size_t k) {
            const Vec3 &p = rim[k], &q = rim[(k + 1) % rim.size()];
            const auto off = [&](const Vec3& at) {
              return glm::length(glm::cross(at - p, glm::normalize(q - p)));
            };
            return std::max(off(a), off(b)) < 1e-9;
          });
      ASSERT_TRUE(on_rim) << i;
    }
  }
}

TEST(Dice, WhatLiesBetweenVoxelsIsInTheUpperOneOnce) {
  const auto cuts = cutsOf({Vec3(2, 3.5, 2), Vec3(2, 3.5, 2.4), Vec3(2.4, 3.5, 2)});
  ASSERT_EQ(cuts.size(), 1u);
  EXPECT_EQ(cuts[0].voxel, Voxel(2, 4, 2));
  // As high as the plane, and not beyond it.
  for (const Cut& cut : cutsOf({Vec3(2, 2.7, 2), Vec3(2, 3.5, 2.4), Vec3(2.4, 3.5, 2)}))
    EXPECT_EQ(cut.voxel.y, 3);
}

TEST(Dice, BeyondTheWorldItStaysInOnePieceForEachSide) {
  RandomTriangles triangles;
  for (int i = 0; i < 1000; ++i) {
    const Corners t = triangles.next(20.0);
    double areas = 0.0;
    int outside = 0;
    for (const Cut& cut : cutsOf(t)) {
      areas += glm::length(areaOf(cut.corners));
      ASSERT_TRUE(contains(kSize, cut.voxel));
      if (!isIn(cut)) ++outside;
    }
    const double whole = glm::length(areaOf(t));
    ASSERT_NEAR(areas, whole, 1e-9 * whole);
    ASSERT_LE(outside, 6);
  }
  const auto far = cutsOf({Vec3(-1e6, 4, -1e6), Vec3(1e6, 4, -1e6), Vec3(0, 4, 1e6)});
  EXPECT_LE(far.size(), static_cast<std::size_t>(kSize.x * kSize.z + 4));
  const double top = kSize.y - 0.5;
  const auto lid = cutsOf({Vec3(2, top, 2), Vec3(2, top, 2.4), Vec3(2.4, top, 2)});
  ASSERT_EQ(lid.size(), 1u);
  EXPECT_EQ(lid[0].voxel, Voxel(2, kSize.y - 1, 2));
  EXPECT_EQ(cutsOf({Vec3(100, 4, 4), Vec3(101, 4, 4), Vec3(100, 5, 4)})[0].voxel, Voxel(kSize.x - 1, 4, 4));
}

}  // namespace
}  // namespace espalier::sim::dicing
