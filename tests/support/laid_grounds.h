#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <vector>

#include "rules/growth/laid_measure.h"
#include "rules/growth/make_process.h"
#include "sim/base/error.h"
#include "sim/grow/grow.h"
#include "sim/grow/pieces.h"
#include "tests/support/lively.h"
#include "tests/support/meshes.h"

/// Grounds on which elements are laid, and what may be said of what lies there.
namespace espalier::tests {

inline constexpr double kLaidVoxel_m = 0.04;

inline rules::Element slab(const std::string& name, double width_vx, double depth_vx, double thick_vx = 1.0) {
  rules::Element element;
  element.name = name;
  element.pose = rules::Pose::surface;
  element.thick = {thick_vx};
  const double x = 0.5 * width_vx, y = 0.5 * depth_vx;
  element.polygons = {{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}};
  return element;
}

inline rules::RuleSet paving() {
  rules::RuleSet rules;
  rules.name = "paving";
  rules.propagate = rules::Propagate::diffusion;
  rules.diffusion.around = rules::Around::edges;
  rules.diffusion.gap_min = {0.2};
  rules.diffusion.rounds = 100'000;
  rules.elements = {slab("large", 15.4, 10.2), slab("middle", 10.2, 10.2), slab("small", 5.0, 5.0)};
  return rules;
}

inline rules::RuleSet tufts() {
  rules::RuleSet rules;
  rules.name = "tufts";
  rules.propagate = rules::Propagate::diffusion;
  rules.diffusion.around = rules::Around::gaussian;
  rules.diffusion.distance = rules::Length{3.0};
  rules.diffusion.gap_min = {1.2};
  rules.diffusion.turn_deg = 180.0;
  rules::Element tuft;
  tuft.name = "tuft";
  tuft.crosses = true;
  tuft.polygons = {{{-0.5, 0, 0}, {0.5, 0, 0}, {0, 1.5, 0.2}}};
  rules.elements = {tuft};
  return rules;
}

/// A mesh in a world with a margin of free voxels.
struct LaidGround {
  explicit LaidGround(const std::vector<sim::TiledMesh>& given)
      : LaidGround(given, sim::frameAround(given, kLaidVoxel_m, 0.4)) {}
  LaidGround(std::vector<sim::TiledMesh> given, const sim::Frame& frame)
      : meshes(std::move(given)),
        world(sim::buildWorld(frame, meshes, 4)),
        surface(sim::surfaceOf(world.frame(), meshes)) {}

  sim::Growth grow(const rules::RuleSet& rules, const std::vector<Vec3>& seeds_m, int iterations = 40,
                   std::uint64_t seed = 1, bool record_attempts = false) {
    std::vector<Vec3> seeds_vx;
    for (const Vec3 at_m : seeds_m) seeds_vx.push_back(sim::voxelFromWorld(world.frame(), at_m));
    sim::GrowthSettings settings = brightSettings(iterations);
    settings.seed = seed;
    settings.record_attempts = record_attempts;
    const auto process =
        rules::makeProcess(std::make_shared<const rules::RuleSet>(rules), world.frame(), surface);
    return sim::grow(world, {{"laid", process, sim::seedsAt(world.frame(), seeds_vx)}}, settings);
  }

  std::vector<sim::TiledMesh> meshes;
  sim::World world;
  std::shared_ptr<const sim::SceneSurface> surface;
};

/// A sheet from (0, 0) to (width, depth) at y = 0.
inline sim::TiledMesh sheet(double width_m, double depth_m, double rise_m = 0.0) {
  sim::TiledMesh tiled;
  tiled.mesh = emptyMesh("floor");
  tiled.mesh.vertices_m = {{0, rise_m, 0}, {width_m, rise_m, 0}, {width_m, 0, depth_m}, {0, 0, depth_m}};
  addTriangle(tiled.mesh, 0, 2, 1);
  addTriangle(tiled.mesh, 0, 3, 2);
  return tiled;
}

inline sim::TiledMesh box(Vec3 low, Vec3 high, const std::string& region) {
  sim::TiledMesh tiled;
  tiled.mesh = boxMesh(low, high, region);
  tiled.mesh.regions = {region};
  tiled.solid = true;
  return tiled;
}

inline std::size_t elementsOf(const sim::Growth& growth) {
  std::size_t sum = 0;
  for (const sim::Plant& plant : growth.plants) sum += plant.elements.size();
  return sum;
}

inline std::vector<sim::LatticeTriangle> trianglesOf(const sim::Plant& plant,
                                                     const sim::PlacedElement& element) {
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
inline void expectNoCrossing(const sim::Growth& growth) {
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
inline std::vector<std::vector<Vec3>> footprints(const sim::Growth& growth) {
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

inline rules::LaidMeasure measured(const LaidGround& ground, const rules::RuleSet& rules,
                                   const sim::Growth& growth) {
  return rules::measureLaid(std::make_shared<const rules::RuleSet>(rules), growth.plants, ground.surface,
                            ground.world);
}

}  // namespace espalier::tests
