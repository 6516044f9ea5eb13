#include "sim/relief/meander.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace espalier::sim {
namespace {

/// Straight lines of 1000 m along x, each 20 m beside the one before it, with roots of their own.
PlanLines rows(int count) {
  PlanLines lines;
  for (int row = 0; row < count; ++row) {
    lines.at_m.emplace_back(0.0, 20.0 * row);
    lines.parent.push_back(-1);
    lines.at_m.emplace_back(1000.0, 20.0 * row);
    lines.parent.push_back(static_cast<std::int32_t>(lines.parent.size()) - 1);
  }
  return lines;
}

double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool cross(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  return turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0;
}

TEST(Meander, MovesLinesTogetherWithoutCrossings) {
  const Meander meander{.amplitude_m = 6.0, .scale_m = 200.0, .octaves = 3};
  const PlanLines moved = meandering(rows(20), meander, 5.0, 7);
  std::size_t crossings = 0;
  for (std::size_t n = 0; n < moved.parent.size(); ++n) {
    if (moved.parent[n] < 0) continue;
    ASSERT_LT(moved.parent[n], static_cast<std::int32_t>(n));
    const auto parent = static_cast<std::size_t>(moved.parent[n]);
    EXPECT_LT(glm::distance(moved.at_m[n], moved.at_m[parent]), 20.0) << "bends are round";
    for (std::size_t m = 0; m < n; ++m) {
      if (moved.parent[m] < 0) continue;
      crossings += cross(moved.at_m[n], moved.at_m[parent], moved.at_m[m],
                         moved.at_m[static_cast<std::size_t>(moved.parent[m])]);
    }
  }
  EXPECT_EQ(crossings, 0u);
  EXPECT_EQ(flowOf(moved), std::vector<double>(moved.parent.size(), 1.0)) << "no fork was added";
}

TEST(Meander, StraysByItsAmplitude) {
  const PlanLines lines = rows(1);
  for (const double amplitude_m : {2.0, 6.0}) {
    double squares = 0.0, count = 0.0;
    for (std::uint64_t stream = 0; stream < 60; ++stream) {
      const PlanLines moved = meandering(lines, {amplitude_m, 100.0, 1}, 5.0, stream);
      for (const glm::dvec2 at_m : moved.at_m) squares += at_m.y * at_m.y, ++count;
    }
    EXPECT_NEAR(std::sqrt(squares / count), amplitude_m, 0.1 * amplitude_m);
  }
}

TEST(Meander, OfNothingOrOfWavesThatAreTooShortLeavesLinesAsTheyAre) {
  const PlanLines lines = rows(3);
  for (const Meander& meander : {Meander{}, Meander{.amplitude_m = 9.0, .scale_m = 9.0}}) {
    EXPECT_EQ(meandering(lines, meander, 5.0, 1).at_m, lines.at_m);
    EXPECT_EQ(meanderBytes(lines, meander, 5.0), 0.0);
  }
  EXPECT_GT(meanderBytes(lines, {.amplitude_m = 9.0, .scale_m = 20.0}, 5.0), 1000.0);
}

}  // namespace
}  // namespace espalier::sim
