#include "render/image/bloom.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "sim/base/parallel.h"

namespace espalier {
namespace {

using render::bloom;
using render::Image;

/// A dark picture with bright places, one of them in a corner.
Image lamps(int width, int height) {
  Image image(width, height, 3, 0.05f);
  for (const auto& [x, y] : {std::pair{width / 2, height / 2}, {0, 0}, {width / 3, height - 1}}) {
    image.at(x, y)[0] = 20.0f;
    image.at(x, y)[1] = 30.0f;
    image.at(x, y)[2] = 60.0f;
  }
  return image;
}

std::array<double, 3> lightOf(const Image& image) {
  std::array<double, 3> sum{};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) sum[i % 3] += static_cast<double>(image.pixels[i]);
  return sum;
}

TEST(Bloom, KeepsTheLightOfThePicture) {
  for (const auto& [width, height] : {std::pair{160, 120}, {37, 91}, {400, 16}, {1, 1}}) {
    Image image = lamps(width, height);
    const auto before = lightOf(image);
    bloom(image, 0.6);
    const auto after = lightOf(image);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(after[c] / before[c], 1.0, 1e-5) << width;
  }
}

TEST(Bloom, SpreadsAsFarAsItsGaussiansAndAlikeToAllSides) {
  constexpr int kSize = 401, kMiddle = 200;
  Image image(kSize, kSize, 3);
  image.at(kMiddle, kMiddle)[1] = 1000.0f;
  bloom(image, 1.0);
  double sum = 0.0, squares = 0.0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double light = x == kMiddle && y == kMiddle ? 0.0 : static_cast<double>(image.at(x, y)[1]);
      sum += light;
      squares += light * (x - kMiddle) * (x - kMiddle);
    }
  }
  const double h = kSize;
  const double variance = h * h * (0.5 * 0.004 * 0.004 + 0.3 * 0.016 * 0.016 + 0.2 * 0.06 * 0.06);
  EXPECT_NEAR(squares / 1000.0, variance, 0.02 * variance);
  for (const int far : {3, 12, 40}) {
    const float light = image.at(kMiddle + far, kMiddle)[1];
    EXPECT_GT(light, 0.0f);
    for (const auto& [x, y] : {std::pair{-far, 0}, {0, far}, {0, -far}})
      EXPECT_NEAR(image.at(kMiddle + x, kMiddle + y)[1], light, 1e-3f * light);
  }
  EXPECT_EQ(image.at(kMiddle + 3, kMiddle)[0], 0.0f) << "in its own colour";
}

TEST(Bloom, LeavesWhatIsEvenEvenAndWhatIsNotBrightAsItIs) {
  Image even(50, 30, 3, 9.0f);
  bloom(even, 0.5);
  for (const float value : even.pixels) EXPECT_NEAR(value, 9.0f, 1e-4f);
  Image dim(50, 30, 3, 0.3f);
  dim.at(20, 20)[2] = 1.5f;
  const Image before = dim;
  bloom(dim, 0.9);
  EXPECT_EQ(dim.pixels, before.pixels);
  Image bright = lamps(60, 40);
  const Image lit = bright;
  bloom(bright, 0.0);
  EXPECT_EQ(bright.pixels, lit.pixels);
  bloom(bright, 0.1);
  EXPECT_NE(bright.pixels, lit.pixels);
}

TEST(Bloom, IsTheSameOnAnyNumberOfThreads) {
  Image one = lamps(160, 120), five = one;
  sim::onThreads(1, [&] { bloom(one, 0.3); });
  sim::onThreads(5, [&] { bloom(five, 0.3); });
  EXPECT_EQ(one.pixels, five.pixels);
}

}  // namespace
}  // namespace espalier
