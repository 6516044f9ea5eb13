#include "rules/diffusion/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "rules/diffusion/beside.h"

namespace espalier::rules {
namespace {

using Point = glm::dvec2;

Outline rectangle(double width, double height, Point at = Point(0.0)) {
  const Point h(0.5 * width, 0.5 * height);
  return {at - h, at + Point(h.x, -h.y), at + h, at + Point(-h.x, h.y)};
}

/// Convex, of some corners on a ring that is out of shape.
Outline anyOutline(std::mt19937& random, std::size_t corners) {
  std::uniform_real_distribution<double> even(0.0, 1.0);
  std::vector<Point> points;
  for (std::size_t i = 0; i < corners; ++i) {
    const double turn = 2.0 * M_PI * even(random), far = 0.4 + even(random);
    points.emplace_back(far * std::cos(turn), 0.7 * far * std::sin(turn));
  }
  return hullOf(points);
}

/// By points all over the one: what no algorithm of the room does.
double plainDistance(const Outline& a, const Outline& b) {
  double least = 1e9;
  constexpr int kSteps = 400;
  const auto along = [](const Outline& o, std::size_t i, int k) {
    return glm::mix(o[i], o[(i + 1) % o.size()], k / static_cast<double>(kSteps));
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int k = 0; k < kSteps; ++k) {
      const Point p = along(a, i, k);
      if (covers(b, p)) return 0.0;
      for (std::size_t j = 0; j < b.size(); ++j) {
        const Point from = b[j], way = b[(j + 1) % b.size()] - from;
        const double t = std::clamp(glm::dot(p - from, way) / glm::dot(way, way), 0.0, 1.0);
        least = std::min(least, glm::length(from + t * way - p));
      }
    }
  }
  return covers(a, b.front()) ? 0.0 : least;
}

TEST(Outline, HullsHoldAllPointsAndRunAnticlockwise) {
  std::mt19937 random(3);
  for (int run = 0; run < 50; ++run) {
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    std::vector<Point> points;
    for (int i = 0; i < 30; ++i) points.emplace_back(even(random), even(random));
    const Outline hull = hullOf(points);
    EXPECT_GT(areaOf(hull), 0.0);
    const Outline wide = widened(hull, 1e-9);
    for (const Point p : points) EXPECT_TRUE(covers(wide, p));
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Point a = hull[i], b = hull[(i + 1) % hull.size()], c = hull[(i + 2) % hull.size()];
      EXPECT_GT((b - a).x * (c - b).y - (b - a).y * (c - b).x, 0.0);
    }
  }
}

TEST(Outline, HaveTheDistanceThatPointsFind) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> even(-2.5, 2.5);
  int apart = 0, together = 0;
  for (int run = 0; run < 200; ++run) {
    const Outline a = anyOutline(random, 8);
    const Outline b = moved(anyOutline(random, 7), {0.6, 0.8}, {even(random), even(random)});
    const double plain = plainDistance(a, b);
    EXPECT_NEAR(distance(a, b), plain, 0.01);
    EXPECT_EQ(distance(a, b), distance(b, a));
    ++(plain > 0.0 ? apart : together);
  }
  EXPECT_GT(apart, 30);
  EXPECT_GT(together, 30);
}

TEST(Outline, GrowWiderByMitres) {
  const Outline wide = widened(rectangle(2.0, 1.0), 0.25);
  EXPECT_NEAR(areaOf(wide), 2.5 * 1.5, 1e-12);
  EXPECT_NEAR(areaOf(widened({Point(1.0, 2.0)}, 0.5)), 1.0, 1e-12);
  EXPECT_NEAR(areaOf(widened({Point(0.0), Point(3.0, 0.0)}, 0.5)), 4.0, 1e-12);
}

TEST(Outline, OverlapOnTheirWayWhereStepsFindIt) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  int met = 0;
  for (int run = 0; run < 300; ++run) {
    const Outline moving = anyOutline(random, 8);
    const Outline other = run % 3 == 0
                              ? Outline{{even(random), even(random)}, {even(random), even(random)}}
                              : moved(anyOutline(random, 6), {0.8, -0.6}, {even(random), even(random)});
    const Point way = glm::normalize(Point(even(random), even(random)));
    const auto stretch = overlaps(moving, way, other, 1e-9);
    for (double t = -4.0; t < 4.0; t += 0.05) {
      const bool now = overlap(moved(moving, {1.0, 0.0}, t * way), other);
      const bool said = stretch && t > stretch->from && t < stretch->to;
      const bool on_the_verge =
          stretch && (std::abs(t - stretch->from) < 0.01 || std::abs(t - stretch->to) < 0.01);
      ASSERT_TRUE(on_the_verge || now == said) << "run " << run << " at " << t;
      met += now ? 1 : 0;
    }
  }
  EXPECT_GT(met, 1000);
}

TEST(Outline, TouchWithoutOverlapping) {
  EXPECT_FALSE(overlap(rectangle(1, 1), rectangle(1, 1, {1.0, 0.0})));
  EXPECT_TRUE(overlap(rectangle(1, 1), rectangle(1, 1, {0.999, 0.0})));
  EXPECT_TRUE(overlap(rectangle(1, 1), {Point(-2.0, 0.1), Point(2.0, 0.1)}));
  EXPECT_FALSE(overlap(rectangle(1, 1), {Point(-2.0, 0.5), Point(2.0, 0.5)}));
}

TEST(Outline, HaveContactAlongWhatIsAGapAway) {
  const std::vector<Outline> others{rectangle(1, 1, {1.1, 0.0}), rectangle(1, 1, {0.0, 1.2})};
  EXPECT_NEAR(contact(rectangle(1, 1), others, 0.1, 1e-6), 1.0, 1e-9);
  EXPECT_NEAR(contact(rectangle(1, 1), others, 0.2, 1e-6), 1.0, 1e-9);
  EXPECT_EQ(contact(rectangle(1, 1), others, 0.3, 1e-6), 0.0);
}

TEST(Beside, KnowsWhichEdgesDiffer) {
  EXPECT_EQ(distinctEdges(rectangle(1, 1)).size(), 1u);
  EXPECT_EQ(distinctEdges(rectangle(2, 1)).size(), 2u);
  EXPECT_EQ(distinctEdges({{0, 0}, {2, 0}, {0, 1}}).size(), 3u);
}

TEST(Beside, LaysFlushAGapAwayAndInNobodysWay) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> even(-2.0, 2.0);
  constexpr double kGap = 0.05;
  std::size_t found = 0;
  for (int run = 0; run < 60; ++run) {
    const Outline parent = run % 2 == 0 ? rectangle(1.2, 0.7) : anyOutline(random, 7);
    const Outline own = run % 3 == 0 ? anyOutline(random, 6) : rectangle(0.8, 0.5);
    std::vector<Outline> others{parent};
    for (int i = 0; i < 6; ++i) {
      const Outline other = moved(rectangle(0.6, 0.4), {0.8, 0.6}, {even(random), even(random)});
      if (distance(other, parent) > kGap) others.push_back(other);
    }
    others.push_back({{-3.0, 1.4}, {3.0, 1.4}});
    const auto edges = distinctEdges(own);
    for (const Laid& laid : placesBeside(parent, own, edges, kGap, others)) {
      ++found;
      const Outline there = moved(own, laid.turn, laid.by);
      EXPECT_NEAR(distance(there, parent), kGap, 1e-6);
      for (const Outline& other : others) EXPECT_GT(distance(there, other), kGap - 1e-6);
      EXPECT_GT(laid.contact, 0.0);
      EXPECT_LE(laid.contact, 1.0 + 1e-9);
    }
  }
  EXPECT_GT(found, 300u);
}

TEST(Beside, FillsAHoleThatFits) {
  // A ring of eight squares about a square hole.
  std::vector<Outline> others;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      if (x != 0 || y != 0) others.push_back(rectangle(0.9, 0.9, {x, y}));
    }
  }
  const auto places =
      placesBeside(others.front(), rectangle(0.9, 0.9), std::vector<std::size_t>{0}, 0.1, others);
  EXPECT_TRUE(std::none_of(places.begin(), places.end(), [](const Laid& laid) {
    return glm::length(laid.by) < 0.1;
  })) << "the hole lies over the corner of that one";
  const auto from_side =
      placesBeside(others[1], rectangle(0.9, 0.9), std::vector<std::size_t>{0}, 0.1, others);
  const auto hole =
      std::find_if(from_side.begin(), from_side.end(), [](const Laid& laid) { return laid.contact > 0.99; });
  ASSERT_NE(hole, from_side.end());
  EXPECT_NEAR(glm::length(hole->by), 0.0, 1e-6);
}

}  // namespace
}  // namespace espalier::rules
