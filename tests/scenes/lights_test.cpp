#include "scenes/lights.h"

#include <gtest/gtest.h>

namespace espalier::scenes {
namespace {

using namespace std::chrono_literals;

SunSpec sydney() {
  SunSpec spec;
  spec.place = SunPlace{-33.87, 151.22, 10.0};
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

}  // namespace
}  // namespace espalier::scenes
