#include "sim/tile/tiling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/vector_relational.hpp>
#include <random>
#include <set>
#include <tuple>

#include "sim/tile/triangle_rows.h"
#include "tests/support/exact_clip.h"

namespace espalier::sim {
namespace {

using Triangle = std::array<Vec3, 3>;

bool inRows(Voxel a, Voxel b) {
  return std::tie(a.y, a.z, a.x) < std::tie(b.y, b.z, b.x);
}

std::vector<Voxel> sorted(std::vector<Voxel> voxels) {
  std::sort(voxels.begin(), voxels.end(), inRows);
  return voxels;
}

std::vector<Voxel> tiled(const Triangle& t) {
  std::vector<Voxel> voxels;
  tileTriangle(t, voxels);
  return voxels;
}

std::vector<Voxel> tiled(Vec3 a, Vec3 b) {
  std::vector<Voxel> voxels;
  tileSegment(a, b, voxels);
  return voxels;
}

/// Random corners, among them the nasty ones: on planes between voxels, on centres, just beside them,
/// repeated, in a line, in one axis-aligned plane.
class Corners {
 public:
  explicit Corners(unsigned seed) : random_(seed) {}

  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  double coordinate(int kind, int reach) {
    const double half = 0.5 * (below(4 * reach + 1) - 2 * reach);
    const double step = (below(2 * reach * 4096 + 1) - reach * 4096) / 4096.0;
    switch (kind) {
      case 0:
        return half;
      case 1:
        return half + (below(3) - 1) / 4096.0;
      case 2:
        return step;
      default:
        return below(2) != 0 ? half : step;
    }
  }
  Triangle triangle(int reach) {
    const int kind = below(4);
    Triangle t;
    for (Vec3& p : t) p = {coordinate(kind, reach), coordinate(kind, reach), coordinate(kind, reach)};
    switch (below(8)) {
      case 0:
        t[1].y = t[2].y = t[0].y;
        break;
      case 1:
        t[1].x = t[2].x = t[0].x;
        break;
      case 2:
        t[1].z = t[2].z = t[0].z;
        break;
      case 3:
        t[2] = t[1] + (t[1] - t[0]);
        break;  // a line
      case 4:
        t[2] = t[0];
        break;  // a line, twice over
      case 5:
        t[2] = t[1] + Vec3(1, 0, -1) / 4096.0;
        break;  // a sliver
      default:
        break;
    }
    return t;
  }

 private:
  std::mt19937 random_;
};

TEST(TileTriangle, EqualsExactClippingOnRandomAndAdversarialTriangles) {
  Corners corners(1);
  for (int i = 0; i < 900; ++i) {
    const int reach = i % 3 == 0 ? 3 : 1;
    const Triangle t = corners.triangle(reach);
    const Voxel bound(3 * reach + 2);
    ASSERT_EQ(tiled(t), tests::exactTiling({t[0], t[1], t[2]}, -bound, bound))
        << "triangle " << i << ": " << testing::PrintToString(t);
  }
}

TEST(TileTriangle, EqualsExactClippingInsideHugeTriangles) {
  // Up to the limit of the coordinates, where products need 128 bits; looked at through small windows.
  Corners corners(2);
  int met = 0;
  for (int i = 0; i < 150; ++i) {
    const Triangle t = corners.triangle(i % 2 == 0 ? 8000 : 300);
    if (std::any_of(t.begin(), t.end(),
                    [](Vec3 p) { return glm::any(glm::greaterThan(glm::abs(p), Vec3(16000))); }))
      continue;
    const double u = corners.below(1001) / 1000.0;
    const double w = (1 - u) * corners.below(1001) / 1000.0;
    const Voxel middle = tilePoint(t[0] + u * (t[1] - t[0]) + w * (t[2] - t[0]));
    const std::array<Fixed, 3> q{fromCorner(fixedFromVoxel(t[0])), fromCorner(fixedFromVoxel(t[1])),
                                 fromCorner(fixedFromVoxel(t[2]))};
    if (normalOf(q) == glm::i64vec3(0)) continue;
    std::vector<Voxel> voxels;
    forEachTriangleRow(q, middle - 2, middle + 2, [&](int y, int z, int first, int last) {
      for (int x = first; x <= last; ++x) voxels.emplace_back(x, y, z);
    });
    ASSERT_EQ(voxels, tests::exactTiling({t[0], t[1], t[2]}, middle - 2, middle + 2))
        << testing::PrintToString(t);
    met += voxels.empty() ? 0 : 1;
  }
  EXPECT_GT(met, 80);
}

TEST(TileTriangle, DoesNotDependOnTheOrderOfCorners) {
  Corners corners(3);
  for (int i = 0; i < 2000; ++i) {
    const Triangle t = corners.triangle(4);
    const auto expected = tiled(t);
    EXPECT_EQ(tiled({t[1], t[2], t[0]}), expected);
    EXPECT_EQ(tiled({t[2], t[1], t[0]}), expected);
  }
}

TEST(TileTriangle, MovesWithWholeVoxels) {
  Corners corners(4);
  for (int i = 0; i < 2000; ++i) {
    const Triangle t = corners.triangle(4);
    const Voxel by(corners.below(2000) - 1000, corners.below(2000) - 1000, corners.below(2000) - 1000);
    auto expected = tiled(t);
    for (Voxel& v : expected) v += by;
    EXPECT_EQ(tiled({t[0] + Vec3(by), t[1] + Vec3(by), t[2] + Vec3(by)}), expected);
  }
}

TEST(TileTriangle, IsTheUnionOfItsQuarters) {
  Corners corners(5);
  for (int i = 0; i < 2000; ++i) {
    Triangle t = corners.triangle(4);
    for (Vec3& p : t) p *= 2.0;  // so that midpoints are exact
    const Vec3 a = (t[1] + t[2]) / 2.0, b = (t[2] + t[0]) / 2.0, c = (t[0] + t[1]) / 2.0;
    std::vector<Voxel> parts;
    for (const Triangle& quarter : {Triangle{t[0], c, b}, {c, t[1], a}, {b, a, t[2]}, {a, b, c}}) {
      tileTriangle(quarter, parts);
    }
    parts = sorted(parts);
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    EXPECT_EQ(parts, tiled(t)) << testing::PrintToString(t);
  }
}

TEST(TileTriangle, AFloorBetweenTwoLayersOccupiesTheUpperOneAlone) {
  for (int axis = 0; axis < 3; ++axis) {
    std::set<std::array<int, 3>> seen;
    constexpr int kSide = 6;
    const auto corner = [&](int i, int j) {
      Vec3 p(0.0);
      p[axis] = 2.5;
      p[(axis + 1) % 3] = i - 0.5;
      p[(axis + 2) % 3] = j - 0.5;
      return p;
    };
    for (int i = 0; i < kSide; ++i) {
      for (int j = 0; j < kSide; ++j) {
        for (const Triangle& t : {Triangle{corner(i, j), corner(i + 1, j), corner(i, j + 1)},
                                  {corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)}}) {
          for (const Voxel v : tiled(t)) seen.insert({v.x, v.y, v.z});
        }
      }
    }
    // The far border lies between voxels too, and goes to the upper ones.
    std::set<std::array<int, 3>> expected;
    for (int i = 0; i <= kSide; ++i) {
      for (int j = 0; j <= kSide; ++j) {
        std::array<int, 3> v{};
        v[static_cast<std::size_t>(axis)] = 3;
        v[static_cast<std::size_t>((axis + 1) % 3)] = i;
        v[static_cast<std::size_t>((axis + 2) % 3)] = j;
        expected.insert(v);
      }
    }
    EXPECT_EQ(seen, expected) << "axis " << axis;
  }
}

TEST(TileTriangles, AreTheUnionOfThemInOrderWithoutRepeats) {
  Corners corners(6);
  for (int i = 0; i < 500; ++i) {
    std::vector<Vec3> places;
    std::vector<glm::ivec3> numbers;
    const int reach = i % 10 == 0 ? 40 : i % 10 == 1 ? 12 : 2;  // small and large ones go different ways
    for (int k = 0; k < 6; ++k) {
      places.emplace_back(corners.coordinate(3, reach), corners.coordinate(3, reach),
                          corners.coordinate(3, reach));
      numbers.emplace_back(fixedFromVoxel(places.back()));
    }
    const auto any = [&] { return static_cast<std::uint32_t>(corners.below(6)); };
    std::vector<CornerNumbers> triangles;
    std::vector<Voxel> expected;
    for (int k = 0; k < 1 + i % 5; ++k) {
      triangles.push_back({any(), any(), any()});  // some without area
      const auto& [a, b, c] = triangles.back();
      tileTriangle({places[a], places[b], places[c]}, expected);
    }
    expected = sorted(expected);
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    std::vector<Voxel> voxels{Voxel(7)};  // what is there already stays
    tileTriangles(numbers, triangles, voxels);
    ASSERT_EQ(voxels.front(), Voxel(7));
    voxels.erase(voxels.begin());
    EXPECT_EQ(voxels, expected);
  }
}

TEST(TileSegment, EqualsExactClippingAndStepsThroughFaces) {
  Corners corners(7);
  for (int i = 0; i < 900; ++i) {
    const Triangle t = corners.triangle(2);
    const auto path = tiled(t[0], t[1]);
    ASSERT_EQ(sorted(path), tests::exactTiling({t[0], t[1]}, Voxel(-8), Voxel(8)))
        << testing::PrintToString(t);
    EXPECT_EQ(path.front(), tilePoint(t[0]));
    EXPECT_EQ(path.back(), tilePoint(t[1]));
    for (std::size_t k = 1; k < path.size(); ++k) {
      const Voxel step = glm::abs(path[k] - path[k - 1]);
      EXPECT_EQ(step.x + step.y + step.z, 1);
    }
    EXPECT_EQ(sorted(tiled(t[1], t[0])), sorted(path));
  }
}

TEST(TileSegment, CrossesTheWholeRangeOfCoordinates) {
  const auto path = tiled({-16000.25, 3.5, -0.5}, {15999.75, -16000, 15000.125});
  EXPECT_EQ(path.size(), 1u + 32000u + 16004u + 15000u);
  EXPECT_EQ(path.back(), Voxel(16000, -16000, 15000));
}

TEST(TilePoint, BelongsToTheVoxelOnThePositiveSide) {
  EXPECT_EQ(tilePoint({0.5, -0.5, 1.49}), Voxel(1, 0, 1));
  EXPECT_EQ(tilePoint({-3.5 - 1.0 / 4096, 2.5, -7}), Voxel(-4, 3, -7));
  EXPECT_EQ(fixedFromVoxel({1.0, -1.0, 0.5 / 4096}), Fixed(4096, -4096, 1));
}

}  // namespace
}  // namespace espalier::sim
