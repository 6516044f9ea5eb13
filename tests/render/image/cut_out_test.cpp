#include "render/image/cut_out.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/image/tone.h"
#include "sim/base/error.h"
#include "tests/support/messages.h"

namespace espalier::render {
namespace {

using glm::vec2;
using sim::Colour;

const Colour kBody(0.1f, 0.3f, 0.05f), kLine(0.8f, 0.8f, 0.4f);

/// Twice as high as wide, its lower left corner at a place.
std::vector<CutOutTriangle> diamond(vec2 at, float size) {
  const vec2 left = at + size * vec2(0, 1), right = at + size * vec2(1, 1), foot = at + size * vec2(0.5f, 0),
             top = at + size * vec2(0.5f, 2);
  return {{{left, foot, right}, kBody}, {{left, right, top}, kBody}};
}

double coverageOf(const Image& image) {
  double sum = 0.0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += image.at(x, y)[3];
  }
  return sum;
}

TEST(CutOutDrawing, FillsThePictureAndCoversWhatTheBodyDoes) {
  for (const float size : {0.01f, 7.0f}) {
    const Image image = drawCutOut(diamond({-3.0f, 2.0f}, size), {}, 300, 202);
    EXPECT_EQ(image.channels, 4);
    EXPECT_EQ(image.height, 202);
    EXPECT_EQ(image.width, 102);
    EXPECT_NEAR(coverageOf(image), 100.0 * 200.0 / 2.0, 25.0);
    EXPECT_EQ(image.at(0, 0)[3], 0.0f);
    EXPECT_EQ(image.at(51, 101)[3], 1.0f);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(image.at(0, 0)[c], srgbFromLinear(kBody)[static_cast<int>(c)], 1e-5)
          << "also where it is transparent";
  }
}

TEST(CutOutDrawing, DrawsLinesAsWideAsTheyAre) {
  const auto body = diamond({0, 0}, 1.0f);
  const std::vector<CutOutLine> line{{{0.5f, 0.2f}, {0.5f, 1.8f}, 0.05f, 0.05f, kLine}};
  const Image image = drawCutOut(body, line, 300, 202);
  const float red = srgbFromLinear(kLine).r;
  int wide = 0;
  for (int x = 0; x < image.width; ++x) wide += std::abs(image.at(x, 101)[0] - red) < 0.01f ? 1 : 0;
  EXPECT_NEAR(wide, 10, 1);
  const Image bare = drawCutOut(body, {}, 300, 202);
  EXPECT_LT(image.at(51 + 6, 101)[1], bare.at(51 + 6, 101)[1] + 0.3f);
  EXPECT_NE(image.at(51 + 12, 101)[1], bare.at(51 + 12, 101)[1]) << "lighter along it";
  EXPECT_EQ(image.at(51, 101)[3], 1.0f);
  EXPECT_NEAR(coverageOf(image), coverageOf(bare), 1e-3) << "a line covers nothing beyond the body";
}

TEST(CutOutDrawing, IsSeenOnPaper) {
  const Image paper = onPaper(drawCutOut(diamond({0, 0}, 1.0f), {}, 300, 202));
  EXPECT_EQ(paper.channels, 3);
  EXPECT_GT(paper.at(0, 0)[0], 0.95f);
  EXPECT_NEAR(paper.at(51, 101)[1], srgbFromLinear(kBody).g, 1e-5);
}

TEST(CutOutDrawing, RefusesABodyWithoutArea) {
  const std::vector<CutOutTriangle> flat{{{vec2(0, 0), vec2(1, 1), vec2(2, 2)}, kBody}};
  EXPECT_NE(tests::messageOf([&] { drawCutOut(flat, {}, 100, 100); }).find("without area"),
            std::string::npos);
  EXPECT_THROW(drawCutOut({}, {}, 100, 100), sim::InputError);
}

}  // namespace
}  // namespace espalier::render
