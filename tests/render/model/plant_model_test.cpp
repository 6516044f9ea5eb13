#include "render/model/plant_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/model/leaves.h"
#include "sim/base/error.h"
#include "sim/base/random.h"
#include "tests/support/small_vine.h"
#include "tests/support/sound_surface.h"

namespace espalier {
namespace {

using render::ModelMesh;
using render::modelPlant;
using sim::Vec3;
using sim::Vec3f;

const sim::Frame kUnit{sim::Vec3(0.0), 1.0, sim::Voxel(16)};

void expectSound(const ModelMesh& mesh) {
  const std::size_t count = mesh.positions_m.size();
  EXPECT_EQ(mesh.normals.size(), count);
  EXPECT_EQ(mesh.uvs.size(), count);
  EXPECT_EQ(mesh.exposures.size(), count);
  EXPECT_EQ(mesh.youths.size(), count);
  EXPECT_EQ(mesh.pieces.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_TRUE(std::isfinite(glm::dot(mesh.positions_m[i], mesh.positions_m[i])));
    EXPECT_NEAR(glm::length(mesh.normals[i]), 1.0f, 1e-4f);
    EXPECT_TRUE(mesh.exposures[i] >= 0.0f && mesh.exposures[i] <= 1.0f);
    EXPECT_TRUE(mesh.youths[i] >= 0.0f && mesh.youths[i] <= 1.0f);
  }
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t corner : t) EXPECT_LT(corner, count);
  }
}

double distanceTo(const ModelMesh& mesh, Vec3 p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3f q : mesh.positions_m) nearest = std::min(nearest, glm::distance(Vec3(q), p));
  return nearest;
}

TEST(PlantModel, StemsPassThroughTheNodes) {
  const sim::Plant plant = tests::smallVine();
  const auto model = modelPlant(plant, tests::kVineFrame);
  expectSound(model.stems);
  std::vector<bool> forks(static_cast<std::size_t>(plant.skeleton.size()), false);
  for (const sim::NodeId parent : plant.skeleton.parent)
    if (parent != sim::kNoNode) forks[static_cast<std::size_t>(parent)] = true;
  for (std::size_t n = 0; n < forks.size(); ++n) {
    const Vec3 node_m = sim::worldFromVoxel(tests::kVineFrame, plant.skeleton.position_vx[n]);
    if (forks[n]) {
      EXPECT_GT(tests::windingAt(model.stems, node_m), 0.9) << n;  // inside
    } else {
      EXPECT_LT(distanceTo(model.stems, node_m), plant.girth.twig_vx * tests::kVineFrame.voxel_m) << n;
    }
  }
}

TEST(PlantModel, IsLight) {
  const sim::Plant plant = tests::smallVine();
  const auto model = modelPlant(plant, tests::kVineFrame);
  const auto segments = static_cast<std::size_t>(plant.skeleton.size());
  EXPECT_LT(model.stems.triangles.size(), 30 * segments);
  EXPECT_EQ(model.elements[0].triangles.size(), 6 * plant.elements.size());
  EXPECT_EQ(model.stalks.triangles.size(), 3 * plant.elements.size());
}

TEST(PlantModel, ExposureComesFromTheNodes) {
  sim::Plant plant;
  tests::addNode(plant.skeleton, sim::kNoNode, {0, 0, 0}, 0, 0.25f);
  tests::addNode(plant.skeleton, 0, {0, 3, 0}, 4, 0.75f);
  const auto model = modelPlant(plant, kUnit);
  for (std::size_t i = 0; i < model.stems.positions_m.size(); ++i) {
    const float y = model.stems.positions_m[i].y;
    if (y < 0.01f) {
      EXPECT_EQ(model.stems.exposures[i], 0.25f);
    } else if (y > 2.99f) {
      EXPECT_EQ(model.stems.exposures[i], 0.75f);
      EXPECT_EQ(model.stems.youths[i], 1.0f);
    }
  }
}

TEST(PlantModel, OrdersAreThoseOfBranching) {
  sim::Plant plant;
  for (const Vec3 p : {Vec3(0, 0, 0), Vec3(0, 3, 0), Vec3(0, 6, 0), Vec3(0, 9, 0)})
    tests::addNode(plant.skeleton, plant.skeleton.size() - 1, p);
  tests::addNode(plant.skeleton, 1, {3, 4, 0});  // a branch, and a twig on it
  tests::addNode(plant.skeleton, 4, {6, 5, 0});
  tests::addNode(plant.skeleton, 5, {9, 5, 0});
  tests::addNode(plant.skeleton, 4, {4, 7, 0});
  for (const double x : {0.0, -3.0, 3.0}) tests::addNode(plant.skeleton, 3, {x, 12, 0});  // a thick trunk
  plant.shapes = {tests::keeledLeaf()};
  for (const sim::NodeId node : {0, 2, 5, 7})
    plant.elements.push_back(
        {.node = node, .position_vx = plant.skeleton.position_vx[static_cast<std::size_t>(node)]});
  const auto ordersOf = [](const std::vector<std::uint8_t>& orders,
                           const std::vector<std::uint32_t>& pieces) {
    EXPECT_EQ(orders.size(), pieces.size());
    std::map<std::uint32_t, std::set<int>> found;
    for (std::size_t i = 0; i < orders.size(); ++i) found[pieces[i]].insert(orders[i]);
    return found;
  };
  using Found = std::map<std::uint32_t, std::set<int>>;
  auto model = modelPlant(plant, kUnit);
  EXPECT_EQ(ordersOf(model.stems.orders, model.stems.pieces),
            (Found{{0, {0}}, {1, {1}}, {2, {1}}, {3, {1}}, {4, {2}}}));
  EXPECT_EQ(ordersOf(model.elements[0].orders, model.elements[0].pieces),
            (Found{{0, {0}}, {1, {0}}, {2, {1}}, {3, {2}}}));
  plant.skeleton.columns["order"] = {0, 0, 0, 0, 7, 7, 7, 300, 0, 7, 7};  // as the process counts
  model = modelPlant(plant, kUnit);
  EXPECT_EQ(ordersOf(model.stems.orders, model.stems.pieces),
            (Found{{0, {0}}, {1, {7}}, {2, {7}}, {3, {7}}, {4, {255}}}));
}

/// The tints of elements at three heights, as meshes or as instances have them.
std::vector<sim::Colour> tintsByHeight(double weight, bool as_instances) {
  sim::Plant plant;
  for (const Vec3 p : {Vec3(2, 0, 2), Vec3(2, 5, 2), Vec3(2, 10, 2)})
    tests::addNode(plant.skeleton, plant.skeleton.size() - 1, p);
  plant.shapes = {tests::keeledLeaf()};
  plant.shapes[0].varies = {0.0, 0.0, 0.0, weight};
  for (const double y : {1.0, 4.0, 9.0})
    plant.elements.push_back({.node = y < 5.0 ? 1 : 2, .position_vx = {2, y, 2}, .exposure = 0.5f});
  render::ModelOptions options;
  options.instances = as_instances;
  const auto model = modelPlant(plant, kUnit, options);
  std::vector<sim::Colour> tints(3);
  if (as_instances) {
    for (std::size_t i = 0; i < 3; ++i) tints[i] = model.instances.back().places.at(i).tint;
    return tints;
  }
  const ModelMesh& mesh = model.elements.at(0);
  for (std::size_t v = 0; v < mesh.pieces.size(); ++v) tints[mesh.pieces[v]] = mesh.tints.at(v);
  return tints;
}

TEST(PlantModel, ColoursFollowHeightOnlyWhereTheyAreToldTo) {
  for (const bool as_instances : {false, true}) {
    const auto same = tintsByHeight(0.0, as_instances);
    EXPECT_EQ(same[0], same[1]);
    EXPECT_EQ(same[0], same[2]);
    const auto golden = tintsByHeight(1.0, as_instances);
    EXPECT_EQ(golden[0], same[0]) << "the lowest is as it was";
    const auto gold = [](sim::Colour c) { return c.r / c.g; };
    EXPECT_GT(gold(golden[1]), 1.2f * gold(golden[0]));
    EXPECT_GT(gold(golden[2]), 1.2f * gold(golden[1]));
    for (const sim::Colour& tint : tintsByHeight(3.0, as_instances))
      EXPECT_GE(std::min({tint.r, tint.g, tint.b}), 0.0f);
  }
}

TEST(PlantModel, TrianglesOfInstancesCountWhereverTheyStand) {
  render::PlantModel model;
  EXPECT_EQ(render::triangleCount(model), 0u);
  model.stems.triangles.resize(7);
  model.stalks.triangles.resize(2);
  model.elements.resize(2);
  model.elements[1].triangles.resize(5);
  EXPECT_EQ(render::triangleCount(model), 14u);
  model.instances.resize(1);
  model.instances[0].shape.triangles.resize(3);
  model.instances[0].places.resize(10);
  EXPECT_EQ(render::triangleCount(model), 44u);
}

TEST(PlantModel, DegeneratePlants) {
  sim::Plant plant;
  EXPECT_TRUE(modelPlant(plant, kUnit).stems.empty());
  tests::addNode(plant.skeleton, sim::kNoNode, {1, 1, 1});
  EXPECT_TRUE(modelPlant(plant, kUnit).stems.empty());
  tests::addNode(plant.skeleton, 0, {1, 1, 1});  // in the seed's own place
  EXPECT_TRUE(modelPlant(plant, kUnit).stems.empty());
  tests::addNode(plant.skeleton, 1, {1, 3, 1});
  plant.shapes = {tests::keeledLeaf(), {"nothing", {}, {}}};
  plant.elements.resize(2);
  plant.elements[0].node = 1;
  plant.elements[1] = {0, 1, {1, 1, 1}};
  const auto model = modelPlant(plant, kUnit);
  EXPECT_FALSE(model.stems.empty());
  expectSound(model.stems);
  expectSound(model.elements[0]);
  EXPECT_EQ(model.elements.size(), 2u);
  EXPECT_TRUE(model.elements[1].empty());
  plant.girth.exponent = -1.0;
  EXPECT_THROW(modelPlant(plant, kUnit), sim::InputError);
}

TEST(Leaves, AreWhereTheyWerePlaced) {
  sim::PlacedElement element;
  element.position_vx = {3, 4, 5};
  element.x = {0, 0, -1};
  element.y = {1, 0, 0};
  element.z = {0, -1, 0};
  element.scale = 2.0;
  element.exposure = 0.4f;
  const sim::Frame frame{sim::Vec3(10, 0, 0), 0.5, sim::Voxel(16)};
  const sim::ElementShape shape{"tile", {{{-1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 1, 0}}}, {}};
  ModelMesh mesh;
  render::appendElement(mesh, element, shape, frame, {0.5f}, 9);
  expectSound(mesh);
  ASSERT_EQ(mesh.positions_m.size(), 4u);
  // (-1, 0, 0): 2 * -x = +z 2 -> voxel (3, 4, 7) -> metres (11.5, 2, 3.5)
  EXPECT_EQ(mesh.positions_m[0], Vec3f(11.5f, 2.0f, 3.5f));
  EXPECT_EQ(mesh.positions_m[2], Vec3f(12.5f, 2.0f, 1.5f));
  EXPECT_EQ(mesh.normals[0], Vec3f(0, -1, 0));
  EXPECT_EQ(mesh.uvs[2], glm::vec2(1, 1));
  EXPECT_EQ(mesh.exposures[0], 0.4f);
  EXPECT_EQ(mesh.pieces[0], 9u);
}

TEST(Leaves, FaceTheirOwnFaceHoweverTheyAreWound) {
  ModelMesh mesh;
  render::appendElement(mesh, {}, tests::keeledLeaf(), kUnit, {}, 0);
  for (const auto& t : mesh.triangles) {
    const Vec3f a = mesh.positions_m[t[0]], b = mesh.positions_m[t[1]], c = mesh.positions_m[t[2]];
    EXPECT_GT(glm::cross(b - a, c - a).z, 0.0f);
    EXPECT_GT(mesh.normals[t[0]].z, 0.0f);
  }
}

double areaOf(const std::vector<Vec3>& corners) {
  const render::Fan fan = render::fanOf(corners);
  std::vector<Vec3> points = corners;
  if (fan.with_centre) points.push_back(render::centreOf(corners));
  double area = 0.0;
  for (const auto& t : fan.triangles)
    area += 0.5 * glm::length(glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]));
  return area;
}

TEST(Leaves, FansCoverConvexAndHollowPolygons) {
  EXPECT_DOUBLE_EQ(areaOf({{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}}), 6.0);
  // A star of four points, begun at a point: corner 0 does not see the whole of it.
  const std::vector<Vec3> star{{3, 0, 0},  {1, 1, 0},   {0, 3, 0},  {-1, 1, 0},
                               {-3, 0, 0}, {-1, -1, 0}, {0, -3, 0}, {1, -1, 0}};
  EXPECT_TRUE(render::fanOf(star).with_centre);
  EXPECT_NEAR(areaOf(star), 12.0, 1e-12);
  EXPECT_TRUE(render::fanOf(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}).triangles.empty());
  EXPECT_TRUE(render::fanOf(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}).triangles.empty());
}

TEST(Leaves, StalksReachFromTheStemToTheBlade) {
  sim::Plant plant;
  tests::addNode(plant.skeleton, sim::kNoNode, {5, 0, 5});
  tests::addNode(plant.skeleton, 0, {5, 6, 5});
  plant.shapes = {tests::keeledLeaf()};
  sim::PlacedElement element;
  element.node = 1;
  element.position_vx = {5, 3, 5};
  element.x = {0, 0, -1};
  element.y = {1, 0, 0};
  element.z = {0, -1, 0};
  element.scale = 4.0;
  plant.elements = {element};
  const auto with_stalk = modelPlant(plant, kUnit);
  const Vec3 blade = sim::placed(element, render::bladeBase(plant.shapes[0]));
  Vec3 base = blade;
  for (const Vec3f p : with_stalk.elements[0].positions_m)
    if (glm::distance(Vec3(p), blade) < glm::distance(base, blade) || base == blade) base = Vec3(p);
  EXPECT_NEAR(base.x - blade.x, 0.65 * plant.girth.twig_vx, 0.15 * plant.girth.twig_vx);  // it tapers
  expectSound(with_stalk.stalks);
  EXPECT_LT(distanceTo(with_stalk.stalks, {5, 3, 5}), 0.1);
  EXPECT_LT(distanceTo(with_stalk.stalks, base), 1e-5);
  EXPECT_LT(distanceTo(with_stalk.elements[0], base), 1e-5);
  plant.shapes[0].polygons = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}};  // begins on the stem
  EXPECT_EQ(modelPlant(plant, kUnit).elements[0].triangles.size(), 1u);
  EXPECT_TRUE(modelPlant(plant, kUnit).stalks.empty());
}

/// However thick a stem becomes, where it is bent, and inside of a thicker one.
TEST(Leaves, FeetStandOnTheBark) {
  sim::Plant plant;
  for (const Vec3 p : {Vec3(5, 0, 5), Vec3(5, 6, 5), Vec3(7, 12, 5), Vec3(5, 18, 5)})
    tests::addNode(plant.skeleton, plant.skeleton.size() - 1, p);
  const auto side = tests::addNode(plant.skeleton, 1, {5, 10, 13});
  plant.shapes = {{"card", {{{0, 0, 0}, {0.5, 1, 0}, {0, 2, 0}, {-0.5, 1, 0}}}, {}}};
  for (const sim::NodeId node : {2, 2, 3, side}) {
    sim::PlacedElement element;
    element.node = node;
    const double along = plant.elements.size() % 2 == 0 ? 0.5 : 0.05;
    const auto parent = plant.skeleton.parent[static_cast<std::size_t>(node)];
    const Vec3 from = plant.skeleton.position_vx[static_cast<std::size_t>(parent)];
    const Vec3 segment = plant.skeleton.position_vx[static_cast<std::size_t>(node)] - from;
    element.position_vx = from + along * segment;
    element.y = sim::perpendicular(glm::normalize(segment));
    element.z = glm::normalize(segment);
    element.x = glm::cross(element.y, element.z);
    plant.elements.push_back(element);
  }
  for (const double twig_vx : {0.1, 1.0}) {
    plant.girth.twig_vx = twig_vx;
    const auto model = modelPlant(plant, kUnit), placed = modelPlant(plant, kUnit, {.instances = true});
    const ModelMesh& cards = model.elements[0];
    ASSERT_EQ(placed.instances.size(), 1u);  // and no stalks
    for (std::size_t e = 0; e < plant.elements.size(); ++e) {
      SCOPED_TRACE(testing::Message() << "twigs of " << twig_vx << ", element " << e);
      const Vec3 foot(cards.positions_m[4 * e]);
      const Vec3 out = 0.5 * twig_vx * plant.elements[e].y;
      EXPECT_NEAR(tests::windingAt(model.stems, foot - out), 1.0, 0.01);
      EXPECT_NEAR(tests::windingAt(model.stems, foot + out), 0.0, 0.01);
      EXPECT_LT(glm::distance(Vec3(placed.instances[0].places[e].position_m), foot), 1e-5);
    }
  }
}

TEST(Leaves, AreNotMovedIntoWalls) {
  sim::Plant plant;
  tests::addNode(plant.skeleton, sim::kNoNode, {5, 0, 5});
  tests::addNode(plant.skeleton, 0, {5, 6, 5});
  plant.girth.twig_vx = 1.5;
  plant.shapes = {{"card", {{{-0.5, 0, 0}, {0.5, 0, 0}, {0.5, 2, 0}}}, {}}};
  sim::PlacedElement element;
  element.node = 1;
  element.position_vx = {5, 3, 5};
  element.x = {0, 0, -1};
  element.y = {1, 0, 0};
  element.z = {0, -1, 0};
  plant.elements = {element};
  sim::BitVolume walls(sim::Voxel(16));
  const auto tip = [&] {
    const auto model = modelPlant(plant, kUnit, {.walls = &walls});
    float most = 0.0f;
    for (const Vec3f p : model.elements[0].positions_m) most = std::max(most, p.x);
    return most;
  };
  EXPECT_NEAR(tip(), 7.0f + 0.65f * 1.5f, 0.15f);
  for (int y = 0; y < 16; ++y) {
    for (int z = 0; z < 16; ++z) walls.set({8, y, z});
  }
  EXPECT_EQ(tip(), 7.0f);
}

TEST(Leaves, WhereThereIsNoStemThereIsNoStalk) {
  sim::Plant paving;  // elements placed without segments, far from the seed
  tests::addNode(paving.skeleton, sim::kNoNode, {5, 0, 5});
  paving.shapes = {{"tile", {{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}}}, {}}};
  sim::PlacedElement element;
  element.node = 0;
  element.position_vx = {25, 0, 5};
  paving.elements = {element};
  EXPECT_EQ(modelPlant(paving, kUnit).elements[0].triangles.size(), 1u);
  EXPECT_TRUE(modelPlant(paving, kUnit).stalks.empty());
}

}  // namespace
}  // namespace espalier
