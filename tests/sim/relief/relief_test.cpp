#include "sim/relief/relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "sim/base/parallel.h"
#include "tests/support/numbers.h"

namespace espalier::sim {
namespace {

/// A tree in a square of 100 m, from the middle of its lower side, whose lines are some metres long.
PlanLines drawnTree(unsigned seed, int nodes) {
  tests::Numbers numbers(seed);
  PlanLines lines{{{50.0, 1.0}}, {-1}};
  while (static_cast<int>(lines.parent.size()) < nodes) {
    const auto parent = static_cast<std::size_t>(numbers.whole(0, static_cast<int>(lines.parent.size()) - 1));
    const glm::dvec2 at =
        lines.at_m[parent] + glm::dvec2(numbers.uniform(-6.0, 6.0), numbers.uniform(-3.0, 7.0));
    if (at.x < 1.0 || at.x > 99.0 || at.y < 1.0 || at.y > 99.0) continue;
    lines.at_m.push_back(at);
    lines.parent.push_back(static_cast<std::int32_t>(parent));
  }
  return lines;
}

HeightRaster square(double spacing_m) {
  HeightRaster raster;
  raster.spacing_m = spacing_m;
  raster.wide = raster.deep = static_cast<int>(100.0 / spacing_m) + 1;
  return raster;
}

ReliefLaw law() {
  ReliefLaw law;
  law.line = {.base_m = 20.0, .grade = 0.4, .concavity = 0.5, .order_share = 1.0};
  law.flank = {.slope = 0.7, .ease_m = 2.0};
  law.width_m = 0.2;
  law.noise = {.amplitude_m = 1.5, .scale_m = 12.0, .octaves = 4};
  return law;
}

constexpr std::array<glm::ivec2, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

bool isOutlet(const Relief& relief, std::size_t sample) {
  for (std::size_t i = 0; i < relief.water.sample.size(); ++i)
    if (relief.water.sample[i] == sample) return relief.water.next[i] == -1;
  return false;
}

/// How many samples water cannot leave, but outlets.
int pitsOf(const Relief& relief) {
  const HeightRaster& raster = relief.raster;
  int pits = 0;
  for (int z = 0; z < raster.deep; ++z) {
    for (int x = 0; x < raster.wide; ++x) {
      const float height = raster.height_m[raster.index(x, z)];
      const bool flows = std::any_of(kBeside.begin(), kBeside.end(), [&](glm::ivec2 way) {
        const glm::ivec2 to = glm::ivec2(x, z) + way;
        return raster.holds(to) && raster.height_m[raster.index(to.x, to.y)] < height;
      });
      if (!flows && !isOutlet(relief, raster.index(x, z))) ++pits;
    }
  }
  return pits;
}

TEST(Lines, FlowIsTheTipsThatALineDrains) {
  //   1 - 2 (tip), 1 - 3 - 4 (tip), 3 - 5 (tip)
  const PlanLines lines{{{0, 0}, {0, 1}, {-1, 2}, {1, 2}, {1, 3}, {2, 3}}, {-1, 0, 1, 1, 3, 3}};
  EXPECT_EQ(flowOf(lines), (std::vector<double>{3, 3, 1, 2, 1, 1}));
  EXPECT_EQ(ordersOf(lines), (std::vector<std::int32_t>{0, 0, 1, 0, 0, 1}));
  const RiseLaw law{.base_m = 7.0, .grade = 0.5, .concavity = 0.5, .order_share = 2.0};
  const std::vector<double> height = heightsOf(lines, law);
  EXPECT_DOUBLE_EQ(height[0], 7.0);
  EXPECT_DOUBLE_EQ(height[1], 7.0 + 0.5 / std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(height[2], height[1] + 0.5 * 2.0 * std::sqrt(2.0)) << "of the first order, a tip";
  EXPECT_DOUBLE_EQ(height[3], height[1] + 0.5 / std::sqrt(2.0) * std::sqrt(2.0));
}

TEST(Land, IsTheVeryNumbersThatAllCoursesOneByOneGive) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    tests::Numbers numbers(seed);
    std::vector<Course> courses;
    for (int i = 0; i < 300; ++i) {
      const glm::dvec2 from(numbers.uniform(0, 100), numbers.uniform(0, 100));
      // Some are points, some are as others.
      const glm::dvec2 to =
          i % 11 == 0 ? from : from + glm::dvec2(numbers.uniform(-9, 9), numbers.uniform(-9, 9));
      courses.push_back({from, to, numbers.uniform(0, 60), numbers.uniform(0, 60), numbers.uniform(0, 2)});
      if (i % 13 == 0) courses.push_back(courses.back());
    }
    const Flank flank{.slope = 0.8, .ease_m = 3.0, .most_m = seed == 3 ? std::optional(25.0) : std::nullopt};
    const Land land(courses, flank);
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec2 at(numbers.uniform(-20, 120), numbers.uniform(-20, 120));
      LandAt lowest{std::numeric_limits<double>::infinity(), -1}, nearest = lowest;
      for (std::size_t c = 0; c < courses.size(); ++c) {
        const double height = heightBy(courses[c], flank, at);
        if (height < lowest.height_m) lowest = {height, static_cast<std::int32_t>(c)};
        const glm::dvec2 foot =
            courses[c].from_m + shareAlong(courses[c], at) * (courses[c].to_m - courses[c].from_m);
        const double far = std::max(0.0, std::sqrt(glm::dot(at - foot, at - foot)) - courses[c].half_width_m);
        if (far < nearest.height_m) nearest = {far, static_cast<std::int32_t>(c)};
      }
      const auto near = static_cast<std::int32_t>(numbers.whole(0, static_cast<int>(courses.size()) - 1));
      EXPECT_EQ(land.at(at, near).height_m, lowest.height_m);
      EXPECT_EQ(land.at(at, near).course, lowest.course);
      EXPECT_EQ(land.distance(at, near).height_m, nearest.height_m);
    }
  }
}

TEST(Land, RisesFromALineAsItsFlankSays) {
  const Flank plain{.slope = 0.5, .ease_m = 0.0}, eased{.slope = 0.5, .ease_m = 10.0},
      levelled{.slope = 0.5, .ease_m = 0.0, .most_m = 30.0};
  const Course level{{0, 0}, {100, 0}, 5.0, 5.0, 2.0};
  EXPECT_DOUBLE_EQ(heightBy(level, plain, {50, 1.5}), 5.0) << "within its width";
  EXPECT_DOUBLE_EQ(heightBy(level, plain, {50, 12}), 10.0);
  EXPECT_DOUBLE_EQ(heightBy(level, eased, {50, 12}), 7.5) << "half as much as far off as the ease";
  EXPECT_LT(heightBy(level, levelled, {50, 1e9}), 35.0);
  EXPECT_GT(heightBy(level, levelled, {50, 1e5}), 34.9);
  double before = 0.0;
  for (double d = 0.0; d < 300.0; d += 0.5) {
    const double now = levelled.rise(d);
    EXPECT_TRUE(d == 0.0 || now > before);
    before = now;
  }
}

/// By seeds, spacings and laws.
TEST(Relief, WaterRunsDownFromEverywhereAndAlongEveryLine) {
  for (const unsigned seed : {4u, 5u, 6u}) {
    for (const double spacing_m : {1.0, 0.7}) {
      ReliefLaw of = law();
      if (seed == 5) of.flank.most_m = 12.0;
      if (seed == 6) of.noise.amplitude_m = 9.0;
      const PlanLines lines = drawnTree(seed, 120);
      const Relief relief = makeRelief(square(spacing_m), lines, of, seed);
      EXPECT_EQ(pitsOf(relief), 0) << seed << ", " << spacing_m;
      const SampledLines& water = relief.water;
      ASSERT_GT(water.sample.size(), 100u);
      const auto outlets = std::count(water.next.begin(), water.next.end(), -1);
      EXPECT_EQ(outlets, 1) << "the root's";
      const int wide = relief.raster.wide;
      for (std::size_t i = 0; i < water.sample.size(); ++i) {
        if (water.next[i] < 0) continue;
        const auto from = static_cast<int>(water.sample[i]),
                   to = static_cast<int>(water.sample[static_cast<std::size_t>(water.next[i])]);
        EXPECT_LT(relief.raster.height_m[static_cast<std::size_t>(to)],
                  relief.raster.height_m[static_cast<std::size_t>(from)]);
        const glm::ivec2 step(to % wide - from % wide, to / wide - from / wide);
        EXPECT_EQ(std::abs(step.x) + std::abs(step.y), 1) << "along an edge of any mesh of the raster";
      }
    }
  }
}

TEST(Relief, LinesThatLieHighestAreRidges) {
  ReliefLaw of = law();
  of.falls = true;
  of.line.base_m = 80.0;
  of.noise.amplitude_m = 0.0;
  const PlanLines lines = drawnTree(8, 60);
  const Relief relief = makeRelief(square(1.0), lines, of, 8);
  EXPECT_TRUE(relief.water.sample.empty());
  const auto highest = std::max_element(relief.raster.height_m.begin(), relief.raster.height_m.end());
  const auto at = static_cast<int>(highest - relief.raster.height_m.begin());
  const glm::dvec2 place = relief.raster.place(at % relief.raster.wide, at / relief.raster.wide);
  EXPECT_LT(glm::distance(place, lines.at_m[0]), 1.5) << "the summit is where the tree stands";
  EXPECT_NEAR(*highest, 80.0, 1.0);
  // Beside a line land is no higher than on it.
  for (std::size_t n = 1; n < lines.parent.size(); ++n) {
    const glm::ivec2 on = relief.raster.nearest(lines.at_m[n]);
    const double height = relief.raster.height_m[relief.raster.index(on.x, on.y)];
    EXPECT_LE(height, 80.0);
    EXPECT_GT(height, 80.0 - 0.4 * 300.0);
  }
}

TEST(Relief, NoLandIsLowerThanItsFloor) {
  ReliefLaw of = law();
  const PlanLines lines = drawnTree(8, 60);
  for (const bool falls : {false, true}) {
    of.falls = falls;
    of.floor_m.reset();
    const Relief without = makeRelief(square(1.0), lines, of, 8);
    of.floor_m = 24.0;
    const Relief with = makeRelief(square(1.0), lines, of, 8);
    std::size_t lower = 0;
    for (std::size_t i = 0; i < with.raster.height_m.size(); ++i) {
      lower += without.raster.height_m[i] < 24.0f;
      ASSERT_EQ(with.raster.height_m[i], std::max(24.0f, without.raster.height_m[i]));
    }
    EXPECT_GT(lower, 0u);
  }
}

TEST(Relief, NoiseLeavesLinesAlone) {
  ReliefLaw of = law();
  const PlanLines lines = drawnTree(9, 80);
  const Relief rough = makeRelief(square(1.0), lines, of, 9);
  of.noise.amplitude_m = 0.0;
  const Relief plain = makeRelief(square(1.0), lines, of, 9);
  double on_lines = 0.0, between = 0.0;
  int far = 0;
  for (std::size_t i = 0; i < plain.raster.height_m.size(); ++i) {
    const double differ = std::abs(rough.raster.height_m[i] - plain.raster.height_m[i]);
    if (plain.beside_m[i] < 0.3) on_lines = std::max(on_lines, differ);
    if (plain.beside_m[i] > 6.0) between += differ, ++far;
  }
  EXPECT_LT(on_lines, 0.1);
  ASSERT_GT(far, 100);
  EXPECT_GT(between / far, 0.3);
}

TEST(Relief, TheSameOnAnyNumberOfThreads) {
  const PlanLines lines = drawnTree(10, 100);
  const auto heights = [&] { return makeRelief(square(0.8), lines, law(), 10).raster.height_m; };
  const auto first = heights();
  for (const int threads : {1, 2, 5}) onThreads(threads, [&] { EXPECT_EQ(heights(), first); });
}

TEST(Relief, LinesThatLeaveTheRasterHaveTheirOutletsThere) {
  const PlanLines lines{{{50, -30}, {50, 40}, {80, 70}}, {-1, 0, 1}};
  const Relief relief = makeRelief(square(1.0), lines, law(), 1);
  EXPECT_EQ(pitsOf(relief), 0);
  const auto outlet =
      std::find(relief.water.next.begin(), relief.water.next.end(), -1) - relief.water.next.begin();
  EXPECT_EQ(relief.water.sample[static_cast<std::size_t>(outlet)], 50u) << "on the lower rim";
}

}  // namespace
}  // namespace espalier::sim
