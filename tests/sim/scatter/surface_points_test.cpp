#include "sim/scatter/surface_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/meshes.h"
#include "tests/support/messages.h"

namespace espalier::sim {
namespace {

constexpr std::uint64_t kSurfaceStream = 99;

TEST(SurfacePoints, AreEvenByArea) {
  const Vec3 low(1, 2, 3), high(3, 5, 9);  // faces of 18, 12 and 6
  const auto points = scatterOn(tests::boxMesh(low, high), 72'000, kSurfaceStream);
  double counts[6] = {};
  double quarters[6][4] = {};
  for (std::size_t i = 0; i < points.at.size(); ++i) {
    const Vec3 n = points.normal[i], p = points.at[i];
    int face = -1;
    for (int axis = 0; axis < 3; ++axis) {
      if (n[axis] == -1.0) face = 2 * axis;
      if (n[axis] == 1.0) face = 2 * axis + 1;
    }
    ASSERT_GE(face, 0) << n.x << ' ' << n.y << ' ' << n.z;
    const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    EXPECT_NEAR(p[axis], face % 2 == 0 ? low[axis] : high[axis], 1e-12);
    const Vec3 share = (p - low) / (high - low);
    ASSERT_TRUE(share[u] >= 0 && share[u] <= 1 && share[v] >= 0 && share[v] <= 1);
    ++counts[face];
    ++quarters[face][(share[u] < 0.5 ? 0 : 1) + (share[v] < 0.5 ? 0 : 2)];
  }
  const double areas[6] = {18, 18, 12, 12, 6, 6};
  for (int face = 0; face < 6; ++face) {
    const double expected = 72'000 * areas[face] / 72;
    EXPECT_NEAR(counts[face], expected, 4 * std::sqrt(expected));
    for (const double quarter : quarters[face])
      EXPECT_NEAR(quarter, expected / 4, 4 * std::sqrt(expected / 4));
  }
}

TEST(SurfacePoints, MoreOfThemBeginWithTheSameOnes) {
  const Mesh mesh = tests::sphereMesh({1, 2, 3}, 2, 8);
  const auto few = scatterOn(mesh, 50, kSurfaceStream), many = scatterOn(mesh, 3000, kSurfaceStream);
  EXPECT_TRUE(std::equal(few.at.begin(), few.at.end(), many.at.begin()));
  const auto apart = scatterApart(mesh, 50, 0.2, kSurfaceStream),
             more = scatterApart(mesh, 400, 0.2, kSurfaceStream);
  ASSERT_EQ(apart.at.size(), 50u);
  EXPECT_TRUE(std::equal(apart.at.begin(), apart.at.end(), more.at.begin()));
  EXPECT_TRUE(std::equal(apart.normal.begin(), apart.normal.end(), more.normal.begin()));
}

TEST(SurfacePoints, KeepTheirDistance) {
  const Mesh mesh = tests::sphereMesh({1, 2, 3}, 2, 16);
  const double spacing = 0.2, area = tests::area(mesh);
  const auto points = scatterApart(mesh, 100'000, spacing, kSurfaceStream);
  double least = INFINITY;
  for (std::size_t i = 0; i < points.at.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) least = std::min(least, glm::distance(points.at[i], points.at[k]));
  }
  EXPECT_GE(least, spacing);
  EXPECT_LT(least, 1.05 * spacing);
  // Thrown without end, 0.70 of them come to lie on a square of the spacing.
  const double by_square = static_cast<double>(points.at.size()) * spacing * spacing / area;
  EXPECT_GT(by_square, 0.60);
  EXPECT_LT(by_square, 0.70);
  // No place is left where many more would fit.
  int free = 0;
  for (const Vec3& p : scatterOn(mesh, 2000, kSurfaceStream + 1).at) {
    free += std::none_of(points.at.begin(), points.at.end(),
                         [&](const Vec3& other) { return glm::distance(p, other) < spacing; });
  }
  EXPECT_LT(free, 40);
}

TEST(SurfacePoints, ComeInWavesFromSparseToDense) {
  const Mesh mesh = tests::sphereMesh({1, 2, 3}, 2, 16);
  const double spacing = 0.2;
  const auto points = scatterApart(mesh, 100'000, spacing, kSurfaceStream, 3);
  const auto all_at_once = scatterApart(mesh, 100'000, spacing, kSurfaceStream);
  EXPECT_TRUE(all_at_once.wave.empty());
  EXPECT_NEAR(static_cast<double>(points.at.size()), static_cast<double>(all_at_once.at.size()),
              0.1 * static_cast<double>(all_at_once.at.size()));
  ASSERT_EQ(points.wave.size(), points.at.size());
  EXPECT_TRUE(std::is_sorted(points.wave.begin(), points.wave.end()));
  std::vector<std::size_t> count(3);
  for (std::size_t i = 0; i < points.at.size(); ++i) {
    ++count.at(static_cast<std::size_t>(points.wave[i]));
    double least = INFINITY;
    for (std::size_t k = 0; k < i; ++k) least = std::min(least, glm::distance(points.at[i], points.at[k]));
    ASSERT_GE(least, spacing * (1 << (2 - points.wave[i])));
  }
  EXPECT_GT(count[0], 10u);
  EXPECT_GT(count[1], 2 * count[0]);
  EXPECT_GT(count[2], 2 * count[1]);
}

TEST(SurfacePoints, ScaleToTheBit) {
  const Mesh mesh = tests::sphereMesh({1, 2, 3}, 2, 8);
  Mesh large = mesh;
  for (Vec3& v : large.vertices_m) v *= 1024.0;
  const auto a = scatterOn(mesh, 1000, kSurfaceStream), b = scatterOn(large, 1000, kSurfaceStream);
  const auto c = scatterApart(mesh, 1000, 0.3, kSurfaceStream),
             d = scatterApart(large, 1000, 0.3 * 1024, kSurfaceStream);
  EXPECT_EQ(a.normal, b.normal);
  ASSERT_EQ(c.at.size(), d.at.size());
  for (std::size_t i = 0; i < a.at.size(); ++i) ASSERT_EQ(1024.0 * a.at[i], b.at[i]);
  for (std::size_t i = 0; i < c.at.size(); ++i) ASSERT_EQ(1024.0 * c.at[i], d.at[i]);
}

TEST(SurfacePoints, RefuseWhatHasNoSurface) {
  const Mesh box = tests::boxMesh(Vec3(0), Vec3(1));
  Mesh flat = tests::boxMesh(Vec3(0), Vec3(0));
  const std::string none = "mesh 'box': has no surface to strew points over; expected triangles with an area";
  EXPECT_EQ(tests::messageOf([&] { scatterOn(flat, 5, kSurfaceStream); }), none);
  flat.triangles.clear();
  EXPECT_EQ(tests::messageOf([&] { scatterApart(flat, 5, 1, kSurfaceStream); }),
            "mesh 'box': has no surface to strew points over; expected triangles with an area");
  EXPECT_EQ(tests::messageOf([&] { scatterOn(box, 0, kSurfaceStream); }),
            "0 points on a surface; expected 1 to 2^32 - 1");
  EXPECT_EQ(tests::messageOf([&] { scatterApart(box, 5, 0, kSurfaceStream); }),
            "points 0 apart; expected a number above 0");
  EXPECT_EQ(tests::messageOf([&] { scatterApart(box, 5, NAN, kSurfaceStream); }),
            "points nan apart; expected a number above 0");
}

}  // namespace
}  // namespace espalier::sim
