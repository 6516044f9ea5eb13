#include "sim/sense/scene_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sim/base/error.h"

namespace espalier::sim {
namespace {

const Voxel kSize(40, 30, 50);

std::vector<SurfaceTriangle> anyTriangles(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> even(0.0, 1.0);
  std::vector<SurfaceTriangle> triangles;
  for (int i = 0; i < count; ++i) {
    const double far = i % 10 == 0 ? 60.0 : 4.0;  // a few reach out of the world
    const auto any = [&] { return Vec3(even(random), even(random), even(random)); };
    const Vec3 at = any() * Vec3(kSize);
    triangles.push_back(
        {{at, at + far * (any() - 0.5), at + far * (any() - 0.5)}, static_cast<std::uint32_t>(i % 3)});
  }
  return triangles;
}

/// The nearest point by a fine search over the triangle.
double plainDistance(const std::array<Vec3, 3>& c, Vec3 at) {
  constexpr int kSteps = 200;
  double least = 1e9;
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; i + k <= kSteps; ++k) {
      const double u = i / static_cast<double>(kSteps), v = k / static_cast<double>(kSteps);
      least = std::min(least, glm::distance(c[0] + u * (c[1] - c[0]) + v * (c[2] - c[0]), at));
    }
  }
  return least;
}

TEST(SceneSurface, FindsThePointOfATriangleThatIsNearest) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> even(-3.0, 3.0);
  for (int run = 0; run < 100; ++run) {
    const auto any = [&] { return Vec3(even(random), even(random), even(random)); };
    const std::array<Vec3, 3> corners{any(), any(), any()};
    const Vec3 at = any();
    EXPECT_NEAR(glm::distance(nearestOn(corners, at), at), plainDistance(corners, at), 0.05);
    EXPECT_LE(plainDistance(corners, nearestOn(corners, at)), 0.05);
  }
}

TEST(SceneSurface, FindsTheNearestOfThoseThatAreWanted) {
  const auto triangles = anyTriangles(400, 1);
  const SceneSurface surface(kSize, triangles, {"a", "b", "c"});
  std::mt19937 random(4);
  std::uniform_real_distribution<double> even(0.0, 1.0);
  int found = 0;
  for (int run = 0; run < 300; ++run) {
    const Vec3 at = Vec3(even(random), even(random), even(random)) * Vec3(kSize) - 0.5;
    const double within = 6.0 * even(random);
    double least = within, least_inside = within;
    for (const auto& t : surface.triangles()) {
      if (t.region != 1) continue;
      const Vec3 there = nearestOn(t.corners_vx, at);
      least = std::min(least, glm::distance(there, at));
      // What lies outside of the world may be found or not.
      if (glm::all(glm::greaterThanEqual(there, Vec3(-0.5))) &&
          glm::all(glm::lessThan(there, Vec3(kSize) - 0.5)))
        least_inside = std::min(least_inside, glm::distance(there, at));
    }
    const auto place = surface.nearest(at, within, [](const auto& t) { return t.region == 1; });
    EXPECT_TRUE(place || !(least_inside < within)) << run;
    if (!place) continue;
    found += least == least_inside ? 1 : 0;
    EXPECT_GE(glm::distance(place->at_vx, at), least);
    EXPECT_LE(glm::distance(place->at_vx, at), least_inside);
    EXPECT_EQ(surface.triangles()[place->triangle].region, 1u);
  }
  EXPECT_GT(found, 50);
}

TEST(SceneSurface, ListsTheTrianglesOfABoxOnce) {
  const SceneSurface surface(kSize, anyTriangles(300, 8), {"a", "b", "c"});
  const LatticeBox box{latticePoint({5, 5, 5}), latticePoint({17, 14, 30})};
  std::vector<std::uint32_t> found, plain;
  surface.trianglesIn(box, found);
  for (std::uint32_t i = 0; i < surface.triangles().size(); ++i) {
    bool meets = true;
    for (int axis = 0; axis < 3; ++axis) {
      const auto& c = surface.triangles()[i].corners_vx;
      meets = meets && std::min({c[0][axis], c[1][axis], c[2][axis]}) * 4096.0 <= box.high[axis] &&
              std::max({c[0][axis], c[1][axis], c[2][axis]}) * 4096.0 >= box.low[axis];
    }
    if (meets) plain.push_back(i);
  }
  // Cells tell more than boxes: a triangle that only its box leads there need not be listed.
  EXPECT_TRUE(std::includes(plain.begin(), plain.end(), found.begin(), found.end()));
  EXPECT_TRUE(std::adjacent_find(found.begin(), found.end()) == found.end());
  for (const std::uint32_t i : plain) {
    const auto& c = surface.triangles()[i].corners_vx;
    const bool inside = std::any_of(c.begin(), c.end(), [&](Vec3 p) {
      const LatticePoint l = latticePoint(p);
      return glm::all(glm::greaterThanEqual(l, box.low)) && glm::all(glm::lessThanEqual(l, box.high));
    });
    EXPECT_TRUE(!inside || std::binary_search(found.begin(), found.end(), i)) << i;
  }
  EXPECT_GT(found.size(), 20u);
}

TEST(SceneSurface, LeavesOutWhatHasNoAreaAndWhatIsElsewhere) {
  const SceneSurface surface(kSize,
                             {{{Vec3(1, 1, 1), Vec3(2, 2, 2), Vec3(3, 3, 3)}, 0},
                              {{Vec3(500, 1, 1), Vec3(501, 2, 2), Vec3(500, 3, 3)}, 0},
                              {{Vec3(-1e9, 5, -1e9), Vec3(1e9, 5, -1e9), Vec3(0, 5, 1e9)}, 0}},
                             {"all"});
  ASSERT_EQ(surface.triangles().size(), 1u);
  const auto place = surface.nearest({20, 7, 20}, 3.0, [](const auto&) { return true; });
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->at_vx.y, 5.0, 1e-6);
  EXPECT_THROW(SceneSurface(kSize, {{{Vec3(1, 1, 1), Vec3(2, 2, 2), Vec3(3, 3, 4)}, 1}}, {"all"}),
               BrokenContract);
}

}  // namespace
}  // namespace espalier::sim
