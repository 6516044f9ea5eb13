#include "scenes/show/shown_field.h"

#include <gtest/gtest.h>

#include "rules/growth/front_memory.h"
#include "rules/growth/shared_guide.h"
#include "scenes/show/field_pictures.h"
#include "scenes/show/guide_volumes.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/random.h"
#include "tests/support/messages.h"

namespace espalier::scenes {
namespace {

using rules::Guide;
using rules::GuideAxis;
using sim::Vec3;

const sim::Frame kFrame{Vec3(0.0), 0.1, {64, 64, 64}};

/// A ball of attractors, or its surface, and two starts of the planting that a field bends.
class Shown : public testing::Test {
 protected:
  void make(const Guide& guide, bool surface) {
    growth_ = {};
    auto& columns = growth_.commons[rules::attractorsNamed("ball")];
    auto& at = sim::column<Vec3>(columns, rules::kAttractorPlace);
    auto& normals = sim::column<Vec3>(columns, "normal");
    for (std::uint32_t i = 0; i < 2000; ++i) {
      sim::Draws draws({3, i}, sim::Purpose::custom);
      const Vec3 n = draws.onSphere();
      const double share = surface ? 1.0 : std::cbrt(draws.uniform());
      at.push_back(Vec3(32.0) + 20.0 * share * n);
      normals.push_back(surface ? n : Vec3(0.0));
    }
    growth_.commons[rules::fieldNamed("whorl")] = rules::columnsOf(guide);
    for (const Vec3 start : {Vec3(32, 10, 32), Vec3(32, 54, 32)}) {
      growth_.plants.emplace_back();
      growth_.plants.back().skeleton.position_vx = {start};
      growth_.plants.back().skeleton.parent = {sim::kNoNode};
    }
    growth_.stands = {{0, 0, {}}, {0, 2, {}}};
  }

  sim::Growth growth_;
  const UsedField used_{"whorl", {{1, "ball"}}};
};

Guide whorl(GuideAxis axis) {
  Guide guide;
  guide.axis = axis;
  guide.angle_deg = 360.0;
  guide.strength = 1.5;
  return guide;
}

TEST_F(Shown, AreWhatTheFrontOfTheNearestStartMeets) {
  const Guide guide = whorl(GuideAxis::direction);
  make(guide, false);
  const ShownField field(growth_, used_);
  EXPECT_FALSE(field.onSurfaces());
  EXPECT_EQ(field.starts_vx().size(), 2u);
  // R of each start: to the farthest attractor of its half.
  double farthest = 0.0;
  for (const Vec3& a : field.attractors_vx()) {
    if (a.y < 32.0) farthest = std::max(farthest, glm::distance(a, Vec3(32, 10, 32)));
  }
  const Vec3 below(40, 20, 30), above(40, 44, 30);
  EXPECT_LT(glm::distance(field.at(below), rules::guideAt(guide, {below, {32, 10, 32}, farthest, {}, 0})),
            1e-9);
  EXPECT_LT(glm::dot(field.at(below) * Vec3(0, 1, 0), field.at(above)), 0.0);  // away from their own starts
  EXPECT_NEAR(glm::length(field.at(above)), 1.5, 1e-12);
}

TEST_F(Shown, LieInSurfacesByTheNormalsOfAttractors) {
  make(whorl(GuideAxis::node_normal), true);
  const ShownField field(growth_, used_);
  EXPECT_TRUE(field.onSurfaces());
  const ArrowPlaces places = arrowPlaces(field);
  EXPECT_GT(places.at_vx.size(), 200u);
  EXPECT_LT(places.at_vx.size(), 900u);
  for (std::size_t i = 0; i < places.at_vx.size(); ++i) {
    const Vec3 at = places.at_vx[i];
    EXPECT_NEAR(glm::dot(field.at(at), (at - Vec3(32.0)) / 20.0), 0.0, 1e-9);
    for (std::size_t k = 0; k < i; ++k) EXPECT_GE(glm::distance(at, places.at_vx[k]), places.apart_vx);
  }
}

TEST_F(Shown, HaveArrowsNearAttractorsAlone) {
  Guide guide = whorl(GuideAxis::direction);
  make(guide, false);
  const ArrowPlaces whole = arrowPlaces(ShownField(growth_, used_));
  EXPECT_GT(whole.at_vx.size(), 200u);
  EXPECT_LT(whole.at_vx.size(), 900u);
  for (const Vec3& at : whole.at_vx) EXPECT_LT(glm::distance(at, Vec3(32.0)), 24.0);
  guide.box = {Vec3(32, 20, 20), Vec3(44, 30, 44)};
  make(guide, false);
  const ArrowPlaces part = arrowPlaces(ShownField(growth_, used_));
  EXPECT_GT(part.at_vx.size(), 80u);
  EXPECT_LT(part.apart_vx, whole.apart_vx);
  for (const Vec3& at : part.at_vx)
    EXPECT_TRUE(at.x >= 32 && at.y >= 20 && at.y <= 30) << at.x << " " << at.y;
  guide.box = {Vec3(0, 0, 0), Vec3(1, 1, 1)};
  make(guide, false);
  EXPECT_TRUE(arrowPlaces(ShownField(growth_, used_)).at_vx.empty());
}

TEST_F(Shown, FollowAngleStrengthAndCamera) {
  const render::Camera camera{{3.2, 5.0, 10.0}, {3.2, 3.2, 3.2}, 40};
  const auto drawn = [&](double angle, GuideAxis axis, double strength = 1.5) {
    Guide guide = whorl(axis);
    guide.angle_deg = angle;
    guide.strength = strength;
    make(guide, axis == GuideAxis::node_normal);
    render::Image picture(160, 120, 3);
    drawField(picture, ShownField(growth_, used_), "field", kFrame, camera, nullptr);
    return picture.pixels;
  };
  const auto one = drawn(360.0, GuideAxis::direction);
  sim::onThreads(3, [&] { EXPECT_EQ(drawn(360.0, GuideAxis::direction), one); });
  EXPECT_NE(drawn(120.0, GuideAxis::direction), one);
  EXPECT_NE(drawn(360.0, GuideAxis::node_normal), one);
  EXPECT_NE(drawn(360.0, GuideAxis::direction, 0.0), one);  // without an arrow
}

TEST_F(Shown, AreVolumesAroundAttractors) {
  make(whorl(GuideAxis::direction), false);
  const sim::World world(kFrame);
  const GuideVolumes volumes = guideVolumes(growth_, {{"nobody's", {}}, used_}, world);
  ASSERT_EQ(volumes.fields.size(), 1u);
  EXPECT_EQ(volumes.fields[0].name, "field whorl");
  EXPECT_GT(volumes.near->count(), 20'000u);
  const ShownField field(growth_, used_);
  for (const Vec3& at : field.attractors_vx()) EXPECT_TRUE(volumes.near->has(sim::voxelAt(at)));
  const auto& parts = std::get<std::vector<render::VdbPart<sim::Vec3f>>>(volumes.fields[0].parts);
  const sim::Voxel v(30, 40, 35);
  ASSERT_TRUE(volumes.near->has(v));
  EXPECT_EQ(parts.at(0).value(v, 0), sim::Vec3f(field.at(Vec3(v))));
  EXPECT_TRUE(guideVolumes(growth_, {}, world).fields.empty());
}

TEST_F(Shown, ThatNothingHasGrownWithAreRefused) {
  make(whorl(GuideAxis::direction), false);
  EXPECT_EQ(tests::messageOf([&] {
              ShownField(growth_, {"wind", {{1, "ball"}}});
            }),
            "what has grown knows no field 'wind'; expected it there when it grew");
  EXPECT_EQ(tests::messageOf([&] {
              ShownField(growth_, {"whorl", {{1, "hedge"}}});
            }),
            "what has grown knows no attractors 'hedge'; expected it there when it grew");
}

}  // namespace
}  // namespace espalier::scenes
