#include "sim/scatter/envelope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sim/base/parallel.h"
#include "tests/support/messages.h"

namespace espalier::sim {
namespace {

constexpr std::uint64_t kEnvelopeStream = 4711;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

const Revolution kCypress{{{{0, 1}, {2, 4.5}, {7, 0.5}, {12, 1}}}};
const Revolution kOnion{{{{-1, 0}, {-1, 9}, {2, 0}, {6, 0}}}};

std::vector<Envelope> allKinds() {
  return {{Cone{10, 5}, {1, 2, 3}},  {Dome{6}, {0, 2, 0}},   {Cylinder{3, 2}, {0, 0, 0}},
          {Sphere{2.5}, {-4, 0, 1}}, {Ellipsoid{{3, 1, 2}}}, {Box{{1, 2, 5}}, {7, 7, 7}},
          {kCypress, {0, 2, 0}},     {kOnion, {0, 1, 0}}};
}

/// Mean height above the foot, its variance, and the mean squares of x and z.
struct Moments {
  double height = 0.0, variance = 0.0, xx = 0.0, zz = 0.0;
};

Moments momentsOf(const PointSet& points, Vec3 foot) {
  Moments m;
  const double share = 1.0 / static_cast<double>(points.at.size());
  for (const Vec3& p : points.at) m.height += share * (p.y - foot.y);
  for (const Vec3& p : points.at) {
    const Vec3 q = p - foot;
    m.variance += share * (q.y - m.height) * (q.y - m.height);
    m.xx += share * q.x * q.x;
    m.zz += share * q.z * q.z;
  }
  return m;
}

void expectMoments(const Envelope& envelope, const Strewing& strewing, const Moments& expected) {
  const Moments is = momentsOf(scatterInside(envelope, strewing, kEnvelopeStream), envelope.foot);
  const double error = 4.0 / std::sqrt(static_cast<double>(strewing.count));
  EXPECT_NEAR(is.height, expected.height, error * std::sqrt(expected.variance));
  EXPECT_NEAR(is.variance, expected.variance, 2.0 * error * expected.variance);
  EXPECT_NEAR(is.xx, expected.xx, 2.0 * error * expected.xx);
  EXPECT_NEAR(is.zz, expected.zz, 2.0 * error * expected.zz);
}

/// By integrals over the curve's parameter, in a million steps.
Moments momentsOf(const Revolution& r) {
  const auto curve = [](const double(&c)[4], double t) {
    const double u = 1 - t;
    return u * u * u * c[0] + 3 * u * u * t * c[1] + 3 * u * t * t * c[2] + t * t * t * c[3];
  };
  double heights[4], radii[4], volume = 0, first = 0, second = 0, across = 0;
  for (std::size_t i = 0; i < 4; ++i) heights[i] = r.profile[i].x, radii[i] = r.profile[i].y;
  constexpr int kSteps = 1'000'000;
  for (int i = 0; i < kSteps; ++i) {
    const double y = curve(heights, (i + 0.5) / kSteps), radius = curve(radii, (i + 0.5) / kSteps);
    const double slab = std::numbers::pi * radius * radius *
                        (curve(heights, (i + 1.0) / kSteps) - curve(heights, 1.0 * i / kSteps));
    volume += slab;
    first += slab * y;
    second += slab * y * y;
    across += slab * radius * radius / 4;
  }
  const double mean = first / volume;
  return {mean, second / volume - mean * mean, across / volume, across / volume};
}

TEST(Envelope, PointsAreEvenByVolume) {
  const Strewing many{200'000, Spread::volume, {}};
  expectMoments({Cone{10, 5}, {1, 2, 3}}, many, {2.5, 3.75, 3.75, 3.75});
  expectMoments({Cylinder{3, 2}}, many, {1.5, 0.75, 1, 1});
  expectMoments({Sphere{5}, {1, 1, 1}}, many, {5, 5, 5, 5});
  expectMoments({Ellipsoid{{3, 1, 2}}}, many, {1, 0.2, 1.8, 0.8});
  expectMoments({Box{{6, 12, 3}}, {4, 4, 4}}, many, {6, 12, 3, 0.75});
  expectMoments({kCypress, {0, 2, 0}}, many, momentsOf(kCypress));
  expectMoments({kOnion}, many, momentsOf(kOnion));
  expectMoments({Dome{6}}, many, momentsOf(Revolution{{{{0, 6}, {2, 6}, {4, 3}, {6, 1}}}}));
}

/// The chi-square of counts in sub-boxes against their shares of the volume, in standard deviations above
/// its mean.
double chiSquare(const Envelope& envelope, const PointSet& points) {
  constexpr int kBoxes = 6, kFine = 12;
  const EnvelopeBounds bounds = boundsOf(envelope);
  const Vec3 side = (bounds.high - bounds.low) / static_cast<double>(kBoxes);
  std::vector<double> counts(kBoxes * kBoxes * kBoxes), shares(counts.size());
  double all = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const auto box = static_cast<int>(i);
    const Vec3 low = bounds.low + side * Vec3(box % kBoxes, box / kBoxes % kBoxes, box / kBoxes / kBoxes);
    for (int n = 0; n < kFine * kFine * kFine; ++n) {
      const Vec3 part(n % kFine + 0.5, n / kFine % kFine + 0.5, n / kFine / kFine + 0.5);
      shares[i] += contains(envelope, low + side * part / static_cast<double>(kFine)) ? 1 : 0;
    }
    all += shares[i];
  }
  for (const Vec3& p : points.at) {
    const glm::ivec3 box = glm::clamp(glm::ivec3((p - bounds.low) / side), 0, kBoxes - 1);
    ++counts[static_cast<std::size_t>(box.x + kBoxes * (box.y + kBoxes * box.z))];
  }
  double sum = 0, freedom = -1;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = shares[i] / all * static_cast<double>(points.at.size());
    if (expected < 8) continue;
    sum += (counts[i] - expected) * (counts[i] - expected) / expected;
    ++freedom;
  }
  return (sum - freedom) / std::sqrt(2 * freedom);
}

TEST(Envelope, EverySubBoxHasItsShare) {
  for (const Envelope& envelope : allKinds()) {
    const double off =
        chiSquare(envelope, scatterInside(envelope, {40'000, Spread::volume, {}}, kEnvelopeStream));
    EXPECT_LT(off, 4.0) << envelope.solid.index();
    EXPECT_GT(off, -4.0) << envelope.solid.index();
  }
  const Envelope cone{Cone{10, 5}};  // the measure sees what is uneven
  EXPECT_GT(chiSquare(cone, scatterInside(cone, {40'000, Spread::height, {}}, kEnvelopeStream)), 100.0);
}

TEST(Envelope, PointsLieInsideAndWithinItsBounds) {
  for (const Envelope& envelope : allKinds()) {
    const EnvelopeBounds bounds = boundsOf(envelope);
    Vec3 low(INFINITY), high(-INFINITY);
    for (const Vec3& p : scatterInside(envelope, {20'000, Spread::volume, {}}, kEnvelopeStream).at) {
      ASSERT_TRUE(contains(envelope, p)) << envelope.solid.index();
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const double slack = 0.12 * (bounds.high[axis] - bounds.low[axis]);
      EXPECT_GE(low[axis], bounds.low[axis]);
      EXPECT_LE(high[axis], bounds.high[axis]);
      EXPECT_LT(low[axis], bounds.low[axis] + slack) << envelope.solid.index();
      const bool slender = axis == 1 && envelope.solid.index() == 6;  // few points come to its tip
      EXPECT_TRUE(slender || high[axis] > bounds.high[axis] - 2.2 * slack) << axis;
    }
    EXPECT_FALSE(contains(envelope, bounds.low - 1e-6));
    EXPECT_FALSE(contains(envelope, Vec3(kNaN, envelope.foot.y + 0.1, 0)));
  }
}

TEST(Envelope, Volumes) {
  EXPECT_DOUBLE_EQ(volumeOf({Box{{1, 2, 5}}}), 10.0);
  EXPECT_DOUBLE_EQ(volumeOf({Cylinder{3, 2}}), 12 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(volumeOf({Cone{3, 2}}), 4 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(volumeOf({Sphere{3}}), 36 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(volumeOf({Ellipsoid{{3, 1, 2}}}), 8 * std::numbers::pi);
  // A straight profile is a cone.
  EXPECT_NEAR(volumeOf({Revolution{{{{0, 2}, {1, 4.0 / 3}, {2, 2.0 / 3}, {3, 0}}}}}), 4 * std::numbers::pi,
              1e-9);
}

TEST(Envelope, ByHeightEveryLayerHasAsMany) {
  const auto points = scatterInside({Cone{8, 3}}, {80'000, Spread::height, {}}, kEnvelopeStream);
  int layers[8] = {};
  for (const Vec3& p : points.at) ++layers[static_cast<int>(p.y)];
  for (const int count : layers) EXPECT_NEAR(count, 10'000, 4 * 100);
}

TEST(Envelope, DensityAlongTheHeight) {
  const std::vector<DensityAt> rising{{0, 0}, {1, 1}};
  expectMoments({Cylinder{3, 2}}, {100'000, Spread::volume, rising}, {2, 0.5, 1, 1});
  expectMoments({Cylinder{3, 2}}, {100'000, Spread::height, rising}, {2, 0.5, 1, 1});
  // A layer thinner than a piece.
  const std::vector<DensityAt> thin{{0.5, 0}, {0.50001, 7}, {0.50002, 0}};
  for (const Vec3& p : scatterInside({kCypress}, {1000, Spread::volume, thin}, kEnvelopeStream).at)
    EXPECT_NEAR(p.y, 6.0, 1e-3);
}

TEST(Envelope, MorePointsBeginWithTheSameOnes) {
  for (const Envelope& envelope : allKinds()) {
    const auto few = scatterInside(envelope, {100, Spread::volume, {}}, kEnvelopeStream);
    const auto many = scatterInside(envelope, {5000, Spread::volume, {}}, kEnvelopeStream);
    EXPECT_TRUE(std::equal(few.at.begin(), few.at.end(), many.at.begin()));
    EXPECT_NE(few.at, scatterInside(envelope, {100, Spread::volume, {}}, kEnvelopeStream + 1).at);
    EXPECT_EQ(few.normal, std::vector<Vec3>(100, Vec3(0)));
  }
}

TEST(Envelope, TheSamePointsOnAnyNumberOfThreads) {
  const Envelope dome{Dome{6}};
  const auto once = scatterInside(dome, {50'000, Spread::volume, {}}, kEnvelopeStream);
  for (const int threads : {1, 3, 8})
    onThreads(threads, [&] {
      EXPECT_EQ(scatterInside(dome, {50'000, Spread::volume, {}}, kEnvelopeStream).at, once.at);
    });
}

TEST(Envelope, ScalesToTheBit) {
  constexpr double k = 1024;
  const std::vector<std::pair<Envelope, Envelope>> pairs = {
      {{Cone{10, 5}, {1, 2, 3}}, {Cone{10 * k, 5 * k}, k * Vec3(1, 2, 3)}},
      {{Dome{0.7}, {0, 2, 0}}, {Dome{0.7 * k}, {0, 2 * k, 0}}},
      {{Sphere{2.3}, {-4, 0, 1}}, {Sphere{2.3 * k}, k * Vec3(-4, 0, 1)}},
      {{Box{{1, 2, 0.3}}}, {Box{k * Vec3(1, 2, 0.3)}}},
      {{kCypress}, {Revolution{{{{0, k}, {2 * k, 4.5 * k}, {7 * k, 0.5 * k}, {12 * k, k}}}}}}};
  for (const auto& [small, large] : pairs) {
    for (const Spread spread : {Spread::volume, Spread::height}) {
      const auto a = scatterInside(small, {3000, spread, {{0.2, 1}, {0.9, 3}}}, kEnvelopeStream);
      const auto b = scatterInside(large, {3000, spread, {{0.2, 1}, {0.9, 3}}}, kEnvelopeStream);
      for (std::size_t i = 0; i < a.at.size(); ++i) ASSERT_EQ(k * a.at[i], b.at[i]);
    }
  }
}

TEST(Envelope, RefusesWhatIsNoSolid) {
  const auto says = [](const Solid& solid, Vec3 foot = Vec3(0)) {
    return tests::messageOf([&] { scatterInside({solid, foot}, {10, Spread::volume, {}}, kEnvelopeStream); });
  };
  EXPECT_EQ(says(Cone{3, -1}), "an envelope with a radius of -1; expected a number above 0, or it is empty");
  EXPECT_EQ(says(Dome{kNaN}), "an envelope with a radius of nan; expected a number above 0, or it is empty");
  EXPECT_EQ(says(Cylinder{0, 1}),
            "an envelope with a height of 0; expected a number above 0, or it is empty");
  EXPECT_EQ(says(Sphere{INFINITY}),
            "an envelope with a radius of inf; expected a number above 0, or it is empty");
  EXPECT_EQ(says(Ellipsoid{{1, 0, 1}}),
            "an envelope with a radius of 0; expected a number above 0, or it is empty");
  EXPECT_EQ(says(Box{{1, 1, -2}}),
            "an envelope with a size of -2; expected a number above 0, or it is empty");
  EXPECT_EQ(says(Revolution{{{{0, 1}, {2, -4}, {7, 1}, {9, 1}}}}),
            "a profile with the point [2, -4]; expected numbers, and radii of 0 or more");
  EXPECT_EQ(says(Revolution{{{{0, 1}, {2, 1}, {1, 1}, {9, 1}}}}),
            "a profile with the height 1 after 2; expected heights that do not fall");
  EXPECT_EQ(says(Revolution{{{{3, 1}, {3, 1}, {3, 1}, {3, 1}}}}),
            "a profile without an inside; expected heights that rise and a radius above 0");
  EXPECT_EQ(says(Revolution{{{{0, 0}, {2, 0}, {3, 0}, {9, 0}}}}),
            "a profile without an inside; expected heights that rise and a radius above 0");
  EXPECT_EQ(says(Dome{1}, {0, kNaN, 0}), "an envelope whose foot is no place; expected three numbers");
}

TEST(Envelope, RefusesStrewingsThatHaveNoPoints) {
  const auto says = [](const Strewing& strewing) {
    return tests::messageOf([&] { scatterInside({Dome{1}}, strewing, kEnvelopeStream); });
  };
  EXPECT_EQ(says({0, Spread::volume, {}}), "0 points in an envelope; expected 1 to 2^32 - 1");
  EXPECT_EQ(says({1, Spread::volume, {{0, 0}, {1, 0}}}),
            "a density of 0 along the whole height; expected one above 0 somewhere");
  EXPECT_EQ(says({1, Spread::volume, {{0.5, 1}, {0.5, 2}}}),
            "a density with the share 0.5 after 0.5; expected shares that rise");
  EXPECT_EQ(says({1, Spread::volume, {{0, -1}}}),
            "a density of -1 at 0 of the height; expected a number of 0 or more at a share from 0 to 1");
  EXPECT_EQ(says({1, Spread::volume, {{1.5, 1}}}),
            "a density of 1 at 1.5 of the height; expected a number of 0 or more at a share from 0 to 1");
}

}  // namespace
}  // namespace espalier::sim
