#include "sim/scatter/picture_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/parallel.h"
#include "tests/support/messages.h"

namespace espalier::sim {
namespace {

constexpr std::uint64_t kPictureStream = 7;
const PictureFrame kInPlan{{-4, 1, -3}, {8, 0, 0}, {0, 0, 6}};

template <class Of>
DensityPicture drawn(int width, int height, Of of) {
  DensityPicture picture{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) picture.density.push_back(static_cast<float>(of(x, y)));
  }
  return picture;
}

/// How many points lie in each pixel.
std::vector<double> countsOf(const DensityPicture& picture, const PictureFrame& frame,
                             const PointSet& points) {
  std::vector<double> counts(picture.density.size(), 0.0);
  for (const Vec3& p : points.at) {
    const Vec3 off = p - frame.top_left;
    const auto share = [&](Vec3 side, int pixels) {
      return std::clamp(static_cast<int>(glm::dot(off, side) / glm::dot(side, side) * pixels), 0, pixels - 1);
    };
    const int x = share(frame.across, picture.width), y = share(frame.down, picture.height);
    ++counts[static_cast<std::size_t>(y * picture.width + x)];
  }
  return counts;
}

/// Pearson's statistic against the picture, in standard deviations above its mean.
double offBy(const DensityPicture& picture, const PictureFrame& frame, const PointSet& points) {
  const std::vector<double> counts = countsOf(picture, frame, points);
  double total = 0.0, statistic = 0.0, cells = 0.0;
  for (const float d : picture.density) total += static_cast<double>(d);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected =
        static_cast<double>(points.at.size()) * static_cast<double>(picture.density[i]) / total;
    if (expected == 0.0) {
      EXPECT_EQ(counts[i], 0.0) << "in black";
      continue;
    }
    statistic += (counts[i] - expected) * (counts[i] - expected) / expected;
    ++cells;
  }
  return (statistic - (cells - 1.0)) / std::sqrt(2.0 * (cells - 1.0));
}

TEST(PicturePoints, AreAsManyAsAPixelIsBright) {
  const auto gradient = drawn(32, 20, [](int x, int) { return x / 31.0; });
  const auto board = drawn(8, 6, [](int x, int y) { return (x + y) % 2 ? 1.0 : 0.0; });
  const auto lone = drawn(3, 700, [](int x, int y) { return x == 1 && y % 7 == 3 ? 0.3 : 0.0; });
  const auto steep = drawn(16, 16, [](int x, int y) { return std::exp(-0.5 * (x + y)); });
  for (const DensityPicture* picture : {&gradient, &board, &lone, &steep}) {
    SCOPED_TRACE(testing::Message() << picture->width << " x " << picture->height);
    for (const std::uint64_t stream : {1u, 2u, 3u}) {
      const PointSet points = scatterOver(*picture, kInPlan, 30'000, stream);
      EXPECT_LT(std::abs(offBy(*picture, kInPlan, points)), 4.0);
    }
  }
  // The measure tells another curve from this one.
  const auto squared = drawn(32, 20, [](int x, int) { return std::pow(x / 31.0, 2.2); });
  EXPECT_GT(offBy(gradient, kInPlan, scatterOver(squared, kInPlan, 60'000, 1)), 50.0);
}

TEST(PicturePoints, LieInTheirPlaneAndAlikeInAPixel) {
  const PictureFrame wall{{1, 5, 2}, {4, 0, 0}, {0, -3, 0}};
  const auto one = drawn(1, 1, [](int, int) { return 0.2; });
  const PointSet points = scatterOver(one, wall, 40'000, kPictureStream);
  const auto fine = drawn(10, 10, [](int, int) { return 1.0; });
  EXPECT_LT(std::abs(offBy(fine, wall, points)), 4.0);
  for (std::size_t i = 0; i < points.at.size(); ++i) {
    EXPECT_EQ(points.at[i].z, 2.0);
    EXPECT_EQ(points.normal[i], Vec3(0, 0, 1)) << "towards who sees it upright";
  }
  EXPECT_EQ(scatterOver(one, kInPlan, 1, 1).normal[0], Vec3(0, 1, 0));
}

TEST(PicturePoints, FollowFromTheirNumbersOnAnyThreads) {
  const auto gradient = drawn(40, 30, [](int x, int y) { return (x + 2.0 * y) / 100.0; });
  const PointSet all = scatterOver(gradient, kInPlan, 50'000, kPictureStream);
  const PointSet few = scatterOver(gradient, kInPlan, 70, kPictureStream);
  EXPECT_TRUE(std::equal(few.at.begin(), few.at.end(), all.at.begin()));
  for (const int threads : {1, 2, 5}) {
    onThreads(threads, [&] {
      EXPECT_EQ(scatterOver(gradient, kInPlan, 50'000, kPictureStream).at, all.at) << threads;
      EXPECT_EQ(scatterOverApart(gradient, kInPlan, 9000, 0.1, kPictureStream).at,
                scatterOverApart(gradient, kInPlan, 9000, 0.1, kPictureStream).at);
    });
  }
  EXPECT_NE(scatterOver(gradient, kInPlan, 70, 8).at, few.at);
  const PointSet apart = scatterOverApart(gradient, kInPlan, 9000, 0.15, kPictureStream),
                 fewer = scatterOverApart(gradient, kInPlan, 40, 0.15, kPictureStream);
  ASSERT_EQ(fewer.at.size(), 40u);
  EXPECT_TRUE(std::equal(fewer.at.begin(), fewer.at.end(), apart.at.begin()));
}

TEST(PicturePoints, KeepApartTheMoreTheDarker) {
  // Stripes of 1, 1/4, 1/16 and black.
  const auto stripes = drawn(4, 1, [](int x, int) { return x == 3 ? 0.0 : std::pow(0.25, x); });
  const double spacing = 0.06;
  const PointSet points = scatterOverApart(stripes, kInPlan, 1'000'000, spacing, kPictureStream);
  std::vector<double> counts = countsOf(stripes, kInPlan, points);
  EXPECT_EQ(counts[3], 0.0);
  EXPECT_NEAR(counts[0] / counts[1], 4.0, 0.5);
  EXPECT_NEAR(counts[1] / counts[2], 4.0, 0.8);
  EXPECT_GT(counts[0] * spacing * spacing / 12.0, 0.6);  // where no more find room it is about 0.7
  const auto spacingAt = [&](Vec3 p) { return spacing * std::exp2(std::floor((p.x + 4.0) / 2.0)); };
  for (std::size_t i = 0; i < points.at.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      ASSERT_GE(glm::distance(points.at[i], points.at[k]),
                std::min(spacingAt(points.at[i]), spacingAt(points.at[k])));
    }
  }
}

TEST(PicturePoints, ComeInWavesFromSparseToDense) {
  const auto gradient = drawn(20, 1, [](int x, int) { return (x + 1) / 20.0; });
  const PointSet points = scatterOverApart(gradient, kInPlan, 100'000, 0.1, kPictureStream, 3);
  ASSERT_EQ(points.wave.size(), points.at.size());
  EXPECT_TRUE(std::is_sorted(points.wave.begin(), points.wave.end()));
  for (int wave = 0; wave < 3; ++wave) {
    double least = INFINITY;
    for (std::size_t i = 0; i < points.at.size() && points.wave[i] <= wave; ++i) {
      for (std::size_t k = 0; k < i; ++k) least = std::min(least, glm::distance(points.at[i], points.at[k]));
    }
    EXPECT_GE(least, 0.1 * std::exp2(2 - wave));
    EXPECT_LT(least, 0.13 * std::exp2(2 - wave));
  }
}

TEST(PicturePoints, RefuseWhatIsNoPicture) {
  const auto white = drawn(2, 2, [](int, int) { return 1.0; });
  const auto said = [&](const DensityPicture& picture, const PictureFrame& frame, std::size_t count = 9) {
    return tests::messageOf([&] { scatterOver(picture, frame, count, 1); });
  };
  EXPECT_NE(said(drawn(2, 2, [](int, int) { return 0.0; }), kInPlan).find("black everywhere"),
            std::string::npos);
  EXPECT_NE(said(drawn(2, 2, [](int, int) { return 2.0; }), kInPlan).find("beyond 0 to 1"),
            std::string::npos);
  EXPECT_NE(said(drawn(2, 2, [](int, int) { return NAN; }), kInPlan).find("beyond 0 to 1"),
            std::string::npos);
  EXPECT_NE(said({2, 3, white.density}, kInPlan).find("2 x 3"), std::string::npos);
  EXPECT_NE(said(white, {{0, 0, 0}, {1, 0, 0}, {-2, 0, 0}}).find("no area"), std::string::npos);
  EXPECT_NE(said(white, kInPlan, 0).find("0 points"), std::string::npos);
  EXPECT_NE(tests::messageOf([&] { scatterOverApart(white, kInPlan, 9, 0.0, 1); }).find("0 apart"),
            std::string::npos);
}

}  // namespace
}  // namespace espalier::sim
