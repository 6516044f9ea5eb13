#include "render/voxels/volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "render/voxels/visibility.h"
#include "sim/base/bricks.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/tile/occupancy.h"
#include "tests/support/meshes.h"
#include "tests/support/worlds.h"

namespace espalier::render {
namespace {

using sim::Vec3;
using sim::Voxel;

const sim::Colour kColour(0.2f, 0.5f, 0.1f);

/// Voxels of one colour, with what each stops.
struct Lump {
  explicit Lump(Voxel size) : occupied(size), full(size) {}
  void fill(Voxel low, Voxel high, bool whole) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int z = low.z; z <= high.z; ++z) {
        for (int x = low.x; x <= high.x; ++x) {
          occupied.set({x, y, z});
          if (whole) full.set({x, y, z});
        }
      }
    }
  }
  Volume volume(float share = 1.0f) const {
    return {tests::unitFrame(occupied.size()), occupied, full, [share](Voxel) {
              return VolumeVoxel{kColour, share};
            }};
  }
  sim::BitVolume occupied, full;
};

TEST(Volume, SolidsHideAndHaveTheirColourThroughout) {
  Lump lump(Voxel(40));
  lump.fill(Voxel(8), Voxel(31), true);
  const Volume volume = lump.volume();
  for (const Vec3 to : {Vec3(20, 20, 20), Vec3(9, 12, 30), Vec3(30.2, 8.4, 9.9)}) {
    const Vec3 from(-30, 50, -44);
    const Volume::Seen seen = volume.along(from, glm::normalize(to - from));
    EXPECT_EQ(seen.opacity, 1.0f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen.light[c], kColour[c], 1e-5);
  }
  EXPECT_EQ(volume.along({-30, 50, -44}, {-1, 0, 0}).opacity, 0.0f);
  EXPECT_EQ(volume.along({20, 36, -5}, {0, 0, 1}).opacity, 0.0f);
  EXPECT_GT(volume.bytes(), 0.0);
}

TEST(Volume, ASheetOfOneLayerHidesAlmostAll) {
  Lump lump(Voxel(24));
  lump.fill({0, 0, 11}, {23, 23, 11}, false);
  for (const double from : {0.0, 0.1, 0.37, 0.61}) {
    const Volume::Seen seen = lump.volume().along({12, 12, -7 - from}, {0, 0, 1});
    EXPECT_GE(seen.opacity, 0.97f);
    EXPECT_NEAR(seen.light.g / seen.opacity, kColour.g, 1e-5);  // nothing empty darkens it
  }
  // What stops a third of the rays is seen through.
  const float thin = lump.volume(shareOfThin(1.0f / 3.0f)).along({12, 12, -7}, {0, 0, 1}).opacity;
  EXPECT_GT(thin, 0.3f);
  EXPECT_LT(thin, 0.7f);
}

TEST(Volume, ThicknessAddsUpAsTransparencyMultiplies) {
  const auto opacity = [](int layers) {
    Lump lump(Voxel(24));
    lump.fill({0, 0, 8}, {23, 23, 7 + layers}, false);
    return lump.volume(0.2f).along({12, 12, -3.2}, {0, 0, 1}).opacity;
  };
  const double once = 1.0 - opacity(3), twice = 1.0 - opacity(6);
  EXPECT_NEAR((1.0 - opacity(9)) / twice, twice / once, 0.01);  // three layers more
  EXPECT_NEAR(twice / once, std::pow(1.0 - 0.2 * 0.2 * 0.2, 15.0), 0.01);
}

/// How far the edge of a shape strays from a straight line, in pixels: the pixels that rows see of it are
/// summed from the left.
double roughness(const std::vector<double>& edge) {
  const auto n = static_cast<double>(edge.size());
  double sy = 0, sx = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const auto x = static_cast<double>(i);
    sx += x, sy += edge[i], sxx += x * x, sxy += x * edge[i];
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), start = (sy - slope * sx) / n;
  double square = 0;
  for (std::size_t i = 0; i < edge.size(); ++i)
    square += std::pow(edge[i] - start - slope * static_cast<double>(i), 2);
  return std::sqrt(square / n);
}

TEST(Volume, EdgesAreFreeOfSteps) {
  // A long box that leans by some degrees; its upright edges run through the whole picture.
  const Voxel size(48, 96, 48);
  sim::Mesh box = tests::boxMesh({-10, -60, -10}, {10, 60, 10});
  const glm::dquat lean = glm::angleAxis(7.0 * std::numbers::pi / 180.0, Vec3(0, 0, 1));
  for (Vec3& p : box.vertices_m) p = lean * p + Vec3(24, 48, 24);
  const std::vector<sim::TiledMesh> meshes{{box, true}};
  const sim::World world = sim::buildWorld(tests::unitFrame(size), meshes, 0);
  const std::vector<double> thickness{0.1};
  const auto occupancy = sim::meshOccupancy(world, world.occupied(), meshes, thickness);
  sim::BitVolume full = world.occupied();
  full.remove(occupancy.where->bits());
  const Volume volume(world.frame(), world.occupied(), full, [&](Voxel v) {
    return VolumeVoxel{kColour, occupancy.where->has(v) ? occupancy.values[occupancy.index(v)].stops : 1.0f};
  });
  const Camera camera{{24, 48, 260}, {24, 48, 24}, 16};
  constexpr int kPixels = 240;  // along each side
  const Image image = marchThrough(volume, camera, kPixels, kPixels);
  const Visibility cubes =
      see(world.frame(), world.occupied(), sim::Bricks(world.occupied()), camera, kPixels, kPixels);
  std::vector<double> smooth, steps;
  for (int y = 0; y < kPixels; ++y) {
    double of_volume = 0.0, of_cubes = 0.0;
    for (int x = 0; x < kPixels / 2; ++x) {
      of_volume += static_cast<double>(image.at(x, y)[3]);
      double all = 0.0, seen = 0.0;
      for (const Fragment& f : cubes.pixel(static_cast<std::size_t>(y * kPixels + x))) {
        all += f.samples;
        if (f.face != kSky) seen += f.samples;
      }
      of_cubes += seen / all;
    }
    smooth.push_back(of_volume);
    steps.push_back(of_cubes);
  }
  EXPECT_GT(roughness(steps), 0.5);
  EXPECT_LT(roughness(smooth), 0.35 * roughness(steps));
}

TEST(Volume, TheSameOnAnyNumberOfThreads) {
  Lump lump(Voxel(33));
  lump.fill({5, 9, 3}, {22, 20, 30}, true);
  lump.fill({3, 21, 3}, {29, 23, 29}, false);
  const Camera camera{{60, 44, 50}, {16, 16, 16}, 40};
  const auto draw = [&] { return marchThrough(lump.volume(0.4f), camera, 41, 33).pixels; };
  const std::vector<float> first = draw();
  for (const int threads : {1, 2, 5}) sim::onThreads(threads, [&] { EXPECT_EQ(draw(), first); });
}

TEST(Volume, EyesAmongVoxelsSeeNothingStrange) {
  Lump lump(Voxel(16));
  lump.fill(Voxel(0), Voxel(15), false);
  for (const Vec3 from : {Vec3(8.3, 7.2, 9.1), Vec3(-0.5), Vec3(15.5, 15.5, 3.0), Vec3(8, 8, 1e7)}) {
    for (const Vec3 way : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0, 1, 0), glm::normalize(Vec3(-1, 2, -3))}) {
      const Volume::Seen seen = lump.volume(0.5f).along(from, way);
      EXPECT_TRUE(seen.opacity >= 0.0f && seen.opacity <= 1.0f);
      EXPECT_TRUE(seen.light.g >= 0.0f && seen.light.g <= kColour.g + 1e-5f);
    }
  }
}

TEST(Volume, PicturesWithoutPixelsAreErrors) {
  const Lump lump(Voxel(4));
  EXPECT_THROW(marchThrough(lump.volume(), Camera(), 0, 10), sim::InputError);
  EXPECT_THROW(marchThrough(lump.volume(), Camera(), 10, -1), sim::InputError);
}

}  // namespace
}  // namespace espalier::render
