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

TEST(Diffusion, IsTheSameOnAnyNumberOfThreads) {
  for (const RuleSet& rules : {paving(), tufts()}) {
    std::vector<std::uint64_t> states;
    for (const int threads : {1, 2, 5}) {
      sim::onThreads(threads, [&] {
        LaidGround ground({sheet(3.0, 3.0)});
        const sim::Growth growth = ground.grow(rules, {{1.0, 0.1, 1.0}, {2.0, 0.1, 2.2}}, 6);
        EXPECT_GT(elementsOf(growth), 50u);
        states.push_back(sim::stateHash(ground.world, growth));
      });
    }
    EXPECT_EQ(states[0], states[1]);
    EXPECT_EQ(states[0], states[2]);
    LaidGround ground({sheet(3.0, 3.0)});
    const auto other = ground.grow(rules, {{1.0, 0.1, 1.0}, {2.0, 0.1, 2.2}}, 6, 2);
    EXPECT_NE(sim::stateHash(ground.world, other), states[0]);
  }
}

TEST(Diffusion, KeepsFeetApartAndTogether) {
  LaidGround ground({sheet(4.0, 4.0)});
  RuleSet rules = tufts();
  rules.diffusion.gap_max = {2.0};
  const sim::Growth growth = ground.grow(rules, {{2.0, 0.1, 2.0}}, 14);
  const auto& elements = growth.plants.front().elements;
  ASSERT_GT(elements.size(), 200u);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    double nearest = 1e9;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      if (k != i)
        nearest = std::min(nearest, glm::distance(elements[i].position_vx, elements[k].position_vx));
    }
    EXPECT_GE(nearest, 1.2 - 1e-6);
    EXPECT_LE(nearest, 2.0 + 1e-5);
  }
}

TEST(Diffusion, GoesAroundABallAndNotAroundTheEdgeOfABox) {
  sim::TiledMesh ball;
  ball.mesh = tests::sphereMesh({0, 0, 0}, 0.5, 24);
  ball.solid = true;
  LaidGround round({ball});
  const sim::Growth over = round.grow(tufts(), {{0, 0.6, 0}}, 40);
  const Vec3 middle = sim::voxelFromWorld(round.world.frame(), Vec3(0.0));
  double lowest = 0.0;
  for (const auto& element : over.plants.front().elements) {
    const Vec3 out = element.position_vx - middle;
    EXPECT_NEAR(glm::length(out) * kLaidVoxel_m, 0.5, 0.01);
    EXPECT_GT(glm::dot(element.y, glm::normalize(out)), 0.98) << "it stands on the ball";
    lowest = std::min(lowest, out.y);
  }
  EXPECT_LT(lowest * kLaidVoxel_m, -0.4);

  LaidGround edged({box({0, 0, 0}, {1, 0.5, 1}, "box")});
  const sim::Growth on_top = edged.grow(tufts(), {{0.5, 0.6, 0.5}}, 40);
  EXPECT_GT(elementsOf(on_top), 100u);
  for (const auto& element : on_top.plants.front().elements)
    EXPECT_NEAR(sim::worldFromVoxel(edged.world.frame(), element.position_vx).y, 0.5, 1e-6);
  RuleSet around = tufts();
  around.diffusion.bend_deg = 95.0;
  const sim::Growth over_edges = edged.grow(around, {{0.5, 0.6, 0.5}}, 40);
  EXPECT_TRUE(std::any_of(over_edges.plants.front().elements.begin(),
                          over_edges.plants.front().elements.end(),
                          [](const auto& element) { return element.y.y < 0.1; }));
}

TEST(Diffusion, LaysSlabsFlatOnASlopeAndABall) {
  LaidGround slope({sheet(3.0, 3.0, 1.5)});
  RuleSet rules = paving();
  const sim::Growth tilted = slope.grow(rules, {{1.5, 0.85, 1.5}});
  expectNoCrossing(tilted);
  const LaidMeasure measure = measured(slope, rules, tilted);
  EXPECT_GT(measure.covered_vx2, 0.8 * measure.surface_vx2);
  EXPECT_LT(measure.joints.deviation_vx, 1e-2);
  const Vec3 normal = glm::normalize(Vec3(0, 2, 1));
  for (const auto& element : tilted.plants.front().elements)
    EXPECT_GT(glm::dot(element.z, normal), 1.0 - 1e-9);

  sim::TiledMesh ball;
  ball.mesh = tests::sphereMesh({0, 0, 0}, 1.0, 60);
  ball.solid = true;
  LaidGround round({ball});
  rules.elements = {slab("small", 3.0, 3.0, 0.5)};
  const sim::Growth over = round.grow(rules, {{0, 1.1, 0}});
  expectNoCrossing(over);
  EXPECT_GT(elementsOf(over), 300u);
  const LaidMeasure of_ball = measured(round, rules, over);
  EXPECT_NEAR(of_ball.surface_vx2 * kLaidVoxel_m * kLaidVoxel_m, 4.0 * M_PI, 0.2);
  EXPECT_GT(of_ball.covered_vx2, 0.5 * of_ball.surface_vx2);
}

TEST(Diffusion, EndsWhereItsFillIsReached) {
  for (const double fill : {0.2, 0.5}) {
    LaidGround ground({sheet(4.0, 4.0)});
    RuleSet rules = paving();
    rules.diffusion.fill = fill;
    const sim::Growth growth = ground.grow(rules, {{2.0, 0.1, 2.0}});
    const LaidMeasure measure = measured(ground, rules, growth);
    EXPECT_NEAR(measure.covered_vx2 / measure.surface_vx2, fill, 0.02);
  }
}

TEST(Diffusion, LaysShinglesOverEachOther) {
  LaidGround roof({sheet(2.0, 2.0, 1.2)});
  RuleSet rules;
  rules.propagate = Propagate::diffusion;
  rules.diffusion.around = Around::steps;
  rules.diffusion.steps = {{0.25, 0}, {-0.25, 0}, {0.125, 0.2}, {-0.125, 0.2}, {0.125, -0.2}, {-0.125, -0.2}};
  rules.diffusion.ahead = Ahead::up;
  rules.diffusion.off = {2.0};
  rules.diffusion.rounds = 1000;
  Element shingle = slab("shingle", 6.0, 12.0, 0.2);
  shingle.polygons = {{{-3, 0, 1}, {3, 0, 1}, {3, 12, 0}, {-3, 12, 0}}};
  rules.elements = {shingle};
  const sim::Growth growth = roof.grow(rules, {{1.0, 0.7, 1.0}});
  expectNoCrossing(growth);
  EXPECT_GT(elementsOf(growth), 50u);
  double area_vx2 = 0.0;
  for (const auto& element : growth.plants.front().elements) {
    EXPECT_GT(element.y.y, 0.5) << "every one goes up the slope";
    area_vx2 += 72.0 * element.scale * element.scale;
  }
  const LaidMeasure measure = measured(roof, rules, growth);
  EXPECT_GT(measure.covered_vx2, 0.85 * measure.surface_vx2);
  EXPECT_GT(area_vx2, 1.4 * measure.covered_vx2) << "they overlap";
}

TEST(Diffusion, StaysWhereItsRegionsLetIt) {
  sim::TiledMesh two = sheet(4.0, 2.0);
  two.mesh.vertices_m = {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {0, 0, 2}, {2, 0, 2}, {4, 0, 2}};
  two.mesh.regions = {"bed", "path"};
  two.mesh.materials.push_back(two.mesh.materials.front());
  two.mesh.triangles.clear();
  two.mesh.region.clear();
  two.mesh.material.clear();
  tests::addTriangle(two.mesh, 0, 3, 4, 0);
  tests::addTriangle(two.mesh, 0, 4, 1, 0);
  tests::addTriangle(two.mesh, 1, 4, 5, 1);
  tests::addTriangle(two.mesh, 1, 5, 2, 1);
  for (RuleSet rules : {paving(), tufts()}) {
    LaidGround ground({two});
    rules.regions["bed"] = {true, nullptr};
    const sim::Growth growth = ground.grow(rules, {{3.0, 0.1, 1.0}}, 20);
    EXPECT_GT(elementsOf(growth), 20u);
    const double off_m = rules.diffusion.off.number * kLaidVoxel_m;
    for (const auto& corners : footprints(growth)) {
      for (const Vec3 corner : corners)
        EXPECT_GT(sim::worldFromVoxel(ground.world.frame(), corner).x, 2.0 - off_m);
    }
    for (const auto& element : growth.plants.front().elements)
      EXPECT_GT(sim::worldFromVoxel(ground.world.frame(), element.position_vx).x, 2.0 - 1e-6);
  }
}

TEST(Diffusion, TellsOfEachTrialOnce) {
  LaidGround ground({sheet(2.0, 2.0)});
  for (const RuleSet& rules : {paving(), tufts()}) {
    const sim::Growth growth = ground.grow(rules, {{1.0, 0.1, 1.0}}, 5, 1, true);
    const sim::Tally& tally = growth.tallies.front();
    std::uint64_t trials = 0;
    for (const std::uint64_t times : tally.trials) trials += times;
    std::size_t taken = 0;
    for (const sim::Attempt& attempt : growth.attempts) taken += attempt.taken ? 1 : 0;
    EXPECT_EQ(growth.attempts.size(), trials);
    EXPECT_EQ(taken, growth.plants.front().elements.size());
    ground = LaidGround({sheet(2.0, 2.0)});
  }
}

TEST(Diffusion, HasAStateThatTellsShapesApart) {
  const auto stateOf = [](double side_vx) {
    LaidGround ground({sheet(2.0, 2.0)});
    RuleSet rules = paving();
    rules.elements = {slab("tile", side_vx, side_vx, 0.1)};  // in no voxel but the ground's own
    rules.diffusion.rounds = 1;                              // one of them
    return sim::stateHash(ground.world, ground.grow(rules, {{1.0, 0.1, 1.0}}, 1));
  };
  EXPECT_EQ(stateOf(5.0), stateOf(5.0));
  EXPECT_NE(stateOf(5.0), stateOf(5.2));
}

TEST(Diffusion, SaysWhereASeedFindsNoSurface) {
  LaidGround ground({sheet(4.0, 4.0), box({1, 1.4, 1}, {2, 1.6, 2}, "shelf")});
  RuleSet rules = tufts();
  rules.regions["shelf"] = {true, nullptr};
  const sim::Growth growth = ground.grow(rules, {{1.5, 1.3, 1.5}});
  EXPECT_EQ(elementsOf(growth), 0u);
  EXPECT_EQ(sim::timesOf(growth.tallies.front().sites, sim::Outcome::too_far), 1u);
  EXPECT_THROW(makeProcess(std::make_shared<const RuleSet>(rules), ground.world.frame()), sim::InputError);
}

/// The lowest corner of all elements, voxel widths above y = 0.
double lowestCorner(const LaidGround& ground, const sim::Growth& growth) {
  double lowest = 1e9;
  for (const sim::Plant& plant : growth.plants) {
    for (const sim::PlacedElement& element : plant.elements) {
      for (const auto& polygon : plant.shapes[static_cast<std::size_t>(element.shape)].polygons) {
        for (const Vec3 corner : polygon) {
          const Vec3 at_m = sim::worldFromVoxel(ground.world.frame(), sim::placed(element, corner));
          lowest = std::min(lowest, at_m.y / kLaidVoxel_m);
        }
      }
    }
  }
  return lowest;
}

TEST(Diffusion, LiftsWhatLeansOrHangsOutOfTheGround) {
  LaidGround ground({sheet(3.0, 3.0)});
  RuleSet rules = paving();
  rules.diffusion.tilt_deg = 12.0;
  const sim::Growth tilted = ground.grow(rules, {{1.5, 0.1, 1.5}});
  EXPECT_GT(elementsOf(tilted), 20u);
  EXPECT_NEAR(lowestCorner(ground, tilted), 0.0, 1e-6);
  expectNoCrossing(tilted);
  LaidGround other({sheet(3.0, 3.0)});
  rules.diffusion.tilt_deg = 0.0;
  Element leaf = slab("leaf", 4.0, 4.0, 0.0);
  leaf.polygons = {{{-2, 0, -0.4}, {0, 0, 0}, {0, 4, 0}, {-2, 4, -0.4}},
                   {{0, 0, 0}, {2, 0, -0.4}, {2, 4, -0.4}, {0, 4, 0}}};
  rules.elements = {leaf};
  const sim::Growth folded = other.grow(rules, {{1.5, 0.1, 1.5}});
  EXPECT_GT(elementsOf(folded), 50u);
  EXPECT_GT(lowestCorner(other, folded), 0.0);
  EXPECT_LT(lowestCorner(other, folded), 0.1);
}

TEST(Diffusion, HasLengthsThatSuitTheVoxels) {
  LaidGround ground({sheet(2.0, 2.0)});
  RuleSet rules = paving();
  rules.diffusion.off = {1.0, true};
  try {
    ground.grow(rules, {{1.0, 0.1, 1.0}});
    FAIL();
  } catch (const sim::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("diffusion.off is 25 voxel widths"), std::string::npos)
        << error.what();
  }
  // Far beyond the world nothing lies, and to find that takes no time.
  rules = tufts();
  rules.diffusion.distance = Length{1000.0};
  EXPECT_EQ(elementsOf(ground.grow(rules, {{1.0, 0.1, 1.0}}, 2)), 1u);
  rules.elements.front().size = 900.0;
  EXPECT_THROW(ground.grow(rules, {{1.0, 0.1, 1.0}}, 2), sim::InputError);
}

TEST(Diffusion, GrowsByTheRulesOfTheLight) {
  LaidGround ground({sheet(3.0, 3.0), box({-0.2, 0, 0}, {0, 2.0, 3.0}, "wall")});
  RuleSet rules = tufts();
  rules.regions["wall"] = {true, nullptr};
  const auto farthest = [](LaidGround& on, const RuleSet& by) {
    const sim::Growth growth = on.grow(by, {{0.3, 0.1, 1.5}}, 30);
    double most = 0.0;
    for (const auto& element : growth.plants.front().elements)
      most = std::max(most, sim::worldFromVoxel(on.world.frame(), element.position_vx).x);
    return most;
  };
  LaidGround other(ground.meshes);
  EXPECT_GT(farthest(other, rules), 2.5);
  rules.light = {0.0, 1.0, 1.0};
  rules.require.exposure_max = 0.7;
  EXPECT_LT(farthest(ground, rules), 2.2) << "what shuns the light stays by the wall";
}

/// Every key of diffusion changes what is laid, and none does what another does.
TEST(Diffusion, FollowsEachOfItsKeys) {
  const auto stateOf = [](const RuleSet& rules) {
    LaidGround ground({sheet(2.0, 2.0, 0.4)});
    const sim::Growth growth = ground.grow(rules, {{1.0, 0.3, 1.0}}, 4);
    return sim::stateHash(ground.world, growth);
  };
  RuleSet plain = tufts();
  plain.diffusion.gap_min = {0.4};
  plain.diffusion.rounds = 2;
  plain.elements.push_back(slab("flat", 1.0, 0.7, 0.1));
  plain.elements.back().trials = 3;
  std::set<std::uint64_t> states{stateOf(plain)};
  const auto changes = [&](const char* what, const std::function<void(RuleSet&)>& change) {
    RuleSet rules = plain;
    change(rules);
    EXPECT_TRUE(states.insert(stateOf(rules)).second) << what << " changes nothing";
  };
  changes("ring", [](RuleSet& r) { r.diffusion.around = Around::ring; });
  changes("edges", [](RuleSet& r) { r.diffusion.around = Around::edges; });
  changes("steps", [](RuleSet& r) {
    r.diffusion.around = Around::steps;
    r.diffusion.steps = {{0.05, 0.0}, {0.0, 0.06}};
  });
  changes("distance", [](RuleSet& r) { r.diffusion.distance = Length{4.0}; });
  changes("gap.min", [](RuleSet& r) { r.diffusion.gap_min = {2.0}; });
  changes("gap.max", [](RuleSet& r) { r.diffusion.gap_max = {2.0}; });
  changes("turn", [](RuleSet& r) { r.diffusion.turn_deg = 20.0; });
  changes("turn_step", [](RuleSet& r) { r.diffusion.turn_step_deg = 90.0; });
  changes("ahead", [](RuleSet& r) { r.diffusion.ahead = Ahead::up; });
  changes("tilt", [](RuleSet& r) { r.diffusion.tilt_deg = 30.0; });
  changes("fill", [](RuleSet& r) { r.diffusion.fill = 0.01; });
  changes("rounds", [](RuleSet& r) { r.diffusion.rounds = 1; });
  changes("share", [](RuleSet& r) { r.elements.back().share = 9.0; });
  changes("trials", [](RuleSet& r) { r.elements.back().trials = 1; });
}

}  // namespace
}  // namespace espalier::rules
