#include "sim/light/background.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/light/brightest.h"
#include "sim/light/sun.h"

namespace espalier::sim {
namespace {

TEST(Background, AGradientGoesFromTheZenithToTheHorizon) {
  const Background sky = gradient(0.25);
  EXPECT_DOUBLE_EQ(sky({0, 1, 0}), 1.0);
  EXPECT_NEAR(sky(glm::normalize(Vec3(1, 1e-9, 0))), 0.25, 1e-6);
  EXPECT_DOUBLE_EQ(sky({0.8, 0.6, 0}), 0.25 + 0.75 * 0.6);
}

TEST(Background, APictureIsTurnedByTheCompass) {
  SkyPicture picture;
  for (int row = 0; row < SkyPicture::kRows; ++row) {
    for (int column = 0; column < SkyPicture::kColumns; ++column)
      picture.radiance.push_back(static_cast<float>(1000 * row + column));
  }
  const auto at = [&](double turn_deg, Vec3 way) { return pictured(picture, turn_deg)(glm::normalize(way)); };
  const double low = std::tan(0.5 * std::numbers::pi / 180.0);  // half a degree up: the last row
  EXPECT_EQ(at(0, {1e-6, low, -1}), 89'180.0) << "the middle lies in the north";
  EXPECT_EQ(at(0, {1, low, 1e-6}), 89'270.0) << "east is a quarter to the right";
  EXPECT_EQ(at(90, {1, low, 1e-6}), 89'180.0) << "turned, its middle lies in the east";
  EXPECT_EQ(at(180, {-1e-6, low, 1}), 89'180.0);
  EXPECT_EQ(std::floor(at(0, {0, 1, 0}) / 1000.0), 0.0) << "the zenith is the first row";
}

TEST(Background, TheBandLiesAlongTheSunsWayAndLeadsToItsTop) {
  const Sun sun = makeSun(SunArc{30.0, 180.0, 48});
  const Background plain = backgroundOf(Weighting::uniform);
  const Background banded = withBand(plain, sun.directions, {5.0, 20.0});
  const Vec3 top(0, std::cos(std::numbers::pi / 6), std::sin(std::numbers::pi / 6));
  EXPECT_NEAR(banded(top), 6.0, 0.3) << "a direction stands for it within half a degree";
  EXPECT_DOUBLE_EQ(banded(glm::normalize(Vec3(0, 1, -1))), 1.0) << "75 degrees from the way's top";
  const auto brightestOf = [](const Background& sky) {
    const SkyTable table = makeSkyTable(9, 36, sky);
    return SkyFilter(table).brightest(
        std::vector<std::uint64_t>((table.rays.size() + 63) / 64, ~std::uint64_t{0}));
  };
  const Vec3 seen = brightestOf(banded), before = brightestOf(plain);
  EXPECT_NEAR(seen.x, 0.0, 0.03);
  EXPECT_GT(glm::dot(seen, top), glm::dot(before, top));
  EXPECT_GT(seen.z, 0.15);
  EXPECT_EQ(withBand(plain, sun.directions, {})(top), 1.0);
}

}  // namespace
}  // namespace espalier::sim
