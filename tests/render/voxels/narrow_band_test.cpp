#include "render/voxels/narrow_band.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/golden.h"
#include "tests/support/meshes.h"
#include "tests/support/messages.h"

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
          EXPECT_GT(std::abs(distance), kBand - 0.12);
        } else {
          EXPECT_NEAR(cut.distance_vx[i], distance, 0.11);
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

TEST(NarrowBand, OfABodyWithHolesHasAnInside) {
  const sim::Mesh whole = tests::sphereMesh(Vec3(0.0), 0.9, 40);
  const sim::Mesh open = tests::without(whole, [](Vec3 p) { return p.y > 0.85; });
  ASSERT_LT(open.triangles.size(), whole.triangles.size());
  const CutPlane plane{2, 0, 1, 15};
  const BandCut expected = bandCut(whole, kFrame, plane), cut = bandCut(open, kFrame, plane);
  std::size_t other = 0;
  for (std::size_t i = 0; i < 20 * 31; ++i)  // below the hole
    other += std::isnan(cut.distance_vx[i])
                 ? !std::isnan(expected.distance_vx[i])
                 : !(std::abs(cut.distance_vx[i] - expected.distance_vx[i]) < 0.1f);
  EXPECT_EQ(other, 0u);
}

TEST(NarrowBand, OfAMeshThatReachesTooFarIsRefused) {
  const std::string message = tests::messageOf([] {
    bandCut(tests::boxMesh(Vec3(-1.0), Vec3(2000.0), "hall"), kFrame, {1, 0, 2, 15});
  });
  EXPECT_EQ(message.find("mesh 'hall': too large to know its inside, it reaches 16000 voxels"), 0u)
      << message;
}

TEST(NarrowBand, TakesMemoryByTheSurfaceNearItsPlane) {
  const sim::Mesh box = tests::boxMesh(Vec3(-1.0), Vec3(1.0));
  const double side = 20.0 * 20.0;  // voxels
  const double through = bandBytes(box, kFrame, {1, 0, 2, 15}), below = bandBytes(box, kFrame, {1, 0, 2, 4});
  EXPECT_NEAR(below / through, 5.0 / 4.0, 1e-6);  // its bottom too
  EXPECT_GT(through, 4.0 * 4 * side * 2 * kBand);
  EXPECT_EQ(bandBytes(box, kFrame, {1, 0, 2, 0}), 0.0);
}

TEST(Golden, NarrowBandOfTwoBodies) {
  const sim::Mesh mesh = tests::together(tests::sphereMesh({-0.3, 0.45, 0}, 0.75, 24),
                                         tests::boxMesh({0.75, -0.85, -0.5}, {1.15, 0.6, 0.5}));
  const BandCut cut = bandCut(mesh, kFrame, {2, 0, 1, 15});
  tests::expectLikeGolden(drawNarrowBand(cut, {240, "narrow band", "signed distance"}), "narrow_band");
}

}  // namespace
}  // namespace espalier::render
