#include "render/model/stem_curves.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/model/radii.h"
#include "tests/support/small_vine.h"

namespace espalier {
namespace {

using render::Spline;
using sim::Vec3;

void expectNear(Vec3 a, Vec3 b, double tolerance) {
  EXPECT_LT(glm::distance(a, b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(Spline, PassesThroughItsPoints) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 2, 0}, {3, 1, 1}, {4, 4, 2}, {4, 5, 0}};
  for (const bool led : {false, true}) {
    const Spline curve = led ? Spline(points, Vec3(0, 3, 0)) : Spline(points);
    EXPECT_EQ(curve.last(), 4.0);
    for (std::size_t i = 0; i < points.size(); ++i)
      expectNear(curve.position(static_cast<double>(i)), points[i], 1e-12);
    if (led) expectNear(curve.derivative(0.0), Vec3(0, 3, 0), 1e-12);
  }
}

TEST(Spline, IsSmoothToTheSecondDerivative) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 2, 0}, {3, 1, 1}, {4, 4, 2}, {4, 5, 0}};
  const Spline curve(points);
  const double h = 1e-5;
  for (int knot = 1; knot <= 3; ++knot) {
    const double t = knot;
    expectNear(curve.derivative(t - 1e-9), curve.derivative(t + 1e-9), 1e-6);
    const Vec3 below = (curve.derivative(t - h) - curve.derivative(t - 2 * h)) / h;
    const Vec3 above = (curve.derivative(t + 2 * h) - curve.derivative(t + h)) / h;
    expectNear(below, above, 1e-3);
  }
  expectNear((curve.position(2.3 + h) - curve.position(2.3 - h)) / (2 * h), curve.derivative(2.3), 1e-8);
}

TEST(Spline, AStraightRowStaysStraight) {
  const Spline curve(std::vector<Vec3>{{0, 0, 0}, {0, 2, 0}, {0, 4, 0}, {0, 6, 0}});
  for (double t = 0.0; t <= 3.0; t += 0.125) expectNear(curve.position(t), Vec3(0, 2 * t, 0), 1e-12);
}

TEST(Spline, GoesByItsKnots) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 2, 0}, {3, 1, 1}, {4, 4, 2}};
  const std::vector<double> knots{0.0, 0.5, 3.0, 3.25};
  const Spline curve(points, knots, Vec3(0, 3, 0));
  EXPECT_EQ(curve.last(), 3.25);
  for (std::size_t i = 0; i < points.size(); ++i) expectNear(curve.position(knots[i]), points[i], 1e-12);
  expectNear(curve.derivative(0.0), Vec3(0, 3, 0), 1e-12);
  const double h = 1e-5;
  for (const double t : {0.5, 3.0}) {
    expectNear(curve.derivative(t - 1e-9), curve.derivative(t + 1e-9), 1e-6);
    const Vec3 below = (curve.derivative(t - h) - curve.derivative(t - 2 * h)) / h;
    const Vec3 above = (curve.derivative(t + 2 * h) - curve.derivative(t + h)) / h;
    expectNear(below, above, 2e-2);
  }
}

TEST(Spline, TwoPointsAndOnePoint) {
  const Spline line(std::vector<Vec3>{{1, 1, 1}, {3, 1, 1}});
  expectNear(line.position(0.5), Vec3(2, 1, 1), 1e-12);
  const Spline point(std::vector<Vec3>{{1, 2, 3}});
  EXPECT_EQ(point.last(), 0.0);
  expectNear(point.position(0.0), Vec3(1, 2, 3), 1e-12);
}

TEST(StemLine, KeepsOutOfWhatItsSegmentsLeaveFree) {  // around the edge of a wall, close by
  const std::vector<Vec3> points{{-4, 0.02, 0}, {-2, 0.02, 0}, {0.02, 0.02, 0}, {0.02, -2, 0}, {0.02, -4, 0}};
  const render::Blocked wall = [](Vec3 p) { return p.x < 0 && p.y < 0; };
  const auto deepest = [](const render::StemLine& line) {
    double deep = 0.0;
    for (int i = 0; i <= 4000; ++i) {
      const Vec3 p = line.position(0.001 * i);
      deep = std::max(deep, std::min(-p.x, -p.y));
    }
    return deep;
  };
  EXPECT_GT(deepest({points, {}, {}}), 0.03);
  const render::StemLine clear(points, {}, wall);
  EXPECT_LT(deepest(clear), 0.002);
  for (std::size_t i = 0; i < points.size(); ++i)
    expectNear(clear.position(static_cast<double>(i)), points[i], 1e-9);
  // Wherever its segments go there is nothing to keep out of.
  expectNear(render::StemLine(points, {}, [](Vec3) { return true; }).position(0.4),
             render::StemLine(points, {}, {}).position(0.4), 1e-12);
}

TEST(StemLine,
     KeepsByItsSegmentsWhereTheirLengthsDiffer) {  // a corner in steps of a hundredth, of long segments
  const std::vector<Vec3> points{{0, 0, 0},      {20, 0, 0},    {20.2, 0.2, 0},
                                 {20.4, 0.6, 0}, {20.4, 20, 0}, {20.3, 20.1, 0}};
  const render::StemLine line(points, {}, {});
  double farthest = 0.0;
  for (int i = 0; i <= 5000; ++i) {
    const double t = 0.001 * i;
    const auto segment = std::min<std::size_t>(static_cast<std::size_t>(t), points.size() - 2);
    const Vec3 a = points[segment], ab = points[segment + 1] - a, p = line.position(t);
    const double along = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
    farthest = std::max(farthest, glm::distance(p, a + along * ab));
  }
  EXPECT_LT(farthest, 0.5);  // by equal times it would be 2.5
}

TEST(StemLine, ItsDerivativeGoesByNodes) {
  const std::vector<Vec3> points{{-4, 0.02, 0}, {-2, 0.02, 0}, {0.02, 0.02, 0}, {0.02, -2, 0}};
  const render::StemLine line(points, Vec3(1, 1, 0), [](Vec3 p) { return p.x < 0 && p.y < 0; });
  expectNear(line.derivative(0.0), Vec3(1, 1, 0), 1e-9);
  for (const double t : {0.3, 1.4, 2.7})
    expectNear(line.derivative(t), (line.position(t + 1e-6) - line.position(t - 1e-6)) / 2e-6, 1e-6);
}

TEST(StemCurves, EverySegmentLiesOnOneStem) {
  const sim::Plant plant = tests::smallVine();
  const auto radii = render::stemRadii(plant.skeleton, {});
  const auto curves = render::stemCurves(plant.skeleton, radii);
  std::size_t segments = 0;
  for (const auto& stem : curves.stems) segments += stem.nodes.size() - 1;
  EXPECT_EQ(segments, static_cast<std::size_t>(plant.skeleton.size()) - 2);  // two seeds
  for (sim::NodeId n = 0; n < plant.skeleton.size(); ++n) {
    const auto i = static_cast<std::size_t>(n);
    const auto& stem = curves.stems[static_cast<std::size_t>(curves.stem_of[i])];
    expectNear(stem.curve.position(curves.parameter_of[i]), plant.skeleton.position_vx[i], 1e-9);
  }
}

TEST(StemCurves, TheThickestChildContinuesAndAmongEqualsTheStraightest) {
  sim::Skeleton skeleton;
  tests::addNode(skeleton, sim::kNoNode, {0, 0, 0});
  const auto fork = tests::addNode(skeleton, 0, {0, 2, 0});
  const auto bent = tests::addNode(skeleton, fork, {2, 2.5, 0});
  const auto straight = tests::addNode(skeleton, fork, {0.1, 4, 0});
  const auto stemFrom = [&] {
    return render::stemCurves(skeleton, render::stemRadii(skeleton, {})).stems[0].nodes[2];
  };
  EXPECT_EQ(stemFrom(), straight);
  tests::addNode(skeleton, bent, {4, 3, 0});
  tests::addNode(skeleton, bent, {4, 2, 0});  // now the bent one carries two tips
  EXPECT_EQ(stemFrom(), bent);
}

TEST(StemCurves, NodesInOnePlaceAreOneKnot) {
  sim::Skeleton skeleton;
  tests::addNode(skeleton, sim::kNoNode, {0, 0, 0});
  tests::addNode(skeleton, 0, {0, 2, 0});
  tests::addNode(skeleton, 1, {0, 2, 0});
  tests::addNode(skeleton, 2, {0, 4, 0});
  const auto curves = render::stemCurves(skeleton, render::stemRadii(skeleton, {}));
  ASSERT_EQ(curves.stems.size(), 1u);
  EXPECT_EQ(curves.stems[0].nodes.size(), 3u);
  EXPECT_EQ(curves.parameter_of[1], curves.parameter_of[2]);
}

}  // namespace
}  // namespace espalier
