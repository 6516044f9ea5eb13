#include "scenes/lights.h"

#include <gtest/gtest.h>

#include "scenes/prepare/job.h"

namespace espalier::scenes {
namespace {

using namespace std::chrono_literals;

SunSpec sydney() {
  SunSpec spec;
  spec.place = SunSpec::Place{-33.87, 151.22, 10.0};
  spec.date = 2019y / 6 / 21;
  spec.shadow_hour = 9.0;
  return spec;
}

TEST(Lights, ASunWithAPlaceIsTheRealOne) {
  const auto spec = sydney();
  const auto sun = makeSun(spec);
  EXPECT_EQ(sun.about, "sun at 33.87 S 151.22 E, 2019-06-21");
  EXPECT_NEAR(sun.totalHours(), 9.9, 0.2);  // midwinter
  // At 9 it stands 19 degrees high, 42.5 degrees east of north (-z).
  const auto shadow = shadowDirection(spec);
  EXPECT_NEAR(shadow.y, 0.325, 0.001);
  EXPECT_NEAR(shadow.x, 0.639, 0.001);
  EXPECT_NEAR(shadow.z, -0.697, 0.001);
}

TEST(Lights, ASunWithoutAPlaceIsTheArc) {
  SunSpec spec;
  spec.toward_deg = 90.0;
  EXPECT_NEAR(makeSun(spec).totalHours(), 12.0, 1e-9);
  EXPECT_GT(sunDirection(spec, 12.0).x, 0.3);
  EXPECT_EQ(shadowDirection(spec), sunDirection(spec, 15.0));
}

TEST(Lights, AJobKnowsItsSkyItsSunAndItsRandomRays) {
  Scene scene;
  scene.world.voxel_m = 0.5;
  scene.world.bounds_m = {{sim::Vec3(-2.0), sim::Vec3(2.0)}};
  scene.seed = 7;
  scene.sun = sydney();
  scene.sky.weighting = sim::Weighting::cosine;
  scene.sky.accuracy = 0.02;
  {
    const auto job = prepareJob(scene);
    EXPECT_FALSE(job.random_sky);
    EXPECT_EQ(job.sky.weighting, sim::Weighting::cosine);
    EXPECT_LE(job.sky.standard_error, 0.02);
    EXPECT_EQ(job.sun.about, makeSun(scene.sun).about);
  }
  scene.sky.sampling = Sampling::random;
  const auto job = prepareJob(scene);
  ASSERT_TRUE(job.random_sky);
  EXPECT_EQ(job.random_sky->rays, 100);
  EXPECT_EQ(job.random_sky->seed, 7u);
}

}  // namespace
}  // namespace espalier::scenes
