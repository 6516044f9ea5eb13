#include "sim/scatter/inside_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/parallel.h"
#include "tests/support/meshes.h"
#include "tests/support/messages.h"

namespace espalier::sim {
namespace {

constexpr std::uint64_t kInsideStream = 5;
const Vec3 kMiddle(1, 2, 3);

Mesh ball() {
  return tests::sphereMesh(kMiddle, 2, 32);
}
/// Without what lies higher above its middle.
Mesh ballUpTo(double height) {
  return tests::without(ball(), [&](Vec3 m) { return m.y - kMiddle.y > height; });
}

TEST(InsidePoints, AreEvenByVolumeInABox) {
  const Vec3 low(1, 2, 3), high(5, 4, 6);
  const auto found = scatterWithin(tests::boxMesh(low, high), 64'000, kInsideStream);
  EXPECT_EQ(found.doubt.doubtful, 0.0);
  EXPECT_EQ(found.doubt.undecided, 0.0);
  int counts[64] = {};
  const Vec3 slack(0.25 * 4.0 / 128);  // of a voxel, where edges are rounded
  for (const Vec3& p : found.points.at) {
    ASSERT_TRUE(glm::all(glm::greaterThan(p, low - slack)) && glm::all(glm::lessThan(p, high + slack)));
    const glm::ivec3 cell = glm::clamp(glm::ivec3(4.0 * (p - low) / (high - low)), 0, 3);
    ++counts[cell.x + 4 * cell.y + 16 * cell.z];
  }
  double chi = 0;
  for (const int count : counts) chi += (count - 1000.0) * (count - 1000.0) / 1000.0;
  EXPECT_LT(chi, 63 + 4 * std::sqrt(2 * 63));
  EXPECT_EQ(found.points.normal, std::vector<Vec3>(64'000, Vec3(0)));
}

TEST(InsidePoints, FillABall) {
  const auto found = scatterWithin(ball(), 100'000, kInsideStream);
  Vec3 mean(0);
  double squares = 0;
  for (const Vec3& p : found.points.at) {
    EXPECT_LT(glm::distance(p, kMiddle), 2.0 + 0.1 * 4.0 / 128);
    mean += (p - kMiddle) / 100'000.0;
    squares += glm::dot(p - kMiddle, p - kMiddle) / 100'000.0;
  }
  EXPECT_LT(glm::length(mean), 4 * 2 / std::sqrt(5.0 * 100'000 / 3));
  EXPECT_NEAR(squares, 3.0 / 5 * 4, 0.02);
}

TEST(InsidePoints, DoNotAskWhichWayTrianglesFace) {
  EXPECT_EQ(scatterWithin(ball(), 500, kInsideStream).points.at,
            scatterWithin(tests::insideOut(ball()), 500, kInsideStream).points.at);
}

TEST(InsidePoints, AHoleIsVotedOn) {
  const auto found = scatterWithin(ballUpTo(1.0), 20'000, kInsideStream);
  EXPECT_GT(found.doubt.doubtful, 0.5);
  EXPECT_LT(found.doubt.undecided, 0.2);
  int above = 0;
  for (const Vec3& p : found.points.at) {
    ASSERT_LT(glm::distance(p, kMiddle), 2.0 + 0.5 * 4.0 / 128);
    above += p.y > kMiddle.y + 1.0;
  }
  EXPECT_LT(above, 1000);  // the hole is not bulged over: the ball has 0.16 of itself there
}

TEST(InsidePoints, RefuseWhatHasNoInside) {
  const auto says = [](const Mesh& mesh) {
    return tests::messageOf([&] { scatterWithin(mesh, 10, kInsideStream); });
  };
  EXPECT_EQ(says(ballUpTo(0.0)), "no error");  // a bowl
  EXPECT_EQ(says(ballUpTo(-0.5)),
            "mesh 'sphere': is so open that its inside is a guess for 55 % of it; expected at most 50 %, or "
            "points on its surface");
  const auto flat = [](double, double) { return 0.0; };
  EXPECT_EQ(says(tests::terrainMesh(10, 1, flat)),
            "mesh 'terrain': is a sheet, which has no inside; expected a mesh that holds "
            "something, or points on its surface");
  const auto wavy = [](double x, double) { return std::sin(x); };
  EXPECT_EQ(says(tests::terrainMesh(10, 1, wavy)).substr(0, 55),
            "mesh 'terrain': is so open that its inside is a guess f");
  EXPECT_EQ(says(tests::boxMesh(Vec3(1), Vec3(1))),
            "mesh 'box': has no inside; expected triangles with an area");
  EXPECT_EQ(says(tests::emptyMesh("none")), "mesh 'none': has no inside; expected triangles with an area");
  EXPECT_EQ(tests::messageOf([&] { scatterWithin(ball(), 0, kInsideStream); }),
            "0 points in a mesh; expected 1 to 2^32 - 1");
}

TEST(InsidePoints, ASlenderMeshIsLookedAtMoreClosely) {
  const Vec3 low(0, 0, 0), high(0.03, 10, 0.03);  // less than a voxel of the first grid wide
  for (const Vec3& p : scatterWithin(tests::boxMesh(low, high), 500, kInsideStream).points.at)
    ASSERT_TRUE(glm::all(glm::greaterThan(p, low - 0.01)) && glm::all(glm::lessThan(p, high + 0.01)));
}

TEST(InsidePoints, MoreOfThemBeginWithTheSameOnesOnAnyNumberOfThreads) {
  const auto few = scatterWithin(ball(), 100, kInsideStream).points;
  for (const int threads : {1, 3, 8}) {
    onThreads(threads, [&] {
      const auto many = scatterWithin(ball(), 3000, kInsideStream).points;
      EXPECT_TRUE(std::equal(few.at.begin(), few.at.end(), many.at.begin()));
    });
  }
  EXPECT_NE(few.at, scatterWithin(ball(), 100, kInsideStream + 1).points.at);
}

TEST(InsidePoints, ScaleToTheBit) {
  Mesh large = ball();
  for (Vec3& v : large.vertices_m) v *= 1024.0;
  const auto a = scatterWithin(ball(), 500, kInsideStream).points,
             b = scatterWithin(large, 500, kInsideStream).points;
  for (std::size_t i = 0; i < a.at.size(); ++i) ASSERT_EQ(1024.0 * a.at[i], b.at[i]);
}

}  // namespace
}  // namespace espalier::sim
