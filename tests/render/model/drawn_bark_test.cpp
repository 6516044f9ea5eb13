#include "render/model/drawn_bark.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "render/image/noise.h"
#include "sim/base/srgb.h"

namespace espalier::render {
namespace {

const sim::Colour kBrown(0.10f, 0.07f, 0.04f);

int redAt(const LeafPicture& bark, int x, int y) {
  return bark.texels[static_cast<std::size_t>(y * bark.width + x)][0];
}

TEST(DrawnBark, GoesOnBeyondItsRims) {
  const LeafPicture& bark = *drawnBark(kBrown);
  EXPECT_TRUE(bark.tiles);
  double within = 0.0, over_the_side = 0.0, over_the_top = 0.0;
  const int last = bark.width - 1;
  for (int i = 0; i < bark.width; ++i) {
    for (int x = 0; x < last; ++x) within += std::abs(redAt(bark, x, i) - redAt(bark, x + 1, i));
    over_the_side += std::abs(redAt(bark, last, i) - redAt(bark, 0, i));
    over_the_top += std::abs(redAt(bark, i, last) - redAt(bark, i, 0));
  }
  within /= last;
  EXPECT_GT(within, 100.0) << "there is something to see";
  EXPECT_LT(over_the_side, 1.6 * within);
  EXPECT_LT(over_the_top, 1.6 * within);
}

TEST(DrawnBark, HasItsColourAndIsOpaque) {
  const LeafPicture& bark = *drawnBark(kBrown);
  double red = 0.0, blue = 0.0;
  for (const auto& texel : bark.texels) {
    EXPECT_EQ(texel[3], 255);
    red += static_cast<double>(sim::linearFromSrgb(static_cast<float>(texel[0]) / 255.0f));
    blue += static_cast<double>(sim::linearFromSrgb(static_cast<float>(texel[2]) / 255.0f));
  }
  const auto count = static_cast<double>(bark.texels.size());
  EXPECT_NEAR(red / count / 0.10, 1.0, 0.25);
  EXPECT_NEAR(blue / count / 0.04, 1.0, 0.3);
  EXPECT_EQ(drawnBark(kBrown), drawnBark(kBrown));
}

TEST(Noise, IsSmoothAndRepeatsByItsPeriod) {
  const Noise noise;
  for (int i = 0; i < 200; ++i) {
    const sim::Vec3f p(0.37f * static_cast<float>(i), 1.0f + 0.11f * static_cast<float>(i),
                       -0.23f * static_cast<float>(i));
    EXPECT_NEAR(noise(p), noise(p + sim::Vec3f(32.0f, -32.0f, 64.0f)), 2e-4f);
    EXPECT_NEAR(noise.tiled(p, {5, 3, 32}), noise.tiled(p + sim::Vec3f(5.0f, -6.0f, 32.0f), {5, 3, 32}),
                2e-4f);
    EXPECT_NEAR(noise(p), noise.tiled(p, {32, 32, 32}), 1e-6f);
    EXPECT_LT(std::abs(noise(p) - noise(p + sim::Vec3f(1e-3f, 0.0f, 0.0f))), 5e-3f);
  }
}

}  // namespace
}  // namespace espalier::render
