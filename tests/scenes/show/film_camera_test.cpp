#include "scenes/show/film_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scenes/problem.h"
#include "tests/support/worlds.h"

namespace espalier::scenes {
namespace {

Scene sceneWith(std::vector<FilmWaypoint> path) {
  Scene scene;
  scene.cameras = {{"front", {{0, 2, 9}, {0, 1, 0}, 40}, {}},
                   {"corner", {{6, 3, 6}, {0, 1, 0}, 36}, {}},
                   {"side", {{9, 2, 0}, {1, 1, 0}, 30}, {}}};
  scene.film.emplace();
  scene.film->path = std::move(path);
  return scene;
}

bool same(const render::Camera& a, const render::Camera& b) {
  return glm::distance(a.eye_m, b.eye_m) < 1e-12 && glm::distance(a.target_m, b.target_m) < 1e-12 &&
         std::abs(a.fov_deg - b.fov_deg) < 1e-12;
}

TEST(FilmCamera, StandsWhereItIsToldOrWhereTheFirstOneDoes) {
  Scene scene = sceneWith({});
  EXPECT_TRUE(same(FilmCamera(scene).at(0.5), scene.cameras[0].camera));
  scene.film->camera = "side";
  for (const double time : {0.0, 0.3, 1.0})
    EXPECT_TRUE(same(FilmCamera(scene).at(time), scene.cameras[2].camera));
}

TEST(FilmCamera, PassesThoseOfItsPathAtTheirTimes) {
  for (const double middle : {0.5, 0.2}) {
    Scene scene = sceneWith({{"front", 0.1}, {"corner", middle}, {"side", 0.9}});
    const FilmCamera camera(scene);
    EXPECT_TRUE(same(camera.at(0.1), scene.cameras[0].camera));
    EXPECT_TRUE(same(camera.at(middle), scene.cameras[1].camera));
    EXPECT_TRUE(same(camera.at(0.9), scene.cameras[2].camera));
    EXPECT_TRUE(same(camera.at(0.0), scene.cameras[0].camera));
    EXPECT_TRUE(same(camera.at(1.0), scene.cameras[2].camera));
  }
  Scene scene = sceneWith({{"front", {}}, {"corner", {}}, {"side", {}}});
  EXPECT_TRUE(same(FilmCamera(scene).at(0.5), scene.cameras[1].camera));
}

/// Its speed has no steps, and is none at either end.
TEST(FilmCamera, MovesSmoothly) {
  Scene scene = sceneWith({{"front", 0.1}, {"corner", 0.3}, {"side", 0.9}});
  const FilmCamera camera(scene);
  constexpr int kSteps = 4000;
  std::vector<sim::Vec3> eyes;
  for (int i = 0; i <= kSteps; ++i) eyes.push_back(camera.at(static_cast<double>(i) / kSteps).eye_m);
  double fastest = 0.0, jerk = 0.0;
  for (std::size_t i = 1; i + 1 < eyes.size(); ++i) {
    fastest = std::max(fastest, glm::distance(eyes[i], eyes[i - 1]));
    jerk = std::max(jerk, glm::length(eyes[i + 1] - 2.0 * eyes[i] + eyes[i - 1]));
  }
  EXPECT_GT(fastest, 1.0 / kSteps);
  EXPECT_LT(jerk, 0.02 * fastest);
}

/// What two that follow each other have alike stays: no swing before a camera that waits.
TEST(FilmCamera, WaitsBetweenTwoThatAreAlike) {
  Scene scene = sceneWith({{"front", 0.0}, {"corner", 0.4}, {"corner", 0.7}, {"side", 1.0}});
  const FilmCamera camera(scene);
  for (int i = 40; i <= 70; ++i) EXPECT_TRUE(same(camera.at(0.01 * i), scene.cameras[1].camera)) << i;
  for (int i = 0; i <= 100; ++i) EXPECT_LE(camera.at(0.01 * i).fov_deg, 40.0 + 1e-9);
}

TEST(FilmCamera, GoesThroughNothing) {
  sim::World world(tests::unitFrame({9, 9, 9}));
  const sim::TiledVoxel middle{{4, 4, 4}, {world.addPart(tests::scenePart("post")), {}, 1.0f, {}, 0.0f}};
  world.occupy(std::span(&middle, 1));
  const auto place = [&](sim::Vec3 vx) { return sim::worldFromVoxel(world.frame(), vx); };
  Scene scene = sceneWith({{"front", {}}, {"corner", {}}});
  scene.file = "scene.yaml";
  scene.film->place = {std::make_shared<const std::string>("scene.yaml"), 7, 3, 0, "film"};
  scene.cameras[0].camera = {place({0, 4, 4}), place({4, 8, 4}), 40};
  scene.cameras[1].camera = {place({8, 4, 4}), place({4, 8, 4}), 40};
  try {
    requireFilmInTheOpen(scene, world);
    ADD_FAILURE() << "it went through the voxel in the middle";
  } catch (const PlacedError& error) {
    const std::string told = format(error.problems());
    EXPECT_NE(told.find("scene.yaml:7:3: at 0."), told.npos) << told;
    EXPECT_NE(told.find("of its way the film's camera is inside"), told.npos) << told;
    EXPECT_NE(told.find("expected a path around it"), told.npos) << told;
  }
  scene.cameras[2].camera = {place({4, 4, 8}), place({4, 8, 4}), 40};
  scene.film->path = {{"front", {}}, {"side", {}}, {"corner", {}}};
  EXPECT_NO_THROW(requireFilmInTheOpen(scene, world));
  scene.cameras[2].camera.target_m = place({4, 4, 8});
  EXPECT_THROW(requireFilmInTheOpen(scene, world), PlacedError);
}

}  // namespace
}  // namespace espalier::scenes
