#include "render/model/drawn_leaf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/image/oiio.h"
#include "sim/base/error.h"
#include "sim/base/srgb.h"
#include "tests/support/messages.h"

namespace espalier::render {
namespace {

const sim::Colour kGreen(0.06f, 0.20f, 0.03f);

class DrawnLeaf : public testing::TestWithParam<std::string> {
 protected:
  LeafPicture leaf_ = *drawnLeaf(GetParam(), kGreen);

  bool opaque(int x, int y) const {
    return leaf_.texels[static_cast<std::size_t>(y * leaf_.width + x)][3] >= 128;
  }
};

double distanceToEdge(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
  return glm::distance(p, a + t * (b - a));
}

/// Whether a point lies in one of the polygons seen along z (or along x, for one that faces x), or at most
/// `near` outside.
bool inCards(const Cards& cards, double across, double up, double near) {
  const glm::dvec2 p(across, up);
  return std::any_of(cards.begin(), cards.end(), [&](const auto& card) {
    const bool faces_x = std::all_of(card.begin(), card.end(), [](sim::Vec3 c) { return c.x == 0.0; });
    bool inside = false;
    for (std::size_t i = 0; i < card.size(); ++i) {
      const auto flat = [&](sim::Vec3 c) { return glm::dvec2(faces_x ? c.z : c.x, c.y); };
      const glm::dvec2 a = flat(card[i]), b = flat(card[(i + 1) % card.size()]);
      if (distanceToEdge(p, a, b) <= near) return true;
      const bool crosses = (a.y > up) != (b.y > up) && across < a.x + (up - a.y) / (b.y - a.y) * (b.x - a.x);
      inside = inside != crosses;
    }
    return inside;
  });
}

TEST_P(DrawnLeaf, IsCutOutAndKeepsWithinItsCards) {
  const Cards cards = cardsOf(GetParam());
  ASSERT_FALSE(cards.empty());
  double low = 0.0, high = 0.0, foot = 0.0, top = 0.0;
  for (const auto& card : cards) {
    for (const sim::Vec3 c : card) {
      low = std::min(low, c.x);
      high = std::max(high, c.x);
      foot = std::min(foot, c.y);
      top = std::max(top, c.y);
    }
  }
  EXPECT_EQ(top - foot, 1.0);
  // The picture is stretched over the cards' extent: leaves must not be distorted by it.
  EXPECT_NEAR(static_cast<double>(leaf_.width) / leaf_.height, high - low, 0.02);
  int covered = 0, cut = 0;
  for (int y = 0; y < leaf_.height; ++y) {
    for (int x = 0; x < leaf_.width; ++x) {
      if (!opaque(x, y)) continue;
      ++covered;
      const double across = low + (high - low) * (x + 0.5) / leaf_.width, up = top - (y + 0.5) / leaf_.height;
      cut += inCards(cards, across, up, 0.01) ? 0 : 1;
    }
  }
  const double share = static_cast<double>(covered) / (leaf_.width * leaf_.height);
  EXPECT_GT(share, 0.2);
  EXPECT_LT(share, 0.85);
  EXPECT_NEAR(bladeShareOf(GetParam()), share, 0.01);
  EXPECT_EQ(bladeShareOf(leaf_), share);
  EXPECT_LT(cut, covered / 200) << "of " << covered;
  // It begins where it is attached, in the middle, and reaches the top.
  const int attached = std::min(static_cast<int>(top * leaf_.height), leaf_.height - 14);
  bool at_the_foot = false, at_the_top = false;
  for (int y = 0; y < 14; ++y) {
    for (int x = leaf_.width / 2 - 12; x <= leaf_.width / 2 + 12; ++x) {
      at_the_foot = at_the_foot || opaque(x, attached + y);
      at_the_top = at_the_top || opaque(x, y);
    }
  }
  EXPECT_TRUE(at_the_foot);
  EXPECT_TRUE(at_the_top);
}

TEST_P(DrawnLeaf, HasItsColourAndIsDrawnOnce) {
  EXPECT_EQ(drawnLeaf(GetParam(), kGreen), drawnLeaf(GetParam(), kGreen));
  const sim::Colour red(0.4f, 0.02f, 0.02f);
  EXPECT_NE(drawnLeaf(GetParam(), kGreen), drawnLeaf(GetParam(), red));
  const auto mean = [](const LeafPicture& picture) {
    sim::Vec3 sum(0.0);
    double count = 0.0;
    for (const auto& texel : picture.texels) {
      if (texel[3] < 128) continue;
      sum += sim::Vec3(sim::linearFromSrgb(sim::Colour(texel[0], texel[1], texel[2]) / 255.0f));
      count += 1.0;
    }
    return sum / count;
  };
  const sim::Vec3 green = mean(leaf_);
  EXPECT_NEAR(green.g / kGreen.g, 1.0, 0.35);
  EXPECT_GT(green.g, 2.0 * green.b);
  EXPECT_GT(mean(*drawnLeaf(GetParam(), red)).r, 4.0 * mean(*drawnLeaf(GetParam(), red)).g);
}

TEST_P(DrawnLeaf, ItsFileHoldsWhatItShows) {
  const Texels read = oiio().read_png(leaf_.png, 1 << 20, 1 << 10);
  EXPECT_EQ(read.width, leaf_.width);
  EXPECT_EQ(read.height, leaf_.height);
  EXPECT_EQ(read.rgba, leaf_.texels);
}

INSTANTIATE_TEST_SUITE_P(Kind, DrawnLeaf, testing::ValuesIn(drawnKinds()),
                         [](const auto& kind) { return kind.param; });

TEST(DrawnLeaves, OthersAreRefusedByName) {
  const std::string said = tests::messageOf([] { drawnLeaf("oak", kGreen); });
  EXPECT_EQ(said,
            "'oak' is no leaf that is drawn; expected one of ovate, ivy, palmate, needles, branch, blossom");
}

TEST(DrawnLeaves, CardsOfAPictureHaveItsShape) {
  const Cards cards = cardsOf(300, 200);
  double low = 0.0, high = 0.0;
  for (const auto& card : cards) {
    for (const sim::Vec3 c : card) {
      low = std::min(low, c.x);
      high = std::max(high, c.x);
    }
  }
  EXPECT_NEAR(high - low, 1.5, 1e-6);
}

}  // namespace
}  // namespace espalier::render
