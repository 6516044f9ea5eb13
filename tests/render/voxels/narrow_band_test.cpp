#include "render/voxels/narrow_band.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/golden.h"
#include "tests/support/meshes.h"

namespace espalier::render {
namespace {

using sim::Vec3;

const sim::Frame kFrame{Vec3(-1.5), 0.1, {31, 31, 31}};

TEST(NarrowBand, HoldsTheSignedDistanceInVoxelsNearTheSurfaceAlone) {
  const sim::Mesh sphere = tests::sphereMesh(Vec3(0.0), 0.9, 40);
  for (const auto& [axis, across, up] : {std::array{0, 2, 1}, std::array{1, 0, 2}, std::array{2, 0, 1}}) {
    const BandCut cut = bandCut(sphere, kFrame, {axis, across, up, 13});
    EXPECT_TRUE(cut.has_inside);
    ASSERT_EQ(cut.size, glm::ivec2(31, 31));
    std::size_t in_band = 0, i = 0;
    for (int y = 0; y < 31; ++y) {
      for (int x = 0; x < 31; ++x, ++i) {
        const double distance = std::sqrt((x - 15.0) * (x - 15.0) + (y - 15.0) * (y - 15.0) + 4.0) - 9.0;
        if (std::isnan(cut.distance_vx[i])) {
          EXPECT_GT(std::abs(distance), kBand - 0.1);
        } else {
          EXPECT_NEAR(cut.distance_vx[i], distance, 0.06);
          ++in_band;
        }
      }
    }
    EXPECT_GT(in_band, 280u);
    for (const auto& segment : cut.outline) {
      for (const glm::vec2 end : segment)
        EXPECT_NEAR(glm::length(end - glm::vec2(15.0f)), std::sqrt(81.0f - 4.0f), 0.06f);
    }
    EXPECT_GT(cut.outline.size(), 60u);
  }
}

TEST(NarrowBand, OfASheetHasNoInside) {
  sim::Mesh sheet = tests::emptyMesh("sheet");
  sheet.vertices_m = {{-1, 0.02, -1}, {1, 0.02, -1}, {1, 0.02, 1}, {-1, 0.02, 1}};
  tests::addTriangle(sheet, 0, 2, 1);
  tests::addTriangle(sheet, 0, 3, 2);
  const BandCut cut = bandCut(sheet, kFrame, {2, 0, 1, 15});
  EXPECT_FALSE(cut.has_inside);
  EXPECT_NEAR(cut.distance_vx[16 * 31 + 15], 0.8, 1e-3);
  EXPECT_NEAR(cut.distance_vx[14 * 31 + 15], 1.2, 1e-3);
}

TEST(NarrowBand, TakesMemoryByItsSurface) {
  const double one = bandBytes(tests::sphereMesh(Vec3(0.0), 0.5, 40), kFrame);
  EXPECT_NEAR(bandBytes(tests::sphereMesh(Vec3(0.0), 1.0, 40), kFrame) / one, 4.0, 1e-6);
  const double voxels = 4.0 * 3.14159 * 25.0 * 2 * kBand;
  EXPECT_GT(one, 4.0 * voxels);
}

TEST(Golden, NarrowBandOfTwoBodies) {
  const sim::Mesh mesh = tests::together(tests::sphereMesh({-0.3, 0.45, 0}, 0.75, 24),
                                         tests::boxMesh({0.75, -0.85, -0.5}, {1.15, 0.6, 0.5}));
  const BandCut cut = bandCut(mesh, kFrame, {2, 0, 1, 15});
  tests::expectLikeGolden(drawNarrowBand(cut, {240, "narrow band", "signed distance"}), "narrow_band");
}

}  // namespace
}  // namespace espalier::render
