#include "render/image/arrow_drawing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/image/drawing.h"
#include "render/voxels/pale_scene.h"
#include "tests/support/golden.h"

namespace espalier::render {
namespace {

using sim::Vec3;

const Camera kCamera{{0.0, 0.0, 9.0}, {0.0, 0.0, 0.0}, 36.0};

/// How much ink lies in a part of a white picture.
double inkIn(const Image& image, int x0, int x1) {
  double sum = 0.0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = x0; x < x1; ++x) {
      for (int c = 0; c < 3; ++c) sum += 1.0 - image.at(x, y)[c];
    }
  }
  return sum;
}

Image drawn(const std::vector<SpaceArrow>& arrows) {
  Image image(200, 150, 3, 1.0f);
  drawArrows(image, arrows, kCamera, 0.08);
  return image;
}

TEST(Arrows, HaveTheirHeadsWhereTheyPoint) {
  const Image right = drawn({{{-1, 0, 0}, {1, 0, 0}}});
  EXPECT_GT(inkIn(right, 100, 200), 1.25 * inkIn(right, 0, 100));
  const Image left = drawn({{{1, 0, 0}, {-1, 0, 0}}});
  EXPECT_NEAR(inkIn(left, 0, 100), inkIn(right, 100, 200), 0.02 * inkIn(right, 100, 200));
}

TEST(Arrows, HaveTheColourOfTheirWay) {
  EXPECT_EQ(colourOfWay({1, 0, 0}), colourOfWay({-1, 0, 0}));
  EXPECT_NE(colourOfWay({1, 0, 0}), colourOfWay({0, 1, 0}));
  const sim::Colour half = colourOfWay({std::sqrt(0.5), std::sqrt(0.5), 0});
  const sim::Colour mean = 0.5f * (colourOfWay({1, 0, 0}) + colourOfWay({0, 1, 0}));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(half[c], mean[c], 1e-6);
}

TEST(Arrows, ThatAreHiddenAreFaintAndThoseBehindTheEyeAreNone) {
  const double clear = inkIn(drawn({{{-1, 0, 0}, {1, 0, 0}}}), 0, 200);
  const double hidden = inkIn(drawn({{{-1, 0, 0}, {1, 0, 0}, true}}), 0, 200);
  EXPECT_LT(hidden, 0.3 * clear);
  EXPECT_GT(hidden, 0.02 * clear);
  EXPECT_EQ(
      inkIn(drawn({{{-1, 0, 10}, {1, 0, 10}}, {{0, 0, 5}, {0, 0, 12}}, {{1, 1, 0}, {1, 1, 0}}}), 0, 200),
      0.0);
}

TEST(Arrows, TheNearestLieOnTop) {
  const std::vector<SpaceArrow> crossed = {{{0, -1, 1}, {0, 1, 1}}, {{-1, 0, -1}, {1, 0, -1}}};
  const Image one = drawn(crossed), other = drawn({crossed[1], crossed[0]});
  EXPECT_EQ(one.pixels, other.pixels);
  const float* const middle = one.at(100, 75);
  EXPECT_GT(middle[1], middle[0]);  // green, as what points up
}

TEST(Arrows, LookAsTheyDid) {
  std::vector<SpaceArrow> arrows;
  for (int x = -4; x <= 4; ++x) {
    for (int y = -3; y <= 3; ++y) {
      const Vec3 at(0.55 * x, 0.55 * y, 0.2 * x * y);
      const Vec3 half = 0.25 * glm::normalize(Vec3(-y, x, 0.3) + Vec3(x, y, 0.0) * 0.4);
      arrows.push_back({at - half, at + half, x == 4});
    }
  }
  Image image = paper(240, 180);
  drawArrows(image, arrows, kCamera, 0.035);
  tests::expectLikeGolden(image, "arrows");
}

TEST(Triangles, CoverTheirArea) {
  const auto area = [](glm::vec2 a, glm::vec2 b, glm::vec2 c) {
    Image image(80, 80, 3, 1.0f);
    fillTriangle(image, a, b, c, {sim::Colour(0.0f), 1.0f});
    return inkIn(image, 0, 80) / 3.0;
  };
  EXPECT_NEAR(area({10, 10}, {70, 10}, {10, 70}), 1800.0, 10.0);
  EXPECT_NEAR(area({10, 10}, {10, 70}, {70, 10}), 1800.0, 10.0);
  EXPECT_EQ(area({10, 10}, {20, 20}, {30, 30}), 0.0);
  EXPECT_NEAR(area({-40, 40}, {40, -40}, {120, 40}), 80.0 * 40.0, 30.0);  // cut off on all sides
}

}  // namespace
}  // namespace espalier::render
