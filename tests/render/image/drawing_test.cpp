#include "render/image/drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "render/image/contact_sheet.h"
#include "render/image/legend.h"
#include "render/image/tone.h"
#include "render/voxels/attempts.h"
#include "render/voxels/section.h"
#include "sim/base/error.h"

namespace espalier::render {
namespace {

constexpr Ink kBlack{sim::Colour(0.0f), 1.0f};

/// How much of a white picture is covered, in pixels.
double covered(const Image& image) {
  double sum = 0.0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) sum += 1.0 - static_cast<double>(image.pixels[i]);
  return sum;
}

TEST(Drawing, BoxesCoverTheirAreaToAFractionOfAPixel) {
  Image image(40, 30, 3, 1.0f);
  fillBox(image, {3.25f, 4.5f}, {17.75f, 9.125f}, kBlack);
  EXPECT_NEAR(covered(image), 14.5 * 4.625, 1e-3);
  Image hair(40, 30, 3, 1.0f);
  fillBox(hair, {3.0f, 4.4f}, {23.0f, 4.6f}, kBlack);
  EXPECT_NEAR(covered(hair), 20 * 0.2, 1e-3);
  Image rounded(40, 30, 3, 1.0f);
  fillBox(rounded, {5, 5}, {35, 25}, kBlack, 6.0f);
  EXPECT_NEAR(covered(rounded), 30 * 20 - (4 - 3.14159) * 36, 2.0);
}

TEST(Drawing, SegmentsCoverLengthTimesWidthAtAnySlope) {
  for (const float angle : {0.0f, 0.3f, 0.785f, 1.2f, 1.57f}) {
    for (const float width : {0.4f, 1.0f, 2.5f}) {
      Image image(80, 80, 3, 1.0f);
      const glm::vec2 along(std::cos(angle), std::sin(angle));
      drawSegment(image, glm::vec2(40.3f) - 25.0f * along, glm::vec2(40.3f) + 25.0f * along, width, kBlack);
      EXPECT_NEAR(covered(image), 51.0f * width, 0.14f * 51.0f * width) << angle << ' ' << width;
    }
  }
}

TEST(Drawing, WhatFallsOutsideIsCutOff) {
  Image image(20, 20, 3, 1.0f);
  fillBox(image, {-50, -50}, {5, 5}, kBlack);
  EXPECT_NEAR(covered(image), 25.0, 1e-4);
  drawSegment(image, {-100, 300}, {400, -1e6f}, 2.0f, kBlack);
  drawText(image, {-30, 10}, "cut on both sides of the picture", {14, kBlack});
  drawText(image, {500, 500}, "far away", {14, kBlack});
  for (const float v : image.pixels) ASSERT_TRUE(v >= -1e-6f && v <= 1.0f);
}

TEST(Drawing, TextIsPlacedByItsAlignment) {
  const std::string text = "exposure";
  const float width = textWidth(text, 20);
  EXPECT_GT(width, 60);
  EXPECT_GT(textWidth(text, 20, Font::bold), width);
  const auto columns = [&](Align align) {
    Image image(300, 40, 3, 1.0f);
    drawText(image, {150, 28}, text, {20, kBlack, align});
    int first = 300, last = -1;
    for (int x = 0; x < 300; ++x)
      for (int y = 0; y < 40; ++y)
        if (image.at(x, y)[0] < 0.9f) first = std::min(first, x), last = std::max(last, x);
    return std::pair<float, float>(static_cast<float>(first), static_cast<float>(last + 1));
  };
  EXPECT_NEAR(columns(Align::left).first, 150, 1.5);
  EXPECT_NEAR(columns(Align::left).second, 150 + width, 1.5);
  EXPECT_NEAR(columns(Align::right).second, 150, 1.5);
  const auto [first, last] = columns(Align::centre);
  EXPECT_NEAR(0.5f * (first + last), 150, 1.5);
}

TEST(Drawing, CharactersBeyondAsciiAreQuestionMarks) {
  Image odd(200, 40, 3, 1.0f), plain(200, 40, 3, 1.0f);
  drawText(odd, {10, 28}, "20\u00b0 \u65e5", {18, kBlack});
  drawText(plain, {10, 28}, "20? ?", {18, kBlack});
  EXPECT_EQ(odd.pixels, plain.pixels);
  EXPECT_GT(covered(odd), 50);
}

TEST(Drawing, ResizingKeepsWhatIsEvenAndTheMean) {
  const Image even = resized(Image(100, 80, 3, 0.37f), 33, 21);
  EXPECT_EQ(even.width, 33);
  EXPECT_EQ(even.height, 21);
  for (const float v : even.pixels) ASSERT_NEAR(v, 0.37f, 1e-5f);
  Image checks(90, 90, 3);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 90; ++x)
      if ((x / 2 + y / 2) % 2) std::fill_n(checks.at(x, y), 3, 1.0f);
  const Image small = resized(checks, 30, 30);
  double sum = 0.0;
  for (const float v : small.pixels) sum += static_cast<double>(v);
  EXPECT_NEAR(sum / static_cast<double>(small.pixels.size()), 0.5, 0.01);
}

TEST(Legend, KeepsClearOfTheEdgesAndShowsTheMap) {
  const ColourMap map("viridis");
  Image image(640, 480, 3, 0.5f);
  drawLegend(image, BarLegend{"sky exposure", "solid-angle weighted"}, map);
  int changed = 0;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      if (image.at(x, y)[0] == 0.5f) continue;
      ++changed;
      EXPECT_TRUE(x >= 8 && y < 472 && x < 400 && y > 240) << x << ' ' << y;
    }
  }
  EXPECT_GT(changed, 5000);
  // Somewhere in the legend each of the map's colours stands, from left to right.
  int found_at = 0;
  for (int i = 0; i <= 10; ++i) {
    const sim::Colour wanted = srgbFromLinear(map(static_cast<float>(i) / 10.0f));
    bool found = false;
    for (int x = found_at; x < 640 && !found; ++x) {
      for (int y = 240; y < 480 && !found; ++y) {
        const float* p = image.at(x, y);
        found = glm::distance(sim::Colour(p[0], p[1], p[2]), wanted) < 0.012f;
        if (found) found_at = x;
      }
    }
    EXPECT_TRUE(found) << i;
  }
}

TEST(ContactSheet, SetsPicturesInRows) {
  const Image red(80, 60, 3, 0.25f), blue(80, 60, 3, 0.75f);
  const std::vector<Captioned> four = {
      {&red, "A", "one"}, {&blue, "B", "two"}, {&red, "C", "three"}, {&blue, "D", ""}};
  const Image sheet = contactSheet(four, {3, 40, "", ""});
  EXPECT_GT(sheet.width, 3 * 40);
  EXPECT_LT(sheet.width, 3 * 40 + 4 * 40);
  EXPECT_GT(sheet.height, 2 * 30);
  EXPECT_NE(std::count(sheet.pixels.begin(), sheet.pixels.end(), 0.25f), 0);
  EXPECT_NE(std::count(sheet.pixels.begin(), sheet.pixels.end(), 0.75f), 0);
  const Image grey(80, 60, 1);
  const std::vector<Captioned> odd = {{&red, "", ""}, {&grey, "", ""}};
  EXPECT_THROW(contactSheet(odd), sim::InputError);
  EXPECT_THROW(contactSheet({}), sim::InputError);
}

TEST(ContactSheet, ShowsPicturesOfOtherShapesWhole) {
  const Image wide(80, 20, 3, 0.125f), tower(20, 200, 3, 0.75f);
  const std::vector<Captioned> both = {{&wide, "", ""}, {&tower, "", ""}};
  const Image sheet = contactSheet(both, {2, 40, "", ""});
  const auto pixelsOf = [&](float value) {
    return std::count_if(sheet.pixels.begin(), sheet.pixels.end(),
                         [=](float v) { return std::abs(v - value) < 0.01f; }) /
           3;
  };
  EXPECT_EQ(pixelsOf(0.125f), 40 * 10);
  EXPECT_EQ(pixelsOf(0.75f), 4 * 40) << "as high as a square cell";
}

TEST(Section, PutsVoxelsWhereTheyBelong) {
  // An occupied voxel in the lower left corner, layer 1 to its right, free space above.
  const auto cut = [](glm::ivec2 v) {
    return Cut{v == glm::ivec2(0), v == glm::ivec2(1, 0) ? 1 : 0, sim::Colour(0.5f)};
  };
  SectionLook look{{4, 3}, 1, 400, "layers"};
  const Image image = drawSection(cut, look);
  ASSERT_EQ(image.width, 400);
  ASSERT_EQ(image.height, 300);
  // The legend lies over the lower left, so the middle of the upper rows and the right is looked at.
  EXPECT_GT(image.at(350, 50)[0], 0.9f) << "free space is near white";
  const Image bare = drawSection([&](glm::ivec2 v) { return cut(v); }, {{4, 3}, 0, 400, ""});
  EXPECT_LT(bare.at(50, 250)[0], 0.6f) << "occupied is dark";
  EXPECT_GT(bare.at(150, 250)[0], 0.9f) << "layers that were not asked for stay white";
  EXPECT_LT(bare.at(100, 50)[0], bare.at(50, 50)[0]) << "a line between voxels";
  EXPECT_THROW(drawSection(cut, {{0, 3}, 1, 400, ""}), sim::InputError);
}

TEST(Attempts, RejectedOnesAreOnTheLeftAlone) {
  const std::vector<Attempt> attempts = {
      {{2, 2}, {7, 2}, true}, {{2, 7}, {7, 7}, false}, {{5, 5}, {90, 5}, false}};
  const std::vector<glm::ivec2> occupied = {{2, 2}};
  const Image image = drawAttempts(attempts, occupied, {{10, 10}, 200});
  const int margin = 200 / 24, right = margin + 200 + margin;
  const auto at = [&](int left, double x, double y) {
    return image.at(left + static_cast<int>((x + 0.5) * 20), margin + 200 - static_cast<int>((y + 0.5) * 20));
  };
  EXPECT_LT(at(margin, 5, 2)[0], 0.4f);
  EXPECT_LT(at(right, 5, 2)[0], 0.4f);
  EXPECT_LT(at(margin, 5, 7)[2], at(margin, 5, 7)[0]) << "rejected: reddish";
  EXPECT_GT(at(right, 5, 7)[2], 0.95f) << "and not on the right";
  EXPECT_LT(at(margin, 2, 2.3)[0], 0.8f) << "the voxel that was taken is shaded";
  for (int y = 0; y < image.height; ++y) {
    for (int x = margin + 203; x < right - 3; ++x) {
      ASSERT_FLOAT_EQ(image.at(x, y)[0], image.at(1, 1)[0]) << "nothing sticks out";
    }
  }
}

/// The share of a pixel that a segment at least a pixel wide covers, asked of every pixel.
float plainCoverage(glm::vec2 p, glm::vec2 a, glm::vec2 b, float width_px) {
  const glm::vec2 along = b - a;
  const float length2 = glm::dot(along, along);
  const float t = length2 > 0.0f ? std::clamp(glm::dot(p - a, along) / length2, 0.0f, 1.0f) : 0.0f;
  return std::clamp(0.5f * width_px + 0.5f - glm::length(p - a - t * along), 0.0f, 1.0f);
}

TEST(Drawing, ASegmentTouchesThePixelsNearItAndNoOthers) {
  std::mt19937 random(3);
  const auto anywhere = [&] { return static_cast<float>(random() % 2400) / 20.0f - 20.0f; };
  for (int round = 0; round < 60; ++round) {
    glm::vec2 a(anywhere(), anywhere()), b(anywhere(), anywhere());
    if (round % 6 == 0) b.y = a.y;
    if (round % 6 == 1) b.x = a.x;
    if (round % 12 == 2) b = a;
    const float width_px = 1.0f + static_cast<float>(round % 5);
    render::Image image(80, 70, 3);
    render::drawSegment(image, a, b, width_px, {sim::Colour(1.0f), 1.0f});
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const glm::vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        ASSERT_NEAR(image.at(x, y)[0], plainCoverage(p, a, b, width_px), 1e-5f)
            << round << ": " << x << " " << y;
      }
    }
  }
}

TEST(Drawing, ConvexPolygonsCoverTheirAreaWithoutSeams) {
  const std::vector<glm::vec2> square{{4.5f, 3.25f}, {24.5f, 3.25f}, {24.5f, 13.25f}, {4.5f, 13.25f}};
  Image image(40, 30, 3, 1.0f);
  fillConvex(image, square, {sim::Colour(0.0f), 0.5f});
  EXPECT_NEAR(covered(image), 0.5 * 20.0 * 10.0, 1.5);
  for (int x = 6; x < 23; ++x) EXPECT_FLOAT_EQ(image.at(x, 5 + x % 7)[0], 0.5f) << "no seam inside";
  const std::vector<glm::vec2> wound(square.rbegin(), square.rend());
  Image other(40, 30, 3, 1.0f);
  fillConvex(other, wound, {sim::Colour(0.0f), 0.5f});
  EXPECT_NEAR(covered(other), covered(image), 1e-3) << "either way around";
  const Image before = image;
  fillConvex(image, std::vector<glm::vec2>{{1, 1}, {20, 20}}, kBlack);
  fillConvex(image, std::vector<glm::vec2>{}, kBlack);
  EXPECT_EQ(image.pixels, before.pixels);
}

}  // namespace
}  // namespace espalier::render
