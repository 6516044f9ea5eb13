#include "rules/growth/diffusion.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "rules/growth/laid_measure.h"
#include "rules/growth/make_process.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/grow/grow.h"
#include "sim/grow/pieces.h"
#include "sim/light/sky.h"
#include "tests/support/lively.h"
#include "tests/support/meshes.h"

namespace espalier::rules {
namespace {

using sim::Vec3;

constexpr double kVoxel_m = 0.04;

Element slab(const std::string& name, double width_vx, double depth_vx, double thick_vx = 1.0) {
  Element element;
  element.name = name;
  element.pose = Pose::surface;
  element.thick = {thick_vx};
  const double x = 0.5 * width_vx, y = 0.5 * depth_vx;
  element.polygons = {{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}};
  return element;
}

RuleSet paving() {
  RuleSet rules;
  rules.name = "paving";
  rules.propagate = Propagate::diffusion;
  rules.diffusion.around = Around::edges;
  rules.diffusion.gap_min = {0.2};
  rules.diffusion.rounds = 100'000;
  rules.elements = {slab("large", 15.4, 10.2), slab("middle", 10.2, 10.2), slab("small", 5.0, 5.0)};
  return rules;
}

RuleSet tufts() {
  RuleSet rules;
  rules.name = "tufts";
  rules.propagate = Propagate::diffusion;
  rules.diffusion.around = Around::gaussian;
  rules.diffusion.distance = Length{3.0};
  rules.diffusion.gap_min = {1.2};
  rules.diffusion.turn_deg = 180.0;
  Element tuft;
  tuft.name = "tuft";
  tuft.crosses = true;
  tuft.polygons = {{{-0.5, 0, 0}, {0.5, 0, 0}, {0, 1.5, 0.2}}};
  rules.elements = {tuft};
  return rules;
}

/// A mesh in a world with a margin of free voxels.
struct Ground {
  explicit Ground(std::vector<sim::TiledMesh> given)
      : meshes(std::move(given)),
        world(sim::buildWorld(sim::frameAround(meshes, kVoxel_m, 0.4), meshes, 4)),
        surface(sim::surfaceOf(world.frame(), meshes)) {}

  sim::Growth grow(const RuleSet& rules, const std::vector<Vec3>& seeds_m, int iterations = 40,
                   std::uint64_t seed = 1) {
    std::vector<Vec3> seeds_vx;
    for (const Vec3 at_m : seeds_m) seeds_vx.push_back(sim::voxelFromWorld(world.frame(), at_m));
    sim::GrowthSettings settings = tests::brightSettings(iterations);
    settings.seed = seed;
    const auto process = makeProcess(std::make_shared<const RuleSet>(rules), world.frame(), surface);
    return sim::grow(world, {{"laid", process, sim::seedsAt(world.frame(), seeds_vx)}}, settings);
  }

  std::vector<sim::TiledMesh> meshes;
  sim::World world;
  std::shared_ptr<const sim::SceneSurface> surface;
};

/// A sheet from (0, 0) to (width, depth) at y = 0.
sim::TiledMesh sheet(double width_m, double depth_m, double rise_m = 0.0) {
  sim::TiledMesh tiled;
  tiled.mesh = tests::emptyMesh("floor");
  tiled.mesh.vertices_m = {{0, rise_m, 0}, {width_m, rise_m, 0}, {width_m, 0, depth_m}, {0, 0, depth_m}};
  tests::addTriangle(tiled.mesh, 0, 2, 1);
  tests::addTriangle(tiled.mesh, 0, 3, 2);
  return tiled;
}

sim::TiledMesh box(Vec3 low, Vec3 high, const std::string& region) {
  sim::TiledMesh tiled;
  tiled.mesh = tests::boxMesh(low, high, region);
  tiled.mesh.regions = {region};
  tiled.solid = true;
  return tiled;
}

std::size_t elementsOf(const sim::Growth& growth) {
  std::size_t sum = 0;
  for (const sim::Plant& plant : growth.plants) sum += plant.elements.size();
  return sum;
}

std::vector<sim::LatticeTriangle> trianglesOf(const sim::Plant& plant, const sim::PlacedElement& element) {
  const sim::FacetShape shape =
      sim::facetShape(plant.shapes[static_cast<std::size_t>(element.shape)].polygons);
  sim::Facets facets;
  EXPECT_TRUE(sim::place(element, shape, facets));
  std::vector<sim::LatticeTriangle> triangles;
  for (const auto& t : shape.triangles)
    triangles.push_back({facets.corners[t[0]], facets.corners[t[1]], facets.corners[t[2]]});
  return triangles;
}

/// No polygon of one crosses a polygon of another: all against all, exactly.
void expectNoCrossing(const sim::Growth& growth) {
  std::vector<std::vector<sim::LatticeTriangle>> all;
  for (const sim::Plant& plant : growth.plants) {
    for (const sim::PlacedElement& element : plant.elements) all.push_back(trianglesOf(plant, element));
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      for (const auto& a : all[i]) {
        for (const auto& b : all[k]) ASSERT_FALSE(sim::cross(a, b)) << i << " crosses " << k;
      }
    }
  }
}

/// Corners of what lies flat, on its lower side, voxel space.
std::vector<std::vector<Vec3>> footprints(const sim::Growth& growth) {
  std::vector<std::vector<Vec3>> all;
  for (const sim::Plant& plant : growth.plants) {
    for (const sim::PlacedElement& element : plant.elements) {
      std::vector<Vec3> corners;
      for (const auto& polygon : plant.shapes[static_cast<std::size_t>(element.shape)].polygons) {
        for (const Vec3 corner : polygon) {
          if (corner.z == 0.0) corners.push_back(sim::placed(element, corner));
        }
      }
      all.push_back(std::move(corners));
    }
  }
  return all;
}

LaidMeasure measured(const Ground& ground, const RuleSet& rules, const sim::Growth& growth) {
  return measureLaid(std::make_shared<const RuleSet>(rules), growth.plants, ground.surface, ground.world);
}

TEST(Paving, FillsAFloorAroundWhatStandsThere) {
  Ground ground({sheet(5.0, 4.0), box({1.03, 0, 0.9}, {2.1, 0.2, 1.77}, "kerb"),
                 box({3.2, 0, 2.5}, {4.11, 0.3, 3.4}, "kerb")});
  RuleSet rules = paving();
  rules.regions["kerb"] = {true, nullptr};
  const sim::Growth growth = ground.grow(rules, {{2.6, 0.1, 2.0}});
  expectNoCrossing(growth);
  const LaidMeasure measure = measured(ground, rules, growth);
  const double beds_m2 = 1.07 * 0.87 + 0.91 * 0.9;
  EXPECT_NEAR(measure.surface_vx2 * kVoxel_m * kVoxel_m, 20.0 - beds_m2, 0.5);
  EXPECT_GT(measure.covered_vx2, 0.8 * measure.surface_vx2);
  EXPECT_NEAR(measure.joints.mean_vx, 0.2, 0.02);
  EXPECT_LT(measure.joints.deviation_vx, 0.05);
  EXPECT_GT(measure.joints.length_vx, 0.6 * measure.joints.rims_vx);
  // Nothing in the kerbs or over the edge; every slab on the floor.
  const sim::Frame& frame = ground.world.frame();
  for (const auto& corners : footprints(growth)) {
    for (const Vec3 corner : corners) {
      const Vec3 at_m = sim::worldFromVoxel(frame, corner);
      const double off_m = rules.diffusion.off.number * kVoxel_m + 1e-9;
      EXPECT_NEAR(at_m.y, 0.0, 1e-6);
      EXPECT_TRUE(at_m.x > -off_m && at_m.x < 5.0 + off_m && at_m.z > -off_m && at_m.z < 4.0 + off_m);
      EXPECT_FALSE(at_m.x > 1.031 && at_m.x < 2.099 && at_m.z > 0.901 && at_m.z < 1.769);
    }
  }
}

TEST(Paving, LeavesTheSameJointEverywhere) {
  Ground ground({sheet(4.0, 4.0)});
  const RuleSet rules = paving();
  const sim::Growth growth = ground.grow(rules, {{2.0, 0.1, 2.0}});
  const auto feet = footprints(growth);
  double least = 1e9;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const auto flat = [](const std::vector<Vec3>& corners) {
        std::vector<glm::dvec2> points;
        for (const Vec3 c : corners) points.emplace_back(c.x, c.z);
        return hullOf(points);
      };
      least = std::min(least, distance(flat(feet[i]), flat(feet[k])));
    }
  }
  EXPECT_NEAR(least, 0.2, 3e-5);
  const LaidMeasure measure = measured(ground, rules, growth);
  EXPECT_NEAR(measure.joints.mean_vx, 0.2, 1e-4);
  EXPECT_LT(measure.joints.deviation_vx, 1e-3);
  EXPECT_GT(measure.covered_vx2, 0.85 * measure.surface_vx2);
}

TEST(Diffusion, IsTheSameOnAnyNumberOfThreads) {
  for (const RuleSet& rules : {paving(), tufts()}) {
    std::vector<std::uint64_t> states;
    for (const int threads : {1, 2, 5}) {
      sim::onThreads(threads, [&] {
        Ground ground({sheet(3.0, 3.0)});
        const sim::Growth growth = ground.grow(rules, {{1.0, 0.1, 1.0}, {2.0, 0.1, 2.2}}, 6);
        EXPECT_GT(elementsOf(growth), 50u);
        states.push_back(sim::stateHash(ground.world, growth));
      });
    }
    EXPECT_EQ(states[0], states[1]);
    EXPECT_EQ(states[0], states[2]);
    Ground ground({sheet(3.0, 3.0)});
    const auto other = ground.grow(rules, {{1.0, 0.1, 1.0}, {2.0, 0.1, 2.2}}, 6, 2);
    EXPECT_NE(sim::stateHash(ground.world, other), states[0]);
  }
}

TEST(Diffusion, KeepsFeetApartAndTogether) {
  Ground ground({sheet(4.0, 4.0)});
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
  Ground round({ball});
  const sim::Growth over = round.grow(tufts(), {{0, 0.6, 0}}, 40);
  const Vec3 middle = sim::voxelFromWorld(round.world.frame(), Vec3(0.0));
  double lowest = 0.0;
  for (const auto& element : over.plants.front().elements) {
    const Vec3 out = element.position_vx - middle;
    EXPECT_NEAR(glm::length(out) * kVoxel_m, 0.5, 0.01);
    EXPECT_GT(glm::dot(element.y, glm::normalize(out)), 0.98) << "it stands on the ball";
    lowest = std::min(lowest, out.y);
  }
  EXPECT_LT(lowest * kVoxel_m, -0.4);

  Ground edged({box({0, 0, 0}, {1, 0.5, 1}, "box")});
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
  Ground slope({sheet(3.0, 3.0, 1.5)});
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
  Ground round({ball});
  rules.elements = {slab("small", 3.0, 3.0, 0.5)};
  const sim::Growth over = round.grow(rules, {{0, 1.1, 0}});
  expectNoCrossing(over);
  EXPECT_GT(elementsOf(over), 300u);
  const LaidMeasure of_ball = measured(round, rules, over);
  EXPECT_NEAR(of_ball.surface_vx2 * kVoxel_m * kVoxel_m, 4.0 * M_PI, 0.2);
  EXPECT_GT(of_ball.covered_vx2, 0.5 * of_ball.surface_vx2);
}

TEST(Diffusion, EndsWhereItsFillIsReached) {
  for (const double fill : {0.2, 0.5}) {
    Ground ground({sheet(4.0, 4.0)});
    RuleSet rules = paving();
    rules.diffusion.fill = fill;
    const sim::Growth growth = ground.grow(rules, {{2.0, 0.1, 2.0}});
    const LaidMeasure measure = measured(ground, rules, growth);
    EXPECT_NEAR(measure.covered_vx2 / measure.surface_vx2, fill, 0.02);
  }
}

TEST(Diffusion, LaysShinglesOverEachOther) {
  Ground roof({sheet(2.0, 2.0, 1.2)});
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
    Ground ground({two});
    rules.regions["bed"] = {true, nullptr};
    const sim::Growth growth = ground.grow(rules, {{3.0, 0.1, 1.0}}, 20);
    EXPECT_GT(elementsOf(growth), 20u);
    const double off_m = rules.diffusion.off.number * kVoxel_m;
    for (const auto& corners : footprints(growth)) {
      for (const Vec3 corner : corners)
        EXPECT_GT(sim::worldFromVoxel(ground.world.frame(), corner).x, 2.0 - off_m);
    }
    for (const auto& element : growth.plants.front().elements)
      EXPECT_GT(sim::worldFromVoxel(ground.world.frame(), element.position_vx).x, 2.0 - 1e-6);
  }
}

TEST(Paving, GoesOnOverSeams) {
  // Two boxes side by side, in one plane: their sides are no walls, and their rims no end.
  Ground ground({box({0, -0.2, 0}, {2, 0, 1.5}, "floor"), box({0.4, -0.2, 1.5}, {1.6, 0, 3}, "floor")});
  const RuleSet rules = paving();
  const sim::Growth growth = ground.grow(rules, {{1.0, 0.1, 0.7}});
  const LaidMeasure measure = measured(ground, rules, growth);
  EXPECT_GT(measure.covered_vx2, 0.75 * measure.surface_vx2);
  bool across = false;
  for (const auto& corners : footprints(growth)) {
    double low = 1e9, high = -1e9;
    for (const Vec3 corner : corners) {
      const double z = sim::worldFromVoxel(ground.world.frame(), corner).z;
      low = std::min(low, z);
      high = std::max(high, z);
    }
    across = across || (low < 1.45 && high > 1.55);
  }
  EXPECT_TRUE(across);
}

TEST(Diffusion, SaysWhereASeedFindsNoSurface) {
  Ground ground({sheet(4.0, 4.0), box({1, 1.4, 1}, {2, 1.6, 2}, "shelf")});
  RuleSet rules = tufts();
  rules.regions["shelf"] = {true, nullptr};
  const sim::Growth growth = ground.grow(rules, {{1.5, 1.3, 1.5}});
  EXPECT_EQ(elementsOf(growth), 0u);
  EXPECT_EQ(sim::timesOf(growth.tallies.front().sites, sim::Outcome::too_far), 1u);
  EXPECT_THROW(makeProcess(std::make_shared<const RuleSet>(rules), ground.world.frame()), sim::InputError);
}

TEST(Diffusion, HasLengthsThatSuitTheVoxels) {
  Ground ground({sheet(2.0, 2.0)});
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
  Ground ground({sheet(3.0, 3.0), box({-0.2, 0, 0}, {0, 2.0, 3.0}, "wall")});
  RuleSet rules = tufts();
  rules.regions["wall"] = {true, nullptr};
  const auto farthest = [](Ground& on, const RuleSet& by) {
    const sim::Growth growth = on.grow(by, {{0.3, 0.1, 1.5}}, 30);
    double most = 0.0;
    for (const auto& element : growth.plants.front().elements)
      most = std::max(most, sim::worldFromVoxel(on.world.frame(), element.position_vx).x);
    return most;
  };
  Ground other(ground.meshes);
  EXPECT_GT(farthest(other, rules), 2.5);
  rules.light = {0.0, 1.0, 1.0};
  rules.require.exposure_max = 0.7;
  EXPECT_LT(farthest(ground, rules), 2.2) << "what shuns the light stays by the wall";
}

/// Every key of diffusion changes what is laid, and none does what another does.
TEST(Diffusion, FollowsEachOfItsKeys) {
  const auto stateOf = [](const RuleSet& rules) {
    Ground ground({sheet(2.0, 2.0, 0.4)});
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
