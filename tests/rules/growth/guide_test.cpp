#include "rules/front/guide.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rules/growth/front_bend.h"
#include "rules/growth/front_memory.h"
#include "rules/growth/make_process.h"
#include "rules/growth/shared_guide.h"
#include "sim/base/error.h"
#include "sim/base/random.h"
#include "sim/grow/grow.h"
#include "tests/rules/front/points.h"
#include "tests/support/lively.h"

namespace espalier {
namespace {

using rules::Guide;
using rules::GuideAxis;
using sim::Vec3;

constexpr double kPi = 3.14159265358979323846;

TEST(Guide, TurnsByTheAngleThatBuildsUpWithTheDistance) {
  Guide guide;
  guide.angle_deg = 360.0;
  guide.strength = 2.0;
  for (const double r : {1.0, 5.0, 10.0}) {
    const Vec3 way = rules::guideAt(guide, {{r, 0, 0}, Vec3(0.0), 10.0, {}, 0});
    EXPECT_NEAR(glm::length(way), 2.0, 1e-12);
    // About +y by the right hand: from +x towards -z.
    EXPECT_NEAR(std::atan2(-way.z, way.x), std::atan(2.0 * kPi * r / 10.0), 1e-12);
    EXPECT_EQ(way.y, 0.0);
  }
  // No angle, or no distance, no turn.
  guide.angle_deg = 0.0;
  EXPECT_EQ(rules::guideAt(guide, {{3, 0, 0}, Vec3(0.0), 10.0, {}, 0}), Vec3(2, 0, 0));
  EXPECT_EQ(rules::guideAt(guide, {Vec3(0.0), Vec3(0.0), 10.0, {}, 0}), Vec3(0.0));
}

/// By how far a way that follows the field alone winds about +y from near the start to the farthest distance.
double windingOfSpiral(double angle_deg) {
  Guide guide;
  guide.angle_deg = angle_deg;
  Vec3 at(1e-3, 0, 0);
  double wound = 0.0;
  while (glm::length(at) < 1.0) {
    const Vec3 next =
        at + 1e-4 * rules::guidedWay({0, 0, 0}, rules::guideAt(guide, {at, Vec3(0.0), 1.0, {}, 0}));
    wound += std::atan2(next.x * at.z - next.z * at.x, next.x * at.x + next.z * at.z);
    at = next;
  }
  return wound * 180.0 / kPi;
}

TEST(Guide, WindsAWayByItsAngle) {
  for (const double angle : {-120.0, 0.0, 120.0, 360.0, 720.0})
    EXPECT_NEAR(windingOfSpiral(angle), angle, 0.01 * std::abs(angle) + 0.2);
}

TEST(Guide, LiesInTheSurfaceAboutNormals) {
  Guide guide;
  guide.axis = GuideAxis::node_normal;
  guide.angle_deg = 200.0;
  const Vec3 normal = glm::normalize(Vec3(1, 2, -0.5));
  const Vec3 way = rules::guideAt(guide, {{3, 1, 2}, Vec3(0.0), 5.0, normal, 0});
  EXPECT_NEAR(glm::dot(way, normal), 0.0, 1e-12);
  EXPECT_NEAR(glm::length(way), 1.0, 1e-12);
  guide.follows_normal = true;
  EXPECT_NEAR(glm::length(rules::guideAt(guide, {{3, 1, 2}, Vec3(0.0), 5.0, 2.5 * normal, 0})), 2.5, 1e-12);
  EXPECT_EQ(rules::guideAt(guide, {{3, 1, 2}, Vec3(0.0), 5.0, Vec3(0.0), 0}), Vec3(0.0));
}

TEST(Guide, HoldsWhereItIsSaidTo) {
  Guide guide;
  guide.box = {Vec3(0.0), Vec3(4.0)};
  guide.orders = {1, 2};
  const auto at = [&](Vec3 place, int order) {
    return rules::guideAt(guide, {place, Vec3(-1.0), 10.0, {}, order}) != Vec3(0.0);
  };
  EXPECT_TRUE(at({1, 1, 1}, 1));
  EXPECT_FALSE(at({1, 5, 1}, 1));
  EXPECT_FALSE(at({1, 1, 1}, 0));
  // In a region of cubes, of which the second and the fourth are in.
  const std::vector<std::int64_t> words = {0b1010};
  Guide within;
  within.region = {{2, 2, 2}, 2.0, {2, 2, 1}, words};
  const auto in = [&](Vec3 place) {
    return rules::guideAt(within, {place, Vec3(-1.0), 10.0, {}, 0}) != Vec3(0.0);
  };
  EXPECT_TRUE(in({3.1, 1.1, 2.9}));
  EXPECT_TRUE(in({4.9, 4.9, 1.1}));
  EXPECT_FALSE(in({2.9, 2, 2}));
  EXPECT_FALSE(in({5.1, 2, 2}));
  EXPECT_FALSE(in({4, 2, 3.1}));
  EXPECT_FALSE(in({4, 0.9, 2}));
  // About a point it is another one.
  Guide pointed;
  pointed.strength = 0.0;
  pointed.points = {{{5, 0, 0}, 2.0, 0.0, 3.0}};
  const auto strength = [&](Vec3 place) {
    return glm::length(rules::guideAt(pointed, {place, Vec3(0.0), 10.0, {}, 0}));
  };
  EXPECT_NEAR(strength({5, 0, 0}), 3.0, 1e-12);
  EXPECT_GT(strength({6, 0, 0}), 1.0);
  EXPECT_LT(strength({6, 0, 0}), 3.0);
  EXPECT_EQ(strength({7, 0, 0}), 0.0);
}

TEST(Guide, TakesItsAxisFromAGrid) {
  Guide guide;
  guide.axis = GuideAxis::grid;
  guide.angle_deg = 90.0;
  const std::vector<Vec3> up(8, Vec3(0, 1, 0));
  guide.grid = {{0, 0, 0}, 2.0, {2, 2, 2}, up};
  Guide plain;
  plain.angle_deg = 90.0;
  const rules::GuidePlace in{{1.5, 0.5, 1}, {-1, 0, 0}, 5.0, {}, 0};
  EXPECT_NEAR(glm::distance(rules::guideAt(guide, in), rules::guideAt(plain, in)), 0.0, 1e-12);
  EXPECT_EQ(rules::guideAt(guide, {{2.5, 0.5, 1}, {-1, 0, 0}, 5.0, {}, 0}), Vec3(0.0));
}

TEST(Guide, IsTheSameOutOfColumns) {
  Guide guide;
  guide.angle_deg = 12.0;
  guide.strength = 0.5;
  guide.axis = GuideAxis::grid;
  guide.direction = {1, 0, 0};
  guide.follows_normal = true;
  guide.points = {{{1, 2, 3}, 4.0, 5.0, 6.0}};
  guide.box = {Vec3(0.0), Vec3(9.0)};
  guide.orders = {0, 2};
  const std::vector<Vec3> vectors = {{0, 1, 0}, {1, 1, 0}};
  guide.grid = {{0, 1, 0}, 2.0, {1, 2, 1}, vectors};
  const std::vector<std::int64_t> words = {0b1011, 7};
  guide.region = {{1, 2, 3}, 0.5, {5, 5, 3}, words};
  const sim::Columns columns = rules::columnsOf(guide);
  EXPECT_EQ(rules::columnsOf(rules::guideIn(columns)), columns);
  sim::Columns broken = columns;
  sim::column<std::int32_t>(broken, "grid_size") = {1, 2, 3};
  EXPECT_THROW(rules::guideIn(broken), sim::BrokenContract);
  broken = columns;
  sim::column<std::int32_t>(broken, "region_size") = {5, 5, 6};
  EXPECT_THROW(rules::guideIn(broken), sim::BrokenContract);
}

/// A front over a sphere or through a ball, from below.
struct Ball {
  static constexpr double kRadius = 20.0;
  Vec3 middle{32, 32, 32};
  std::vector<Vec3> at, normal;

  explicit Ball(bool surface) {
    for (std::uint32_t i = 0; i < 2500; ++i) {
      sim::Draws draws({3, i}, sim::Purpose::custom);
      const Vec3 n = draws.onSphere();
      const double share = surface ? 1.0 : std::cbrt(draws.uniform());
      at.push_back(middle + kRadius * share * n);
      normal.push_back(surface ? n : Vec3(0.0));
    }
  }
};

sim::Growth grownOn(const Ball& ball, const std::optional<Guide>& guide) {
  sim::World world({Vec3(0.0), 0.05, {64, 64, 64}});
  world.setLayers(2);
  rules::RuleSet rules;
  rules.propagate = rules::Propagate::colonization;
  rules.colonization.attractors = "ball";
  rules.colonization.step = {1.0};
  rules.colonization.influence = {8.0};
  rules.colonization.kill = {1.5};
  sim::GrowthSettings settings = tests::brightSettings(400);
  sim::Columns& columns = settings.commons[rules::attractorsNamed("ball")];
  sim::column<Vec3>(columns, rules::kAttractorPlace) = ball.at;
  sim::column<Vec3>(columns, "normal") = ball.normal;
  if (guide) {
    rules.colonization.fields = {"whorl"};
    settings.commons[rules::fieldNamed("whorl")] = rules::columnsOf(*guide);
  }
  return sim::grow(world, tests::planting(world, rules, {{32, 12, 32}}), settings);
}

/// By how far ways from the start have wound about the upright axis through it when they end, in the mean,
/// turns.
double meanWinding(const sim::Growth& growth) {
  const sim::Skeleton& skeleton = growth.plants[0].skeleton;
  const Vec3 start = skeleton.position_vx[0];
  std::vector<double> wound(skeleton.parent.size(), 0.0);
  std::vector<bool> leads_on(skeleton.parent.size(), false);
  for (std::size_t n = 1; n < wound.size(); ++n) {
    const auto p = static_cast<std::size_t>(skeleton.parent[n]);
    leads_on[p] = true;
    const Vec3 a = skeleton.position_vx[p] - start, b = skeleton.position_vx[n] - start;
    const bool near = std::hypot(a.x, a.z) < 1.0 || std::hypot(b.x, b.z) < 1.0;
    wound[n] = wound[p] + (near ? 0.0 : std::atan2(b.x * a.z - b.z * a.x, a.x * b.x + a.z * b.z));
  }
  double sum = 0.0, ends = 0.0;
  for (std::size_t n = 0; n < wound.size(); ++n) {
    if (!leads_on[n]) sum += wound[n], ends += 1.0;
  }
  return sum / ends / (2.0 * kPi);
}

class Whorls : public testing::TestWithParam<bool> {};

// Figures 7 to 9 of Tanaka et al. 2022: more angle, tighter whorls.
TEST_P(Whorls, AreTighterByMoreAngle) {
  const Ball ball(GetParam());
  Guide guide;
  guide.axis = GetParam() ? GuideAxis::node_normal : GuideAxis::direction;
  guide.strength = 2.0;
  std::vector<double> winding;
  for (const double angle : {0.0, 120.0, 360.0, 720.0}) {
    guide.angle_deg = angle;
    const sim::Growth growth = grownOn(ball, guide);
    EXPECT_GT(growth.plants[0].skeleton.size(), 1000) << angle;
    winding.push_back(meanWinding(growth));
    RecordProperty("winding", std::to_string(winding.back()));
  }
  EXPECT_NEAR(winding[0], 0.0, 0.05);
  EXPECT_GT(std::abs(winding[1]), std::abs(winding[0]) + 0.05);
  EXPECT_GT(std::abs(winding[2]), std::abs(winding[1]) + 0.05);
  EXPECT_GT(std::abs(winding[3]), std::abs(winding[2]) + 0.05);
}

TEST_P(Whorls, AreNoneWithoutStrength) {
  const Ball ball(GetParam());
  Guide guide;
  guide.axis = GetParam() ? GuideAxis::attractor_normal : GuideAxis::direction;
  guide.angle_deg = 720.0;
  guide.strength = 0.0;
  EXPECT_EQ(grownOn(ball, guide).plants[0].skeleton.position_vx,
            grownOn(ball, std::nullopt).plants[0].skeleton.position_vx);
  guide.strength = 0.5;  // the control
  EXPECT_NE(grownOn(ball, guide).plants[0].skeleton.position_vx,
            grownOn(ball, std::nullopt).plants[0].skeleton.position_vx);
}

INSTANTIATE_TEST_SUITE_P(Shape, Whorls, testing::Bool(), [](const auto& on) {
  return on.param ? std::string("OnASphere") : std::string("InABall");
});

TEST(Angles, AreKeptInThePlaneOfBoth) {
  const Vec3 heading(0, 1, 0), way = glm::normalize(Vec3(1, 1, 0));
  EXPECT_EQ(rules::withinAngles(way, heading, 30.0, 60.0), way);
  EXPECT_NEAR(glm::distance(rules::withinAngles(way, heading, 60.0, 90.0),
                            Vec3(std::sin(kPi / 3), std::cos(kPi / 3), 0)),
              0.0, 1e-12);
  EXPECT_NEAR(glm::distance(rules::withinAngles(way, heading, 0.0, 30.0),
                            Vec3(std::sin(kPi / 6), std::cos(kPi / 6), 0)),
              0.0, 1e-12);
  EXPECT_NEAR(glm::dot(rules::withinAngles(heading, heading, 40.0, 90.0), heading), std::cos(kPi * 40 / 180),
              1e-12);
}

}  // namespace
}  // namespace espalier
