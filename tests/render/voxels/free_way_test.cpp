#include "render/voxels/free_way.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/world/ray.h"
#include "tests/support/little_garden.h"

namespace espalier::render {
namespace {

constexpr int kWidth = 96, kHeight = 72;

double between(std::mt19937& rng, double low, double high) {
  return low + (high - low) * (static_cast<double>(rng()) * 0x1p-32);
}

/// What rays through any point of a picture meet, and how far they are told to be free.
struct Told {
  int rays = 0, told = 0, too_far = 0;
  double free = 0.0, met = 0.0;
};

/// By grids of pixels 1, 2, 4.. apart.
Told ask(const sim::BitVolume& occupied, const Camera& camera, unsigned grids, std::mt19937& rng) {
  const sim::Bricks bricks(occupied);
  const CameraRays rays(camera, static_cast<double>(kWidth) / kHeight);
  const sim::Vec3 eye = camera.eye_m;  // voxels are a metre wide, and the first one's centre is the origin
  const auto met = [&](double x, double y) {
    const auto hit = sim::firstHit(occupied, bricks, eye, rays.direction(x / kWidth, y / kHeight));
    return hit ? hit->t : HUGE_VAL;
  };
  FreeWay free(camera, kWidth, kHeight, eye, occupied);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) free.tell({x, y}, met(x + 0.5, y + 0.5));
  Told told;
  for (int i = 0; i < 4000; ++i) {
    const glm::dvec2 at(between(rng, 0, kWidth), between(rng, 0, kHeight));
    const double way = free.of(at, 1 << (rng() % grids)), truth = met(at.x, at.y);
    ++told.rays;
    told.told += way > 0.0;
    told.too_far += way > truth;
    if (std::isfinite(truth)) {
      told.free += way;
      told.met += truth;
    }
  }
  return told;
}

TEST(FreeWay, IsNeverFartherThanWhatTheRayMeets) {
  std::mt19937 rng(7);
  Told all;
  for (int round = 0; round < 60; ++round) {
    const sim::Voxel size(20 + static_cast<int>(rng() % 60), 20 + static_cast<int>(rng() % 40),
                          20 + static_cast<int>(rng() % 60));
    sim::BitVolume occupied(size);
    // Lone voxels before each other, which look like corners and spikes.
    const int count = 1 << (rng() % 12);
    for (int i = 0; i < count; ++i) {
      occupied.set({static_cast<int>(rng() % static_cast<unsigned>(size.x)),
                    static_cast<int>(rng() % static_cast<unsigned>(size.y)),
                    static_cast<int>(rng() % static_cast<unsigned>(size.z))});
    }
    // From the edge of what can be told to far away; pictures of voxels from hundreds of pixels to less than
    // one.
    const sim::Vec3 away(between(rng, -1, 1), between(rng, -1, 1), between(rng, -1, 1));
    Camera camera;
    camera.target_m = 0.5 * sim::Vec3(size);
    camera.eye_m =
        camera.target_m + glm::normalize(away) * between(rng, 0.3, 3.0) * glm::length(sim::Vec3(size));
    camera.fov_deg = between(rng, 5, 100);
    const Told told = ask(occupied, camera, 4, rng);
    EXPECT_EQ(told.too_far, 0) << "round " << round;
    all.rays += told.rays;
    all.told += told.told;
  }
  EXPECT_GT(all.told, all.rays / 3);
}

TEST(FreeWay, IsMostOfTheWayInAGarden) {
  std::mt19937 rng(8);
  const tests::LittleGarden garden(2);
  Camera camera = tests::LittleGarden::camera();
  camera.eye_m = sim::voxelFromWorld(garden.frame(), camera.eye_m);
  camera.target_m = sim::voxelFromWorld(garden.frame(), camera.target_m);
  const Told told = ask(garden.occupied(), camera, 1, rng);
  EXPECT_GT(told.free, 0.5 * told.met);  // none at all is told at the edges
}

TEST(FreeWay, IsNoneBesideWhatStandsBeforeTheEye) {
  std::mt19937 rng(9);
  sim::BitVolume occupied({40, 40, 40});
  occupied.set({20, 20, 36});
  Camera camera;
  camera.eye_m = {20.4, 20.3, 39.0};
  camera.target_m = {20.0, 20.0, 0.0};
  EXPECT_EQ(ask(occupied, camera, 4, rng).told, 0);
}

}  // namespace
}  // namespace espalier::render
