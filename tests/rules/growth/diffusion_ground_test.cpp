#include "rules/growth/diffusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/parallel.h"
#include "tests/support/laid_grounds.h"

namespace espalier::rules {
namespace {

using namespace tests;
using sim::Vec3;

/// Hills with ripples: 60 x 60 squares of two triangles over 4 x 4 m.
sim::TiledMesh terrain() {
  sim::TiledMesh tiled;
  tiled.mesh = tests::emptyMesh("terrain");
  constexpr int kSteps = 60;
  for (int j = 0; j <= kSteps; ++j) {
    for (int i = 0; i <= kSteps; ++i) {
      const double x = 4.0 * i / kSteps, z = 4.0 * j / kSteps;
      tiled.mesh.vertices_m.emplace_back(
          x, 0.4 * std::sin(1.7 * x) * std::cos(1.3 * z) + 0.05 * std::sin(9.0 * x + 4.0 * z), z);
    }
  }
  for (std::uint32_t j = 0; j < kSteps; ++j) {
    for (std::uint32_t i = 0; i < kSteps; ++i) {
      const std::uint32_t a = j * (kSteps + 1) + i, b = a + kSteps + 1;
      tests::addTriangle(tiled.mesh, a, b, b + 1);
      tests::addTriangle(tiled.mesh, a, b + 1, a + 1);
    }
  }
  return tiled;
}

TEST(Diffusion, KeepsFeetApartOnHills) {
  LaidGround ground({terrain()});
  RuleSet rules = tufts();
  rules.diffusion.distance = Length{6.0};
  rules.diffusion.gap_min = {1.5};
  rules.elements.front().pose = Pose::stand;
  const sim::Growth growth = ground.grow(rules, {{2.0, 0.3, 2.0}}, 60);
  const auto& elements = growth.plants.front().elements;
  EXPECT_GT(elements.size(), 2000u);
  double least = 1e9;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      least = std::min(least, glm::distance(elements[i].position_vx, elements[k].position_vx));
  }
  EXPECT_GE(least, 1.5 - 1e-6);
}

TEST(Diffusion, BendsAsFarAsTheSetOfItsRegionSays) {
  sim::TiledMesh ball;
  ball.mesh = tests::sphereMesh({0, 0, 0}, 0.5, 24);
  ball.solid = true;
  RuleSet rules = tufts();
  rules.diffusion.distance = Length{5.0};
  const auto lowest = [&](const RuleSet& by) {
    LaidGround ground({ball});
    const sim::Growth growth = ground.grow(by, {{0, 0.6, 0}}, 30);
    double low = 1.0;
    for (const auto& element : growth.plants.front().elements) low = std::min(low, element.y.y);
    return low;
  };
  // Foot by foot it would go all the way around; the set that holds there lets nothing lie askew.
  RuleSet stiff = rules;
  stiff.diffusion.bend_deg = 1.0;
  RuleSet book = rules;
  book.regions["all"] = {false, std::make_shared<const RuleSet>(stiff)};
  EXPECT_LT(lowest(rules), -0.8);
  EXPECT_GT(lowest(book), 0.9);
}

TEST(Diffusion, KnowsWallsAndGroundsThatReachFarBeyondTheWorld) {
  constexpr double kFar_m = 20'000.0;
  sim::TiledMesh far = sheet(1.0, 1.0);
  far.mesh.vertices_m = {
      {-kFar_m, 0, -kFar_m}, {kFar_m, 0, -kFar_m}, {kFar_m, 0, kFar_m}, {-kFar_m, 0, kFar_m}};
  sim::TiledMesh wall = sheet(1.0, 1.0);
  wall.mesh.regions = {"wall"};
  wall.mesh.vertices_m = {
      {0.5, -kFar_m, -kFar_m}, {0.5, kFar_m, -kFar_m}, {0.5, kFar_m, kFar_m}, {0.5, -kFar_m, kFar_m}};
  LaidGround ground({far, wall}, sim::Frame{Vec3(-1.0, -0.2, -1.0), kLaidVoxel_m, {60, 20, 60}});
  RuleSet rules = tufts();
  rules.regions["wall"] = {true, nullptr};
  // Standing, so that nothing but what is exact keeps its blades out of the wall.
  rules.elements.front().polygons = {{{-3.0, 0, 0}, {3.0, 0, 0}, {0, 2.0, 0.2}}};
  const sim::Growth growth = ground.grow(rules, {{-0.3, 0.1, 0.0}}, 20);
  EXPECT_GT(elementsOf(growth), 200u);
  std::size_t beside = 0;
  for (const auto& element : growth.plants.front().elements) {
    double low = 1e9, high = -1e9;
    for (const Vec3 corner : rules.elements.front().polygons.front()) {
      const double x = sim::worldFromVoxel(ground.world.frame(), sim::placed(element, corner)).x;
      low = std::min(low, x);
      high = std::max(high, x);
    }
    EXPECT_FALSE(low < 0.499 && high > 0.501) << low << " to " << high;
    beside += std::abs(high - 0.5) < 0.1 ? 1 : 0;
  }
  EXPECT_GT(beside, 3u);
  // What is measured is what lies in the world.
  const LaidMeasure measure = measured(ground, rules, growth);
  EXPECT_NEAR(measure.surface_vx2, 59.0 * 60.0, 60.0);  // all but the wall
  EXPECT_GT(measure.covered_vx2, 300.0);
}

}  // namespace
}  // namespace espalier::rules
