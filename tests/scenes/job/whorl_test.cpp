#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <stdexcept>

#include "scenes/prepare/plantings.h"
#include "scenes/read/read_scene.h"
#include "sim/grow/grow.h"
#include "tests/support/scratch.h"

/// What spreads over a closed body from a core, as figure 20 of Tanaka et al. 2022 has it, winds about the
/// core by more the more its field turns.
namespace espalier::scenes {
namespace {

using sim::Vec3;

struct Body {
  std::string mesh;
  Vec3 core_m;    ///< on its surface
  Vec3 out{0.0};  ///< unit: the surface's normal there
  int seed = 1;
  double voxel_m = 0.02;
};

void PrintTo(const Body& body, std::ostream* out) {
  *out << body.mesh << ", seed " << body.seed << ", voxel " << body.voxel_m << " m";
}

sim::Plant spread(const Body& body, double angle_deg) {
  const tests::Scratch scratch;
  const std::string text = fmt::format(
      "espalier: scene\nseed: {}\niterations: 200\nworld: {{voxel: {} m, margin: 10 cm}}\n"
      "meshes: [{{file: {}, name: body, guide: true}}]\n"
      "attractors: {{on: {{surface: body, count: 700}}}}\n"
      "fields: {{turn: {{axis: node_normal, angle: {}, strength: 2}}}}\n"
      "plants: [{{rules: {{propagate: colonization, colonization: {{attractors: on, fields: [turn], "
      "branching: {{angle: {{min: 50}}}}}}}}, seeds: [[{}, {}, {}]]}}]\n",
      body.seed, body.voxel_m, (tests::sourceFolder() / "scenes/meshes" / body.mesh).string(), angle_deg,
      body.core_m.x, body.core_m.y, body.core_m.z);
  auto scene = readScene(scratch.write("body.yaml", text));
  if (!scene) throw std::runtime_error(format(scene.problems()));
  Site site = makeSite(*scene);
  const auto plantings = makePlantings(*scene, site);
  const auto settings = growthSettings(*scene, site, attractorsOf(*scene, site));
  return sim::grow(site.world, plantings, settings).plants.at(0);
}

/// Mean over its tips of the degrees by which the way from the core to there goes round the core.
double winding(const sim::Plant& plant, Vec3 out) {
  const auto& nodes = plant.skeleton.position_vx;
  const auto flat = [&](std::size_t n) {
    const Vec3 from_core = nodes[n] - nodes[0];
    return from_core - glm::dot(from_core, out) * out;
  };
  std::vector<double> wound(nodes.size(), 0.0);
  std::vector<bool> tip(nodes.size(), true);
  for (std::size_t n = 1; n < nodes.size(); ++n) {
    const auto parent = static_cast<std::size_t>(plant.skeleton.parent[n]);
    tip[parent] = false;
    const Vec3 a = flat(parent), b = flat(n);
    const double turn = std::atan2(glm::dot(out, glm::cross(a, b)), glm::dot(a, b));
    // At the core itself there is no telling.
    wound[n] = wound[parent] + (glm::length(a) > 2.0 && glm::length(b) > 2.0 ? turn : 0.0);
  }
  double sum = 0.0;
  int tips = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (!tip[n]) continue;
    sum += wound[n];
    ++tips;
  }
  EXPECT_GT(tips, 60);
  return sum / tips * 180.0 / std::numbers::pi;
}

class Whorl : public testing::TestWithParam<Body> {};

TEST_P(Whorl, WindsMoreTheMoreItsFieldTurns) {
  std::vector<double> wound;
  for (const double angle : {0.0, 120.0, 360.0, 720.0})
    wound.push_back(winding(spread(GetParam(), angle), GetParam().out));
  fmt::print("wound by {:.0f} degrees\n", fmt::join(wound, ", "));
  EXPECT_NEAR(wound[0], 0.0, 15.0);
  EXPECT_GT(wound[1], wound[0] + 20.0);
  EXPECT_GT(wound[2], wound[1] + 20.0);
  EXPECT_GT(wound[3], wound[2] + 5.0);
}

const Body kBall{"bubble.obj", {0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}};
const Body kWren{"wren.obj", {0.02, 0.0, 0.27}, {0.0, 0.0, 1.0}};

Body with(Body body, int seed, double finer = 1.0) {
  body.seed = seed;
  body.voxel_m /= finer;
  return body;
}

INSTANTIATE_TEST_SUITE_P(All, Whorl,
                         testing::Values(kBall, with(kBall, 7), with(kBall, 1, 0.7), kWren,
                                         with(kWren, 7, 0.7)));

}  // namespace
}  // namespace espalier::scenes
