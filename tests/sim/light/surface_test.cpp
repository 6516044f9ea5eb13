#include "sim/light/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "sim/base/parallel.h"
#include "sim/light/nooks.h"
#include "sim/light/places_before.h"
#include "sim/sweep/sweep.h"
#include "sim/tile/build_world.h"
#include "tests/support/meshes.h"
#include "tests/support/worlds.h"

namespace espalier::sim {
namespace {

constexpr std::array kWeightings{Weighting::uniform, Weighting::cosine, Weighting::cie_overcast};

struct Judged {
  SurfaceSensors sensors;
  std::vector<float> sky;
};

Judged judged(const World& world, const Sky& sky) {
  Judged j{surfaceSensors(world), {}};
  j.sky = surfaceSky(j.sensors, sweepOpen(world.opaque(), sky.directions, j.sensors.places), sky);
  return j;
}

/// A slab about the middle of a world of 48 voxels, tilted and turned.
Mesh slab(double tilt, double turn) {
  Mesh mesh = tests::boxMesh({-14, -6, -14}, {14, 0, 14});
  const double s = std::sin(tilt), c = std::cos(tilt), u = std::sin(turn), v = std::cos(turn);
  for (Vec3& p : mesh.vertices_m) {
    const Vec3 q(c * p.x + s * p.y, -s * p.x + c * p.y, p.z);
    p = Vec3(v * q.x - u * q.z, q.y, u * q.x + v * q.z) + Vec3(24.3, 24.1, 23.8);
  }
  return mesh;
}

TEST(SurfaceSky, OpenPlanesReceiveTheClosedForm) {
  for (const Weighting weighting : kWeightings) {
    const Sky sky = makeSky({.weighting = weighting, .directions = 128});
    for (const double tilt : {0.0, 0.2, 0.6, 0.9, 1.3, std::numbers::pi / 2}) {
      for (const bool solid : {true, false}) {
        const World world = buildWorld(tests::unitFrame(Voxel(48)), {{slab(tilt, 0.4 + tilt), solid}}, 0);
        const Judged j = judged(world, sky);
        const Vec3 normal = glm::normalize(Vec3(std::sin(tilt) * std::cos(0.4 + tilt), std::cos(tilt),
                                                std::sin(tilt) * std::sin(0.4 + tilt)));
        int seen = 0;
        for (std::size_t i = 0; i < j.sky.size(); ++i) {
          const TiledVoxel& t = j.sensors.surfaces[i];
          if (glm::dot(Vec3(t.surface.normal), normal) < 0.9999) continue;
          if (glm::distance(Vec3(t.voxel), Vec3(24)) > 11.0) continue;
          ++seen;
          ASSERT_NEAR(j.sky[i], openSky(weighting, normal), 0.02) << tilt << ' ' << solid;
        }
        EXPECT_GT(seen, 200);
      }
    }
  }
}

TEST(SurfaceSky, OpenGroundReceivesExactlyAll) {
  const World world =
      buildWorld(tests::unitFrame({40, 12, 40}), {{tests::boxMesh({-5, -5, -5}, {60, 4.2, 60}), true}}, 0);
  for (const Weighting weighting : kWeightings) {
    const Judged j = judged(world, makeSky({.weighting = weighting, .directions = 100}));
    ASSERT_EQ(j.sky.size(), 40u * 40);
    for (const float e : j.sky) ASSERT_EQ(e, 1.0f);
  }
}

TEST(SurfaceSky, TheFootOfAnEndlessWallReceivesExactlyHalf) {
  const Mesh wall = tests::boxMesh({-9, -9, -9}, {4.3, 300, 300});
  const Mesh ground = tests::boxMesh({-9, -9, -9}, {90, 3.1, 300}, "ground");
  const World world = buildWorld(tests::unitFrame({50, 220, 221}), {{wall, true}, {ground, true}}, 0);
  for (const Weighting weighting : kWeightings) {
    const Sky sky = makeSky({.weighting = weighting, .directions = 128});
    std::vector<TiledVoxel> some;
    for (int y = 0; y < 8; ++y) {
      for (int x = 4; x < 9; ++x) {
        if (const auto s = world.surfaceAt({x, y, 110})) some.push_back({{x, y, 110}, *s});
      }
    }
    const auto sensors = surfaceSensors(world, some);
    const auto open = sweepOpen(world.opaque(), sky.directions, sensors.places);
    const auto light = surfaceSky(sensors, open, sky);
    int walls = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
      if (sensors.surfaces[i].surface.normal != Vec3f(1, 0, 0)) continue;
      ++walls;
      EXPECT_NEAR(light[i], static_cast<float>(openSky(weighting, Vec3(1, 0, 0))), 1e-6f);
      if (weighting != Weighting::cie_overcast) {
        EXPECT_NEAR(light[i], 0.5f, 1e-6f);
      }
    }
    EXPECT_GE(walls, 4);
  }
}

TEST(OpenSky, IsTheIntegralOverTheSkyBeforeTheReceiver) {
  const int n = 400;
  for (const Weighting weighting : kWeightings) {
    for (const double tilt : {0.0, 0.4, 1.1, 1.57, 2.3, 3.0}) {
      const Vec3 normal(std::sin(tilt), std::cos(tilt), 0.0);
      double sum = 0.0;
      for (int i = 0; i < n; ++i) {
        const double y = (i + 0.5) / n, across = std::sqrt(1 - y * y);
        for (int k = 0; k < n; ++k) {
          const double a = 2 * std::numbers::pi * (k + 0.5) / n;
          const Vec3 d(across * std::cos(a), y, across * std::sin(a));
          if (glm::dot(d, normal) > 0) sum += received(weighting, d, normal) / (n * n);
        }
      }
      EXPECT_NEAR(openSky(weighting, normal), sum, 1e-3) << tilt;
    }
  }
}

/// A terrain with a solid sphere, a box inside out and a thin wall on it.
World garden() {
  const auto hills = [](double x, double z) { return 8 + 2 * std::sin(0.3 * x) * std::cos(0.25 * z); };
  return buildWorld(tests::unitFrame({70, 40, 50}),
                    {{tests::terrainMesh(72, 1.0, hills), false},
                     {tests::sphereMesh({20.3, 17.2, 20.4}, 9.0, 20), true},
                     {tests::insideOut(tests::boxMesh({40.2, 5, 30.3}, {52.1, 22.4, 44.7}, "hut")), true},
                     {tests::boxMesh({8, 4, 40}, {60, 14, 40.4}, "fence"), false}},
                    0);
}

TEST(SurfaceSensors, WeightsAddUpAndPlacesAreFreeAndInFront) {
  const World world = garden();
  const SurfaceSensors sensors = surfaceSensors(world);
  EXPECT_GT(sensors.surfaces.size(), 5000u);
  ASSERT_EQ(sensors.own.size(), sensors.surfaces.size());
  const auto places = sensors.places->voxels();
  for (std::size_t i = 0; i < sensors.surfaces.size(); ++i) {
    const auto& [voxel, surface] = sensors.surfaces[i];
    float sum = 0.0f;
    ASSERT_FALSE(sensors.of(i).empty());
    for (const auto& tap : sensors.of(i)) {
      sum += tap.weight;
      const Voxel place = places[tap.place];
      ASSERT_FALSE(world.opaque().at(place));
      ASSERT_GT(glm::dot(Vec3f(place - voxel), surface.normal), surface.offset_vx);
    }
    ASSERT_NEAR(sum, 1.0f, 1e-4f);
  }
}

/// Most surfaces take the places of the one before that lay alike: the same as each anew.
TEST(SurfaceSensors, PlacesThatAreKeptAreThePlainOnes) {
  const World world = garden();
  const BitVolume nooks = nooksOf(world);
  EXPECT_GT(nooks.count(), 100u);
  PlacesBefore places(world.opaque(), &nooks);
  std::vector<SurfaceSensors::Tap> kept, plain;
  const auto same = [](const auto& a, const auto& b) { return a.place == b.place && a.weight == b.weight; };
  std::size_t with_places = 0;
  for (const TiledVoxel& tiled : world.surfaces()) {
    if (tiled.surface.normal == Vec3f(0.0f)) continue;
    kept.clear();
    plain.clear();
    ASSERT_EQ(places.append(tiled, kept), places.appendPlainly(tiled, plain));
    ASSERT_TRUE(std::ranges::equal(kept, plain, same));
    with_places += kept.empty() ? 0 : 1;
  }
  EXPECT_GT(with_places, 5000u);
}

/// What is seen from the stairs of a slanting wall says little of the floor before it.
TEST(SurfaceSensors, FloorsAreNotJudgedFromTheStairsOfWalls) {
  const World world = garden();
  const BitVolume nooks = nooksOf(world);
  const SurfaceSensors sensors = surfaceSensors(world);
  const auto places = sensors.places->voxels();
  std::size_t from_nooks = 0;
  for (std::size_t i = 0; i < sensors.surfaces.size(); ++i) {
    const auto inNook = [&](const auto& tap) { return nooks.at(places[tap.place]); };
    from_nooks += std::ranges::any_of(sensors.of(i), inNook) ? 1 : 0;
  }
  EXPECT_LT(from_nooks, sensors.surfaces.size() / 100);  // those that have no other places
}

TEST(SurfaceSensors, ATurnedSolidLooksOut) {
  const SurfaceSensors sensors = surfaceSensors(garden());
  int roof = 0;
  for (const auto& [voxel, surface] : sensors.surfaces) {
    if (voxel.y == 22 && voxel.x > 41 && voxel.x < 51 && voxel.z > 31 && voxel.z < 43) {
      ++roof;
      EXPECT_EQ(surface.normal, Vec3f(0, 1, 0));
    }
  }
  EXPECT_EQ(roof, 9 * 11);
}

TEST(SurfaceSensors, OfSomeAreThoseOfAll) {
  const World world = garden();
  const Sky sky = makeSky({.directions = 64});
  const Judged all = judged(world, sky);
  std::vector<TiledVoxel> some;
  std::vector<float> expected;
  for (std::size_t i = 3; i < all.sky.size(); i += 41) {
    some.push_back(all.sensors.surfaces[i]);
    expected.push_back(all.sky[i]);
  }
  const SurfaceSensors sensors = surfaceSensors(world, some);
  EXPECT_EQ(surfaceSky(sensors, sweepOpen(world.opaque(), sky.directions, sensors.places), sky), expected);
}

/// A step of the sun's way that leads through a wall's plane is before it for half of its time.
TEST(SurfaceSun, AWallInTheSunsPlaneSeesHalfOfTheStep) {
  const World world =
      buildWorld(tests::unitFrame(Voxel(48)), {{tests::boxMesh(Vec3(14.5), Vec3(33.5)), true}}, 0);
  Sun sun;
  sun.directions = directionSet({{-1, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}},
                                {1.0, 1.0, 1.0, 1.0, 1.0}, ExposureField::kWhole);
  sun.hours = {1.0, 1.0, 1.0, 1.0, 1.0};  // the first two on the horizon
  const SurfaceSensors sensors = surfaceSensors(world);
  const OpenTable open = sweepOpen(world.opaque(), sun.directions, sensors.places);
  const auto hours = surfaceSunHours(sensors, open, sun), shares = surfaceSun(sensors, open, sun);
  std::size_t walls = 0, roof = 0;
  for (std::size_t i = 0; i < hours.size(); ++i) {
    const TiledVoxel& t = sensors.surfaces[i];
    const Vec3f size = glm::abs(t.surface.normal);
    if (std::max({size.x, size.y, size.z}) < 0.999f || glm::distance(Vec3(t.voxel), Vec3(24)) > 13.0)
      continue;
    if (t.surface.normal.y < -0.9f) {
      ASSERT_EQ(hours[i], 0.0f);
      continue;
    }
    const bool is_roof = t.surface.normal.y > 0.9f;
    ++(is_roof ? roof : walls);
    // Walls to x lie in the plane at noon, walls to z all day.
    ASSERT_NEAR(hours[i], is_roof ? 5.0f : 2.5f, 1e-4f);
    ASSERT_NEAR(shares[i], is_roof ? 1.0f : 0.5f, 1e-4f);
  }
  EXPECT_GT(roof, 50u);
  EXPECT_GT(walls, 200u);
}

/// Where a surface along an axis looks along a direction from: as far as places lead towards where the ray
/// from the surface comes through their layer, four voxels at most.
std::optional<std::size_t> placeAlong(const VoxelSet& places, const TiledVoxel& tiled, Voxel direction) {
  const Vec3f n = tiled.surface.normal, size = glm::abs(n);
  const int up = size.y > 0.998f ? 1 : size.x > 0.998f ? 0 : 2;
  if (size[up] < 0.998f) return std::nullopt;
  const auto layer = static_cast<int>(std::max(1.0f, std::ceil(tiled.surface.offset_vx + 0.4f)));
  Voxel place = tiled.voxel;
  place[up] += n[up] > 0.0f ? layer : -layer;
  const auto isPlace = [&](Voxel v) { return contains(places.bits().size(), v) && places.has(v); };
  if (!isPlace(place)) return std::nullopt;
  Vec3f across(glm::normalize(Vec3(direction)));
  const float rising = std::max(std::abs(across[up]), 1e-6f);
  across[up] = 0.0f;
  const float height = static_cast<float>(layer) - tiled.surface.offset_vx;
  across *= std::min(height / rising, 4.0f / std::max(glm::length(across), 1e-6f));
  const Voxel aside(glm::round(across)), before = place;
  const int steps = std::max({std::abs(aside.x), std::abs(aside.y), std::abs(aside.z)});
  for (int i = 1; i <= steps; ++i) {
    const float part = static_cast<float>(i) / static_cast<float>(steps);
    const Voxel next = before + Voxel(glm::round(Vec3f(aside) * part));
    if (!isPlace(next)) break;
    place = next;
  }
  return places.number(place);
}

/// What the tables add up to, in double precision and one by one.
TEST(SurfaceLight, IsThePlainSum) {
  const World world = garden();
  Sun sun = makeSun(SunArc{});
  const SurfaceSensors sensors = surfaceSensors(world);
  int along_axes = 0;
  for (const Weighting weighting : kWeightings) {
    const Sky sky = makeSky({.weighting = weighting, .directions = 77});
    const OpenTable open = sweepOpen(world.opaque(), sky.directions, sensors.places);
    const OpenTable sunny = sweepOpen(world.opaque(), sun.directions, sensors.places);
    const auto light = surfaceSky(sensors, open, sky);
    const auto sunlight = surfaceSun(sensors, sunny, sun);
    const auto hours = surfaceSunHours(sensors, sunny, sun);
    for (std::size_t i = 0; i < light.size(); i += 17) {
      const Vec3 normal(sensors.surfaces[i].surface.normal);
      double sum = 0.0, most = 0.0, sun_sum = 0.0, sun_most = 0.0, hour_sum = 0.0, hour_most = 0.0;
      for (std::size_t d = 0; d < sky.directions.size(); ++d) {
        const Vec3 unit = glm::normalize(Vec3(sky.directions[d].v));
        if (glm::dot(unit, normal) <= 1e-6) continue;
        const double amount = sky.directions[d].weight * received(weighting, unit, normal);
        most += amount;
        for (const auto& tap : sensors.of(i)) sum += open.open(tap.place, d) ? tap.weight * amount : 0.0;
      }
      for (std::size_t d = 0; d < sun.directions.size(); ++d) {
        const double before = glm::dot(glm::normalize(Vec3(sun.directions[d].v)), normal);
        const bool up = normal.y > 0.999999, down = normal.y < -0.999999;
        if (!up && (down || before < -1e-6)) continue;
        const double part = up || before > 1e-6 ? 1.0 : 0.5;  // half of a step through its own plane
        const double amount = part * sun.directions[d].weight / 65535.0;
        sun_most += amount;
        hour_most += part * sun.hours[d];
        const auto along = placeAlong(*sensors.places, sensors.surfaces[i], sun.directions[d].v);
        double open_part = 0.0;
        for (const auto& tap : sensors.of(i)) open_part += sunny.open(tap.place, d) ? tap.weight : 0.0f;
        if (along) open_part = sunny.open(*along, d) ? 1.0 : 0.0;
        along_axes += along ? 1 : 0;
        sun_sum += open_part * amount;
        hour_sum += open_part * part * sun.hours[d];
      }
      const double part = most > 0.0 ? std::clamp(sum / most, 0.0, 1.0) : 0.0;
      ASSERT_NEAR(light[i], part * openSky(weighting, normal), 2e-5);
      ASSERT_NEAR(sunlight[i], std::clamp(sun_sum, 0.0, sun_most), 2e-5);
      ASSERT_NEAR(hours[i], std::clamp(hour_sum, 0.0, hour_most), 2e-4);
    }
  }
  EXPECT_GT(along_axes, 1000);
}

/// A face within a wall of two sheets has nothing in front: it was as bright as open ground.
TEST(SurfaceLight, WhatHasNoPlaceInFrontIsDark) {
  const World world = garden();
  const Sky sky = makeSky({.directions = 64});
  const Sun sun = makeSun(SunArc{});
  SurfaceSensors sensors = surfaceSensors(world);
  sensors.surfaces.push_back(sensors.surfaces.front());
  sensors.own.push_back({0, 0, 0});
  const auto open = sweepOpen(world.opaque(), sky.directions, sensors.places);
  const auto sunny = sweepOpen(world.opaque(), sun.directions, sensors.places);
  EXPECT_GT(surfaceSky(sensors, open, sky).front(), 0.0f);
  EXPECT_EQ(surfaceSky(sensors, open, sky).back(), 0.0f);
  EXPECT_EQ(surfaceSun(sensors, sunny, sun).back(), 0.0f);
  EXPECT_EQ(surfaceSunHours(sensors, sunny, sun).back(), 0.0f);
}

TEST(SurfaceLight, OfTheSunComesBothAtOnceAsEachAlone) {
  const World world = garden();
  const Sun sun = makeSun(SunArc{});
  const SurfaceSensors sensors = surfaceSensors(world);
  const auto open = sweepOpen(world.opaque(), sun.directions, sensors.places);
  const SunOnSurfaces both = sunOnSurfaces(sensors, open, sun);
  EXPECT_EQ(both.shares, surfaceSun(sensors, open, sun));
  EXPECT_EQ(both.hours, surfaceSunHours(sensors, open, sun));
  EXPECT_NE(both.shares, both.hours);
}

TEST(SurfaceLight, IsTheSameOnAnyNumberOfThreads) {
  const World world = garden();
  const Sky sky = makeSky({.directions = 64});
  std::vector<std::vector<float>> answers;
  for (const int threads : {1, 2, 5}) {
    onThreads(threads, [&] { answers.push_back(judged(world, sky).sky); });
  }
  EXPECT_EQ(answers[0], answers[1]);
  EXPECT_EQ(answers[0], answers[2]);
  EXPECT_NE(answers[0], judged(world, makeSky({.directions = 65})).sky);  // a direction more would show
}

}  // namespace
}  // namespace espalier::sim
