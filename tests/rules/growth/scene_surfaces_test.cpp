#include "rules/growth/scene_surfaces.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "sim/sense/scene_surface.h"
#include "tests/support/numbers.h"

namespace espalier::rules {
namespace {

using sim::Vec3;

std::vector<TriangleCorners> strewn(tests::Numbers& numbers, int count) {
  std::vector<TriangleCorners> triangles;
  for (int i = 0; i < count; ++i) {
    const auto place = [&](double side) {
      return Vec3(numbers.uniform(-side, side), numbers.uniform(-side, side), numbers.uniform(-side, side));
    };
    const Vec3 about = place(40.0);
    // Most are small; some reach far.
    const double size = i % 17 == 0 ? 30.0 : 2.0;
    triangles.push_back({about, about + place(size), about + place(size)});
  }
  return triangles;
}

/// Whatever their number: also fewer than a box holds, one more, and none.
TEST(SceneSurfaces, AreFoundAsIfEachWereLookedAt) {
  tests::Numbers numbers(5);
  for (const int count : {0, 1, 31, 32, 33, 64, 65, 700}) {
    const std::vector<TriangleCorners> triangles = strewn(numbers, count);
    const sim::Commons commons{{kSceneSurfaces, columnsOf(triangles)}};
    int found = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3 at(numbers.uniform(-50, 50), numbers.uniform(-50, 50), numbers.uniform(-50, 50));
      const double within = numbers.uniform(0.5, 12.0);
      double least = within;
      for (const TriangleCorners& triangle : triangles)
        least = std::min(least, glm::distance(sim::nearestOn(triangle, at), at));
      const auto nearest = SurfacesNear(commons, at, within).nearest(at, within);
      ASSERT_EQ(nearest.has_value(), least < within);
      if (!nearest) continue;
      ++found;
      EXPECT_EQ(glm::distance(*nearest, at), least);
    }
    EXPECT_GE(found, count / 20) << count;
  }
}

TEST(SceneSurfaces, OfPlacesThatAreAllAlikeToo) {
  const std::vector<TriangleCorners> same(500, TriangleCorners{Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(1, 1, 0)});
  const sim::Commons commons{{kSceneSurfaces, columnsOf(same)}};
  EXPECT_EQ(SurfacesNear(commons, Vec3(1.2, 0.2, 1.0), 3.0).nearest(Vec3(1.2, 0.2, 1.0), 3.0),
            Vec3(1.2, 0.2, 0.0));
}

TEST(SceneSurfaces, NoneWhereTheSceneHasNone) {
  EXPECT_FALSE(SurfacesNear({}, Vec3(0.0), 9.0).nearest(Vec3(0.0), 9.0));
}

}  // namespace
}  // namespace espalier::rules
