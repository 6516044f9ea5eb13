#include "scenes/import/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

namespace espalier::scenes {
namespace {

using Polygon = std::vector<sim::Vec3>;

sim::Vec3 areaVector(const Polygon& p) {
  sim::Vec3 sum(0.0);
  for (std::size_t i = 0; i < p.size(); ++i) sum += 0.5 * glm::cross(p[i], p[(i + 1) % p.size()]);
  return sum;
}

/// Triangles of the polygon's winding whose areas add up to its area can neither overlap nor stick out.
void expectCovered(const Polygon& polygon) {
  const sim::Vec3 whole = areaVector(polygon);
  const sim::Vec3 up = glm::normalize(whole);
  const auto triangles = triangulate(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  double covered = 0;
  for (const auto& [a, b, c] : triangles) {
    const double area = glm::dot(up, areaVector({polygon[a], polygon[b], polygon[c]}));
    EXPECT_GE(area, 0.0);
    covered += std::abs(area);
  }
  EXPECT_NEAR(covered / glm::length(whole), 1.0, 1e-9);
}

TEST(Triangulate, CoversPolygonsThatBendInwards) {
  const Polygon ell{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  const Polygon dart{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5, 1, 0}};
  const Polygon midpoints{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                          {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  const Polygon comb{{0, 0, 0}, {5, 0, 0}, {5, 2, 0}, {4, 2, 0}, {4, 1, 0}, {3, 1, 0},
                     {3, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  const Polygon frame{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                      {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};  // a square hole and its bridge
  for (const auto& polygon : {ell, dart, midpoints, comb, frame}) {
    for (std::size_t first = 0; first < polygon.size(); ++first) {
      Polygon turned = polygon;
      std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first), turned.end());
      expectCovered(turned);
      expectCovered(Polygon(turned.rbegin(), turned.rend()));
      for (auto& p : turned) p = {p.y, p.x + 2 * p.y, p.x - p.y};  // in a slanted plane
      expectCovered(turned);
    }
  }
}

TEST(Triangulate, CoversRandomStars) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(0.1, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    Polygon star;
    const int corners = 4 + trial % 60;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * glm::pi<double>() * i / corners;
      const double r = radius(random);
      star.emplace_back(r * std::cos(angle), 3.0, r * std::sin(angle));
    }
    expectCovered(star);
  }
}

TEST(Triangulate, GivesUpOnNothing) {
  EXPECT_EQ(triangulate({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2u);  // crosses itself
  EXPECT_EQ(triangulate(Polygon(9, sim::Vec3(1, 2, 3))).size(), 7u);
  EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).size(), 2u);
}

}  // namespace
}  // namespace espalier::scenes
