#include "scenes/show/graph_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "rules/growth/front_memory.h"
#include "scenes/show/flat_pictures.h"
#include "scenes/show/growth_graph.h"
#include "sim/base/parallel.h"
#include "tests/support/colonies.h"
#include "tests/support/lively.h"
#include "tests/support/meshes.h"
#include "tests/support/messages.h"
#include "tests/support/plots.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;

/// Two trees that share a crown, and a vine.
sim::Growth grown(sim::World& world, int iterations, bool onto = false) {
  rules::RuleSet tree = tests::tree();
  tree.colonization.onto = onto;
  std::vector<sim::Planting> plantings = tests::planting(world, tree, {{22, 4, 32}, {44, 4, 32}}, "tree");
  plantings.push_back(tests::planting(world, tests::lively(), {{32, 2, 50}}, "vine").front());
  return sim::grow(world, plantings,
                   tests::settings(tests::inBox(21, 500, {32, 42, 32}, {18, 14, 18}), iterations));
}

sim::World open() {
  sim::World world = tests::open();
  tests::addBox(world, "ground", {0, 0, 0}, {63, 0, 63});
  world.setLayers(4);
  return world;
}

using Place = std::array<double, 3>;
std::vector<Place> sorted(const std::vector<render::SpacePoint>& points) {
  std::vector<Place> places;
  for (const auto& point : points) places.push_back({point.at_m.x, point.at_m.y, point.at_m.z});
  std::sort(places.begin(), places.end());
  return places;
}

TEST(GrowthGraph, ShowsOfAFinishedGrowthWhatStoodAfterEachIteration) {
  for (const bool onto : {false, true}) {
    sim::World world = open();
    const sim::Growth all = grown(world, 200, onto);
    const GrowthGraph whole = growthGraph(all, world.frame());
    EXPECT_EQ(whole.sets, "crown, 500");
    for (const int iterations : {1, 4, 9, 17, 200}) {
      sim::World other = open();
      const sim::Growth part = grown(other, iterations, onto);
      const render::PointGraph then = graphAfter(growthGraph(part, other.frame()), iterations);
      const render::PointGraph now = graphAfter(whole, iterations);
      ASSERT_EQ(now.nodes.size(), then.nodes.size()) << iterations;
      for (std::size_t i = 0; i < now.nodes.size(); ++i) {
        EXPECT_EQ(now.nodes[i].parent, then.nodes[i].parent);
        EXPECT_EQ(now.nodes[i].point.at_m, then.nodes[i].point.at_m);
      }
      EXPECT_EQ(sorted(now.waiting), sorted(then.waiting)) << iterations;
      EXPECT_EQ(sorted(now.ended), sorted(then.ended)) << iterations;
    }
    const render::PointGraph end = graphAfter(whole, all.iterations);
    EXPECT_EQ(end.waiting.size(), 0u);
    EXPECT_EQ(end.ended.size() < 400u, onto) << "those on which a node stands are no points of their own";
    EXPECT_GT(end.nodes.size(), 400u);
    const render::PointGraph beginning = graphAfter(whole, 0);
    EXPECT_EQ(beginning.nodes.size(), 3u);
    EXPECT_EQ(beginning.waiting.size(), 500u);
  }
}

TEST(GrowthGraph, OfAttractorsThatNobodyAskedForShowsThemAllWaiting) {
  sim::Growth growth;
  sim::column<Vec3>(growth.commons[rules::attractorsNamed("a")], rules::kAttractorPlace) = {{1, 2, 3}};
  sim::column<Vec3>(growth.commons[rules::attractorsNamed("b")], rules::kAttractorPlace) = {{1, 2, 4},
                                                                                            {1, 2, 5}};
  growth.commons["field wind"];
  const GrowthGraph whole = growthGraph(growth, {Vec3(1.0), 0.5, {8, 8, 8}});
  EXPECT_EQ(whole.sets, "a, 1; b, 2");
  const render::PointGraph graph = graphAfter(whole, 3);
  ASSERT_EQ(graph.waiting.size(), 3u);
  EXPECT_EQ(graph.waiting[0].at_m, Vec3(1.5, 2.0, 2.5));
  for (const char* more : {"c", "d"})
    sim::column<Vec3>(growth.commons[rules::attractorsNamed(more)], rules::kAttractorPlace) = {{1, 2, 6}};
  EXPECT_EQ(growthGraph(growth, {Vec3(1.0), 0.5, {8, 8, 8}}).sets, "5 in 4 sets") << "no legend is so wide";
}

/// Trees behind a wall.
class GraphPicture : public testing::Test {
 protected:
  GraphPicture() {
    tests::addBox(world_, "wall", {0, 1, 40}, {63, 30, 42});
    bare_ = world_.occupied();
    growth_ = grown(world_, 60);
    growth_.plants.pop_back();  // the vine is before the wall
    wanted_.width_px = 160;
    wanted_.height_px = 120;
    wanted_.cameras.push_back({"main", {{1.6, 1.8, 6.5}, {1.6, 1.5, 1.6}, 40}});
  }
  render::Image draw(ImageKind kind, std::optional<int> iteration = std::nullopt) {
    ImageSpec image;
    image.kind = kind;
    image.iteration = iteration;
    wanted_.images = {image};
    GraphPictures pictures(wanted_, finished_);
    return pictures.draw(image, wanted_.cameras[0].camera);
  }

  sim::World world_ = open();
  sim::BitVolume bare_;
  sim::Growth growth_;
  PicturesWanted wanted_;
  const std::vector<sim::TiledMesh> no_meshes_ = {};
  const std::vector<render::PlantModel> no_models_ = {};
  const sim::Lighting no_light_ = {};
  const Finished finished_{no_meshes_, world_, bare_, growth_, no_light_, no_models_};
};

TEST_F(GraphPicture, FollowsKindAndIteration) {
  const render::Image end = draw(ImageKind::graph);
  sim::onThreads(3, [&] { EXPECT_EQ(draw(ImageKind::graph).pixels, end.pixels); });
  EXPECT_EQ(draw(ImageKind::graph, growth_.iterations + 7).pixels, end.pixels);
  EXPECT_NE(draw(ImageKind::graph, 8).pixels, end.pixels);
  EXPECT_NE(draw(ImageKind::points).pixels, end.pixels);
  EXPECT_NE(draw(ImageKind::points, 8).pixels, draw(ImageKind::points).pixels);
}

TEST_F(GraphPicture, WhatStandsBehindAWallIsFaint) {
  wanted_.width_px = 480;
  wanted_.height_px = 360;
  const render::Projection projection(wanted_.cameras[0].camera, 480, 360);
  const int top = static_cast<int>(projection.pixel({1.6, 30.5 * 0.05, 42.5 * 0.05}).y);
  // How much plants and attractors change above the wall's top and below it, clear of the legend.
  const auto changes = [&] {
    const render::Image drawn = draw(ImageKind::graph, 40);
    sim::Growth none;
    none.iterations = growth_.iterations;
    std::swap(none, growth_);
    const render::Image ground = draw(ImageKind::graph, 40);
    std::swap(none, growth_);
    std::array<double, 2> sums{};
    for (int y = 0; y < 360; ++y) {
      for (int x = 180; x < 300; ++x)
        sums[y < top - 3 ? 0 : 1] += std::abs(static_cast<double>(*drawn.at(x, y) - *ground.at(x, y)));
    }
    return sums;
  };
  const auto [above, below] = changes();
  bare_ = open().occupied();
  const auto [open_above, open_below] = changes();
  EXPECT_GT(open_above, 100.0);
  EXPECT_GT(open_below, 100.0);
  EXPECT_NEAR(above, open_above, 0.02 * open_above);
  EXPECT_LT(below, 0.3 * open_below);
  EXPECT_GT(below, 0.02 * open_below);
}

TEST(NarrowBandPicture, IsOfTheMeshThatIsNamed) {
  const std::vector<sim::TiledMesh> meshes = {{tests::sphereMesh(Vec3(1.5), 0.9, 20, "ball"), true},
                                              {tests::boxMesh(Vec3(0.5), Vec3(2.5), "box"), true}};
  const sim::Frame frame{Vec3(0.05), 0.1, {30, 30, 30}};
  ImageSpec image;
  image.name = "band";
  image.kind = ImageKind::narrow_band;
  image.axis = 'z';
  image.at_m = 1.5;
  const render::Image first = drawNarrowBand(meshes, frame, image);
  image.mesh = "ball";
  EXPECT_EQ(drawNarrowBand(meshes, frame, image).pixels, first.pixels);
  image.mesh = "box";
  EXPECT_NE(drawNarrowBand(meshes, frame, image).pixels, first.pixels);
  image.at_m = 8.0;
  EXPECT_EQ(tests::messageOf([&] { drawNarrowBand(meshes, frame, image); }),
            "image 'band': a cut at z = 8 m misses the world");
  image.at_m = 1.5;
  const sim::Frame fine{Vec3(0.0), 3e-5, {30, 30, 60'000}};
  const std::string message = tests::messageOf([&] { drawNarrowBand(meshes, fine, image); });
  EXPECT_NE(message.find("the level set of 'box' in voxels of 3e-05 m takes "), std::string::npos) << message;
}

}  // namespace
}  // namespace espalier::scenes
