#include "render/voxels/visibility.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <map>
#include <tuple>

#include "sim/base/error.h"
#include "tests/support/little_garden.h"

namespace espalier::render {
namespace {

using sim::faceAxis;
using sim::kFaceNormals;

constexpr int kAcross = 200, kDown = 150;

struct Garden {
  explicit Garden(int scale = 1) : garden(scale), bricks(garden.occupied()) {}
  Visibility look(int width = kAcross, int height = kDown) const {
    return see(garden.frame(), garden.occupied(), bricks, tests::LittleGarden::camera(), width, height);
  }
  tests::LittleGarden garden;
  sim::Bricks bricks;
};

int samplesOf(std::span<const Fragment> pixel) {
  int samples = 0;
  for (const Fragment& f : pixel) samples += f.samples;
  return samples;
}

TEST(Visibility, APixelSeenWholeIsWhatItsMiddleRayHits) {
  const Garden scene(2);
  const Visibility seen = scene.look();
  const sim::Vec3 eye = sim::voxelFromWorld(scene.garden.frame(), seen.rays.eye_m());
  int whole = 0, sky = 0;
  for (int y = 0; y < kDown; ++y) {
    for (int x = 0; x < kAcross; ++x) {
      const auto pixel = seen.pixel(static_cast<std::size_t>(y * kAcross + x));
      if (samplesOf(pixel) != 1) continue;
      const sim::Vec3 direction = seen.rays.direction((x + 0.5) / kAcross, (y + 0.5) / kDown);
      const auto hit = sim::firstHit(scene.garden.occupied(), scene.bricks, eye, direction);
      ++whole;
      if (!hit) {
        ++sky;
        ASSERT_EQ(pixel[0].face, kSky);
        continue;
      }
      ASSERT_EQ(pixel[0].voxel, hit->voxel);
      ASSERT_EQ(kFaceNormals[pixel[0].face], hit->face);
      // The place on the face, put back into the world, is where the ray hit.
      sim::Vec3 place(hit->voxel);
      const int axis = faceAxis(pixel[0].face);
      place[axis] += 0.5 * hit->face[axis];
      place[(axis + 1) % 3] += static_cast<double>(pixel[0].at.x);
      place[(axis + 2) % 3] += static_cast<double>(pixel[0].at.y);
      ASSERT_LT(glm::distance(place, eye + hit->t * direction), 1e-4);
    }
  }
  EXPECT_GT(whole, 5000);
  EXPECT_GT(sky, 2000);
}

/// The share of each face in each divided pixel against 16 x 16 rays through it.
TEST(Visibility, DividedPixelsHoldTheSharesOfWhatTheyShow) {
  const Garden scene(2);
  const Visibility seen = scene.look();
  const sim::Vec3 eye = sim::voxelFromWorld(scene.garden.frame(), seen.rays.eye_m());
  double off = 0.0;
  int divided = 0;
  for (std::size_t i = 0; i < kAcross * kDown; i += 7) {
    const auto pixel = seen.pixel(i);
    if (samplesOf(pixel) == 1) continue;
    ASSERT_EQ(samplesOf(pixel), 8);
    std::map<std::tuple<int, int, int, int>, double> shares;
    for (int j = 0; j < 256; ++j) {
      const double x = static_cast<double>(i % kAcross) + (j % 16 + 0.5) / 16.0;
      const double y = static_cast<double>(i / kAcross) + (j / 16 + 0.5) / 16.0;
      const auto hit = sim::firstHit(scene.garden.occupied(), scene.bricks, eye,
                                     seen.rays.direction(x / kAcross, y / kDown));
      int face = kSky;
      for (int k = 0; hit && k < kSky; ++k)
        if (kFaceNormals[static_cast<std::size_t>(k)] == hit->face) face = k;
      const sim::Voxel v = hit ? hit->voxel : sim::Voxel(0);
      shares[{v.x, v.y, v.z, face}] += 1.0 / 256.0;
    }
    double wrong = 0.0;
    for (const Fragment& f : pixel) {
      double& share = shares[{f.voxel.x, f.voxel.y, f.voxel.z, f.face}];
      wrong += std::abs(share - f.samples / 8.0);
      share = 0.0;
    }
    for (const auto& [face, share] : shares) wrong += share;
    off += 0.5 * wrong;
    ++divided;
    ASSERT_LT(0.5 * wrong, 0.75) << "pixel " << i;
  }
  ASSERT_GT(divided, 500);
  EXPECT_LT(off / divided, 0.16) << "eight samples stand for 256";
}

TEST(Visibility, TheAreaOfACubesFaceIsRight) {
  const sim::Frame frame{sim::Vec3(0.0), 1.0, {3, 3, 3}};
  sim::BitVolume occupied(frame.size);
  occupied.set({1, 1, 1});
  const Camera camera{{1.0, 1.0, 11.5}, {1.0, 1.0, 1.0}, 20.0};  // ten widths in front of the face
  const Visibility seen = see(frame, occupied, sim::Bricks(occupied), camera, 127, 101);
  double covered = 0.0;
  for (std::size_t i = 0; i < 127 * 101; ++i) {
    const auto pixel = seen.pixel(i);
    for (const Fragment& f : pixel)
      if (f.face != kSky) covered += static_cast<double>(f.samples) / samplesOf(pixel);
  }
  const double side = 101.0 / (2.0 * 10.0 * std::tan(10.0 * std::numbers::pi / 180.0));
  // The face's edges run along the pixels' and eight samples place each within a sixteenth of a pixel.
  EXPECT_NEAR(covered, side * side, 4 * side / 16);
}

TEST(Visibility, DoesNotDependOnTheNumberOfThreads) {
  const Garden scene;
  const Visibility many = scene.look();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Visibility alone = scene.look();
  ASSERT_EQ(many.starts, alone.starts);
  for (std::size_t i = 0; i < many.fragments.size(); ++i) {
    const Fragment &a = many.fragments[i], &b = alone.fragments[i];
    ASSERT_TRUE(a.voxel == b.voxel && a.face == b.face && a.samples == b.samples && a.at == b.at) << i;
  }
}

TEST(Visibility, RefusesACameraInAWallAndAnEmptyPicture) {
  const sim::Frame frame{sim::Vec3(0.0), 1.0, {3, 3, 3}};
  sim::BitVolume occupied(frame.size);
  occupied.set({1, 1, 1});
  const sim::Bricks bricks(occupied);
  EXPECT_THROW(see(frame, occupied, bricks, {{1.2, 0.9, 1.0}, {5, 5, 5}, 40}, 8, 8), sim::InputError);
  EXPECT_THROW(see(frame, occupied, bricks, {{9, 9, 9}, {0, 0, 0}, 40}, 0, 8), sim::InputError);
  EXPECT_NO_THROW(see(frame, occupied, bricks, {{0, 0, 0}, {5, 5, 5}, 40}, 8, 8))
      << "free space within the world";
}

}  // namespace
}  // namespace espalier::render
