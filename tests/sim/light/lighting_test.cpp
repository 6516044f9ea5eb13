// Light of worlds whose answers are known.
#include "sim/light/lighting.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/parallel.h"
#include "sim/sweep/sweep.h"
#include "sim/tile/build_world.h"
#include "sim/world/band.h"
#include "tests/support/meshes.h"

namespace espalier::sim {

inline void PrintTo(Weighting weighting, std::ostream* out) {
  *out << nameOf(weighting);
}

namespace {

/// Open ground: one sheet in the lowest voxels, looking up.
World openGround() {
  Mesh mesh = tests::emptyMesh("ground");
  mesh.vertices_m = {{0, 0.5, 0}, {16, 0.5, 0}, {16, 0.5, 12}, {0, 0.5, 12}};
  tests::addTriangle(mesh, 0, 2, 1);
  tests::addTriangle(mesh, 0, 3, 2);
  return buildWorld({Vec3(0.5), 1.0, {16, 8, 12}}, {{mesh, false}}, 0);
}

/// The ground with a wall across it, a single sheet that looks to +z.
World wallOnGround() {
  Mesh mesh = tests::emptyMesh("court");
  mesh.vertices_m = {{0, 0.5, 0},    {32, 0.5, 0},    {32, 0.5, 24},   {0, 0.5, 24},
                     {0, 1.0, 12.5}, {32, 1.0, 12.5}, {32, 9.9, 12.5}, {0, 9.9, 12.5}};
  tests::addTriangle(mesh, 0, 2, 1);
  tests::addTriangle(mesh, 0, 3, 2);
  tests::addTriangle(mesh, 4, 5, 6);
  tests::addTriangle(mesh, 4, 6, 7);
  return buildWorld({Vec3(0.5), 1.0, {32, 14, 24}}, {{mesh, false}}, 0);
}

Sky sky(Weighting weighting, int directions = 96) {
  return makeSky({weighting, 0.005, directions});
}

class EachWeighting : public testing::TestWithParam<Weighting> {};

TEST_P(EachWeighting, OpenGroundReceivesAll) {
  const World world = openGround();
  const Lighting light = lightOf(world, sky(GetParam()), makeSun(SunArc{}));
  ASSERT_EQ(light.surfaces.size(), 16u * 12u);
  ASSERT_EQ(light.where->count(), light.surfaces.size());
  for (std::size_t i = 0; i < light.surfaces.size(); ++i) {
    EXPECT_NEAR(light.sky.values[i], 1.0f, 2e-3f);
    EXPECT_NEAR(light.sun.values[i], 1.0f, 1e-5f);
    EXPECT_NEAR(light.sun_hours.values[i], 12.0f, 1e-4f);
    EXPECT_EQ(light.where->number(light.surfaces[i].voxel), i);
    EXPECT_EQ(light.atFace(light.sky, light.surfaces[i].voxel, 3), light.sky.values[i]);
  }
  EXPECT_TRUE(light.faces.empty());
  EXPECT_EQ(light.about.weighting, nameOf(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Weightings, EachWeighting,
                         testing::Values(Weighting::uniform, Weighting::cosine, Weighting::cie_overcast),
                         testing::PrintToStringParamName());

TEST(Lighting, TheBrightestWayOfOpenGroundIsUpAndBesideAWallAwayFromIt) {
  LightWanted wanted;
  wanted.brightest = true;
  const Lighting open = lightOf(openGround(), sky(Weighting::uniform), {}, wanted);
  ASSERT_EQ(open.brightest.size(), open.surfaces.size());
  for (const Vec3f way : open.brightest) {
    EXPECT_GT(way.y, 0.995f);
    EXPECT_NEAR(glm::length(way), 1.0f, 1e-5f);
  }
  const Lighting court = lightOf(wallOnGround(), sky(Weighting::uniform), {}, wanted);
  const Vec3f before = court.brightest[court.where->number({16, 0, 14})];
  const Vec3f behind = court.brightest[court.where->number({16, 0, 9})];
  EXPECT_GT(before.z, 0.3f);
  EXPECT_LT(behind.z, -0.3f);
}

TEST(Lighting, ASheetSeenFromBehindIsJudgedByItsFace) {
  const World world = wallOnGround();
  const Lighting light = lightOf(world, sky(Weighting::cosine, 256));
  const Voxel on_wall(16, 8, 12);
  ASSERT_TRUE(light.where->has(on_wall));
  // Near the top of an endless wall the view factor is a half, on either side of it.
  EXPECT_NEAR(light.atFace(light.sky, on_wall, 5), 0.5f, 0.05f);
  EXPECT_NEAR(light.atFace(light.sky, on_wall, 4), 0.5f, 0.05f);
  EXPECT_EQ(light.atFace(light.sky, on_wall, 5), light.sky.values[light.where->number(on_wall)]);
  EXPECT_FALSE(light.faces.empty());
  // The wall's top edge looks up and has no surface of its own there: all of the sky.
  EXPECT_NEAR(light.atFace(light.sky, {16, 9, 12}, 3), 1.0f, 0.02f);
}

TEST(Lighting, WhatHasNoPlaceInFrontIsJudgedByItsFacesAndIsNoSurface) {
  // Looks down onto something that lies right below it: nothing is in front, but its other faces are free.
  World world = openGround();
  const PartId part = world.addPart({"box", "lid", PartKind::scene, -1});
  const Surface down{.part = part, .colour = Colour(0.5f), .coverage = 1.0f, .normal = Vec3f(0, -1, 0)};
  const Surface up{.part = part, .colour = Colour(0.5f), .coverage = 1.0f, .normal = Vec3f(0, 1, 0)};
  std::vector<TiledVoxel> tiled{{{8, 5, 6}, down}};
  for (int y = 1; y < 5; ++y) {
    for (int z = 5; z < 8; ++z) {
      for (int x = 7; x < 10; ++x) tiled.push_back({{x, y, z}, up});
    }
  }
  world.occupy(tiled);
  const Lighting light = lightOf(world, sky(Weighting::cosine, 256));
  const Voxel lid(8, 5, 6);
  ASSERT_TRUE(light.gaps->has(lid));
  EXPECT_FALSE(light.where->has(lid));
  EXPECT_NEAR(light.atFace(light.sky, lid, 3), 1.0f, 0.02f);
  EXPECT_NEAR(light.atFace(light.sky, lid, 0), 0.5f, 0.05f);
  const auto means = light.ofGaps(light.sky);
  ASSERT_EQ(means.size(), light.gaps->count());
  EXPECT_NEAR(means[light.gaps->number(lid)], 0.6f, 0.05f);  // (1 + 4 / 2) / 5
}

TEST(Lighting, FacesAtTheEdgeOfTheWorldSeeTheHalfThatTheyFace) {
  const Lighting light = lightOf(openGround(), sky(Weighting::cosine, 256), makeSun(SunArc{}));
  EXPECT_NEAR(light.sky.beyond[3], 1.0f, 0.01f);
  EXPECT_EQ(light.sky.beyond[2], 0.0f);
  for (const int side : {0, 1, 4, 5})
    EXPECT_NEAR(light.sky.beyond[static_cast<std::size_t>(side)], 0.5f, 0.02f);
}

TEST(Lighting, SpaceHoldsWhatTheSweepSaysAndNothingWhereNothingWasAsked) {
  const World world = wallOnGround();
  const Sky cosine = sky(Weighting::cosine);
  const Sun sun = makeSun(SunArc{});
  EXPECT_EQ(lightOf(world, cosine, sun).space_sky, nullptr);
  LightWanted wanted;
  wanted.space = std::make_shared<const VoxelSet>(freeBand(world, world.occupied(), 2));
  wanted.space_hours = true;
  const Lighting light = lightOf(world, cosine, sun, wanted);
  const ExposureField dense = sweepExposure(world.opaque(), receivedBy(cosine));
  for (const Voxel v : wanted.space->voxels()) ASSERT_EQ(light.space_sky->at(v), dense.at(v));
  EXPECT_EQ(light.space_sky->values.size(), wanted.space->count());
  EXPECT_EQ(light.space_hours, light.space_sun);  // an evenly weighted sun: the same shares
}

TEST(Lighting, GreenesRaysAgreeWithTheDirectionsAsFarAsTheyCan) {
  const World world = wallOnGround();
  LightWanted wanted;
  wanted.random_sky = RandomSky{400, 3};
  const Lighting random = lightOf(world, sky(Weighting::uniform), {}, wanted);
  const Lighting even = lightOf(world, sky(Weighting::uniform, 400));
  ASSERT_EQ(random.sky.values.size(), even.sky.values.size());
  double off = 0.0, count = 0.0;
  for (std::size_t i = 0; i < even.surfaces.size() && even.surfaces[i].voxel.y == 0; ++i) {  // the floor
    off += std::abs(random.sky.values[i] - even.sky.values[i]);
    count += 1.0;
  }
  EXPECT_GT(count, 500.0);
  EXPECT_GT(off, 0.0);
  EXPECT_LT(off / count, 0.02);
  EXPECT_NE(random.about.sky.find("400 random rays"), std::string::npos) << random.about.sky;
  EXPECT_EQ(random.about.standard_error, 0.0);
}

TEST(Lighting, IsTheSameOnAnyNumberOfThreads) {
  const World world = wallOnGround();
  std::vector<Lighting> lights;
  LightWanted wanted;
  wanted.brightest = true;
  for (const int threads : {1, 2, 5}) {
    onThreads(threads, [&] {
      lights.push_back(lightOf(world, sky(Weighting::cie_overcast), makeSun(SunArc{}), wanted));
    });
  }
  for (const Lighting& light : lights) {
    EXPECT_EQ(light.sky.values, lights[0].sky.values);
    EXPECT_EQ(light.sun_hours.values, lights[0].sun_hours.values);
    EXPECT_EQ(light.brightest, lights[0].brightest);
    EXPECT_EQ(light.faces, lights[0].faces);
  }
  // Another sky and another sun are other light.
  const Lighting other = lightOf(world, sky(Weighting::uniform), makeSun(SunArc{.tilt_deg = 25.0}), wanted);
  EXPECT_NE(other.sky.values, lights[0].sky.values);
  EXPECT_NE(other.sun_hours.values, lights[0].sun_hours.values);
  EXPECT_NE(other.brightest, lights[0].brightest);
}

/// Behind the wall lies its shadow, as long as it is high where the sun stands at half a right angle.
TEST(Lighting, ASunInOnePlaceCastsAShadow) {
  const World world = wallOnGround();
  LightWanted wanted;
  const Vec3 to_sun = glm::normalize(Vec3(0, 1, 1));
  wanted.to_sun = to_sun;
  const Lighting light = lightOf(world, sky(Weighting::cosine), {}, wanted);
  ASSERT_EQ(light.sun_now.values.size(), light.sky.values.size());
  const auto on_ground = [&](int z) { return light.atFace(light.sun_now, {16, 0, z}, 3); };
  for (const int z : {14, 20}) EXPECT_FLOAT_EQ(on_ground(z), 1.0f) << z;
  for (const int z : {5, 10}) EXPECT_FLOAT_EQ(on_ground(z), 0.0f) << z;
  EXPECT_FLOAT_EQ(on_ground(1), 1.0f) << "beyond the shadow";
  EXPECT_FLOAT_EQ(light.atFace(light.sun_now, {16, 5, 12}, 5), 1.0f) << "the wall's front";
  EXPECT_FLOAT_EQ(light.atFace(light.sun_now, {16, 5, 12}, 4), 0.0f) << "its back";
  wanted.to_sun = Vec3(0, -1, 0);
  for (const float value : lightOf(world, sky(Weighting::cosine), {}, wanted).sun_now.values)
    EXPECT_EQ(value, 0.0f);
  EXPECT_TRUE(lightOf(world, sky(Weighting::cosine)).sun_now.values.empty());
}

TEST(Sun, MayStandStillAnywhereAboveTheHorizon) {
  for (int i = 0; i < 400; ++i) {
    const double height = 1.0 - (i + 0.5) / 400.0, turn = 2.4 * i, across = std::sqrt(1.0 - height * height);
    const Vec3 to_sun(across * std::cos(turn), height, across * std::sin(turn));
    const Sun sun = sunStandingAt(to_sun);
    ASSERT_EQ(sun.directions.size(), 1u);
    EXPECT_LE(sun.worst_angle_deg, 0.71);
    EXPECT_GT(glm::dot(glm::normalize(Vec3(sun.directions[0].v)), to_sun), std::cos(0.0125));
  }
  EXPECT_EQ(sunStandingAt(glm::normalize(Vec3(0.01, 1, 0.01))).directions.size(), 1u) << "beside an axis";
  EXPECT_TRUE(sunStandingAt({0, -1, 0}).directions.empty());
}

}  // namespace
}  // namespace espalier::sim
