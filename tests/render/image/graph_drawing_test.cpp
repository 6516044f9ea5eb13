#include "render/image/graph_drawing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/voxels/pale_scene.h"
#include "tests/support/golden.h"
#include "tests/support/little_garden.h"

namespace espalier::render {
namespace {

using sim::Vec3;

const Camera kAtTheTree{{0.0, 2.0, 9.0}, {0.0, 2.0, 0.0}, 36.0};

Image white(int width = 200, int height = 150) {
  return Image(width, height, 3, 1.0f);
}

SpaceNode node(Vec3 at, std::int32_t parent = -1) {
  return {{at}, parent};
}

/// A tree that forks in threes, and points around its crown, every third of which has ended.
PointGraph tree() {
  PointGraph graph;
  graph.nodes.push_back(node({0, 0, 0}));
  struct Tip {
    std::int32_t node;
    Vec3 along;
    int level;
  };
  std::vector<Tip> tips = {{0, {0, 1, 0}, 0}};
  while (!tips.empty()) {
    const Tip tip = tips.back();
    tips.pop_back();
    std::int32_t last = tip.node;
    const double step = 0.26 * std::pow(0.8, tip.level);
    for (int i = 0; i < 4; ++i) {
      const Vec3 at = graph.nodes[static_cast<std::size_t>(last)].point.at_m + step * tip.along;
      graph.nodes.push_back(node(at, last));
      last = static_cast<std::int32_t>(graph.nodes.size()) - 1;
    }
    if (tip.level == 4) continue;
    const Vec3 side = glm::normalize(glm::cross(tip.along, Vec3(0.3, 0.2, 1.0)));
    const Vec3 other = glm::cross(tip.along, side);
    for (int k = 0; k < 3; ++k) {
      const double turn = 2.0 * std::numbers::pi * (k + 0.3 * tip.level) / 3.0;
      const Vec3 aside = std::cos(turn) * side + std::sin(turn) * other;
      tips.push_back({last, glm::normalize(tip.along + 0.7 * aside), tip.level + 1});
    }
  }
  for (int i = 0; i < 400; ++i) {
    const double y = 1.0 - 2.0 * (i + 0.5) / 400, turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - y * y);
    const Vec3 at = Vec3(0, 2.6, 0) + 1.9 * Vec3(r * std::cos(turn), y, r * std::sin(turn));
    (i % 3 == 0 ? graph.ended : graph.waiting).push_back({at});
  }
  return graph;
}

TEST(Projection, IsTheOtherWayOfTheRays) {
  for (const Camera& camera :
       {kAtTheTree, Camera{{3, 1, -2}, {0, 5, 1}, 70.0}, Camera{{1, 9, 1}, {1, 0, 1}, 50.0}}) {
    const CameraRays rays(camera, 320.0 / 200.0);
    const Projection projection(camera, 320, 200);
    for (const glm::dvec2 at : {glm::dvec2(0.5, 0.5), glm::dvec2(0.1, 0.8), glm::dvec2(0.97, 0.03)}) {
      const Vec3 place = camera.eye_m + 4.0 * rays.direction(at.x, at.y);
      const glm::vec2 pixel = projection.pixel(place);
      EXPECT_NEAR(pixel.x, 320 * at.x, 1e-3);
      EXPECT_NEAR(pixel.y, 200 * at.y, 1e-3);
      EXPECT_GT(projection.depth_m(place), 0.0);
      EXPECT_LT(projection.depth_m(camera.eye_m - rays.direction(at.x, at.y)), 0.0);
    }
  }
  const Projection projection(kAtTheTree, 320, 200);
  const glm::vec2 a = projection.pixel({0, 2, 0}), b = projection.pixel({1, 2, 0});
  EXPECT_NEAR(projection.pixelsAt(9.0), b.x - a.x, 1e-3);
}

/// The colour in the middle.
sim::Colour middle(const Image& image) {
  const float* p = image.at(image.width / 2, image.height / 2);
  return {p[0], p[1], p[2]};
}

TEST(GraphDrawing, WhatIsNearLiesOverWhatIsFar) {
  const GraphSizes sizes{.point_m = 1.0, .nearest_m = 8.0, .farthest_m = 10.0};
  PointGraph graph;
  graph.nodes = {node({0, 2, -1})};
  graph.waiting = {{{0, 2, 1}}};
  Image image = white();
  drawPoints(image, graph, kAtTheTree, sizes);
  EXPECT_GT(middle(image).b, middle(image).r + 0.2f);
  std::swap(graph.nodes[0].point.at_m, graph.waiting[0].at_m);
  image = white();
  drawPoints(image, graph, kAtTheTree, sizes);
  EXPECT_GT(middle(image).r, middle(image).b + 0.2f);
}

/// How much of a white picture is blackened, in pixels of black.
double blackened(const Image& image) {
  double sum = 0.0;
  for (const float v : image.pixels) sum += 1.0 - static_cast<double>(v);
  return sum / 3.0;
}

TEST(GraphDrawing, SizesFollowTheDistanceButForALeast) {
  const auto coverage = [](double z, double size) {
    PointGraph graph;
    graph.waiting = {{{0, 2, z}}};
    Image image = white();
    drawPoints(image, graph, kAtTheTree, {.point_m = size, .nearest_m = 1.0, .farthest_m = 1e9});
    return blackened(image);
  };
  EXPECT_NEAR(coverage(4.5, 0.6) / coverage(0.0, 0.6), 4.0, 0.5);  // half as far
  EXPECT_GT(coverage(0.0, 1e-6), 0.3);
  EXPECT_EQ(coverage(9.5, 0.6), 0.0);  // behind the eye
}

TEST(GraphDrawing, LinesThatPassTheEyeAreCutOff) {
  PointGraph graph;
  graph.nodes = {node({0, 1, 0}), node({0.2, 2.3, 30}, 0)};
  Image image = white();
  drawGraph(image, graph, kAtTheTree, {.twig_m = 0.05, .nearest_m = 1.0, .farthest_m = 10.0});
  EXPECT_GT(blackened(image), 30.0);
  for (const float v : image.pixels) ASSERT_TRUE(v >= 0.0f && v <= 1.0f);
  graph.nodes[0].point.at_m.z = 10.0;  // all of it behind
  image = white();
  drawGraph(image, graph, kAtTheTree, {.twig_m = 0.05, .nearest_m = 1.0, .farthest_m = 10.0});
  EXPECT_EQ(blackened(image), 0.0);
}

TEST(GraphDrawing, AnEdgeIsWiderTheMoreEndsItLeadsTo) {
  const auto trunk = [](int ends) {
    PointGraph graph;
    graph.nodes = {node({0, 1, 0}), node({0, 2.5, 0}, 0)};
    for (int i = 0; i < ends; ++i) graph.nodes.push_back(node({0.01 * i, 2.52, 0}, 1));
    Image image = white();
    drawGraph(image, graph, kAtTheTree, {.twig_m = 0.05, .nearest_m = 1.0, .farthest_m = 1e9});
    double sum = 0.0;
    const int row = image.height / 2;
    for (int x = 0; x < image.width; ++x) sum += 1.0 - static_cast<double>(*image.at(x, row));
    return sum;
  };
  EXPECT_NEAR(trunk(27) / trunk(1), 3.0, 0.5);
}

TEST(GraphDrawing, WhatIsHiddenIsFaint) {
  PointGraph graph = tree();
  const GraphSizes sizes = sizesFor(graph, kAtTheTree, 200, 150);
  Image open = white(), hidden = white();
  drawGraph(open, graph, kAtTheTree, sizes);
  for (auto& n : graph.nodes) n.point.hidden = true;
  for (auto& p : graph.waiting) p.hidden = true;
  drawGraph(hidden, graph, kAtTheTree, sizes);
  EXPECT_LT(blackened(hidden), 0.4 * blackened(open));
  EXPECT_GT(blackened(hidden), 0.02 * blackened(open));
}

TEST(GraphDrawing, SizesSuitHowMuchThereIs) {
  PointGraph few = tree(), many;
  few.nodes.clear();
  for (int k = 0; k < 200; ++k) {
    for (SpacePoint p : few.waiting) many.waiting.push_back({p.at_m + 1e-3 * Vec3(k, -k, k)});
  }
  EXPECT_GT(sizesFor(few, kAtTheTree, 640, 480).point_m, 2.0 * sizesFor(many, kAtTheTree, 640, 480).point_m);
  EXPECT_GT(sizesFor(tree(), kAtTheTree, 640, 480).node_m, 0.0);
  EXPECT_EQ(sizesFor({}, kAtTheTree, 640, 480).point_m, 0.0);
  PointGraph neighbours = tree();
  for (const SpacePoint& p : many.waiting) neighbours.waiting.push_back({p.at_m + Vec3(20, 0, 0)});
  const GraphSizes alone = sizesFor(tree(), kAtTheTree, 640, 480),
                   beside = sizesFor(neighbours, kAtTheTree, 640, 480);
  EXPECT_EQ(beside.point_m, alone.point_m) << "what lies beside the picture has no say";
  EXPECT_EQ(beside.farthest_m, alone.farthest_m);
}

TEST(Golden, PointsOfATree) {
  const PointGraph graph = tree();
  Image image = paper(240, 180);
  drawPoints(image, graph, kAtTheTree, sizesFor(graph, kAtTheTree, 240, 180));
  tests::expectLikeGolden(image, "points");
}

TEST(Golden, GraphOfATreeInTheLittleGarden) {
  const tests::LittleGarden garden;
  const sim::Bricks bricks(garden.occupied());
  const Camera camera = tests::LittleGarden::camera();
  Image image =
      paleScene(see(garden.frame(), garden.occupied(), bricks, camera, 240, 180), garden.occupied());
  PointGraph graph = tree();
  const auto place = [](Vec3& at) { at = Vec3(-0.35, 0.1, 0.75) + 0.36 * at; };
  for (auto& n : graph.nodes) place(n.point.at_m);
  for (auto* points : {&graph.waiting, &graph.ended}) {
    for (auto& p : *points) place(p.at_m);
  }
  for (auto& p : graph.waiting) p.hidden = p.at_m.z < 0.3;
  drawGraph(image, graph, camera, sizesFor(graph, camera, 240, 180));
  tests::expectLikeGolden(image, "graph");
}

}  // namespace
}  // namespace espalier::render
