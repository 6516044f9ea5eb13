#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "rules/growth/element_places.h"
#include "sim/base/parallel.h"
#include "sim/grow/grow.h"
#include "sim/sense/proximity.h"
#include "sim/tile/build_world.h"
#include "tests/support/lively.h"
#include "tests/support/meshes.h"
#include "tests/support/plots.h"

/// How elements stand whose pose is not left free: each pose holds of all that grow, and not of free ones.
namespace espalier::rules {
namespace {

using sim::Vec3;

const std::vector<Vec3> kCorners = {{0, 0, 0}, {0.8, 1, 0}, {0, 2, 0}, {-0.8, 1, 0}};

RuleSet posing(Pose pose, bool in_order = false) {
  RuleSet rules = tests::lively();
  rules.light.boost = 1.0;
  rules.require.proximity_max = {3.0};
  Element& leaf = rules.elements.at(0);
  leaf.polygons = {kCorners};
  leaf.per_segment = 2.0;
  leaf.pose = pose;
  if (in_order) {
    leaf.phyllotaxis.emplace();
    leaf.phyllotaxis->spacing = {0.6};
    leaf.petiole.value = 0.3;
  }
  return rules;
}

sim::Growth leafy(const RuleSet& rules, sim::World& world) {
  return sim::grow(world, tests::planting(world, rules, {tests::kOpenSeed, {22, 2, 23}}),
                   tests::brightSettings(10));
}
sim::Growth leafy(const RuleSet& rules) {
  sim::World world = tests::wallPlot();
  return leafy(rules, world);
}

/// Visits each element with the skeleton of its plant.
template <class Visit>
std::size_t forEachElement(const sim::Growth& growth, Visit visit) {
  std::size_t count = 0;
  for (const sim::Plant& plant : growth.plants) {
    for (const sim::PlacedElement& element : plant.elements) visit(element, plant.skeleton);
    count += plant.elements.size();
  }
  return count;
}

/// Of a segment, the point nearest to a place.
Vec3 attachedAt(const sim::PlacedElement& element, const sim::Skeleton& skeleton) {
  const auto n = static_cast<std::size_t>(element.node);
  const Vec3 from = skeleton.position_vx[static_cast<std::size_t>(skeleton.parent[n])];
  const Vec3 way = skeleton.position_vx[n] - from;
  const double along = glm::dot(element.position_vx - from, way) / glm::dot(way, way);
  return from + std::clamp(along, 0.0, 1.0) * way;
}

/// How far the axes are from a way at the most.
double farthestAxis(const sim::Growth& growth, Vec3 way) {
  double farthest = 0.0;
  forEachElement(growth,
                 [&](const auto& e, const auto&) { farthest = std::max(farthest, glm::distance(e.y, way)); });
  return farthest;
}

class ElementPose : public testing::TestWithParam<bool> {};

TEST_P(ElementPose, HangsStraightDownAndStandsStraightUp) {
  for (const auto& [pose, way] : {std::pair{Pose::hang, Vec3(0, -1, 0)}, {Pose::stand, Vec3(0, 1, 0)}}) {
    const auto growth = leafy(posing(pose, GetParam()));
    std::set<double> faces;
    const std::size_t count = forEachElement(growth, [&](const auto& e, const auto&) {
      faces.insert(e.z.x);
      EXPECT_NEAR(glm::dot(e.z, way), 0.0, 1e-12);
      EXPECT_NEAR(glm::length(glm::cross(e.x, e.y) - e.z), 0.0, 1e-12);
    });
    EXPECT_GT(count, 40u);
    EXPECT_LT(farthestAxis(growth, way), 1e-5);
    EXPECT_EQ(faces.size(), count) << "they turn about their axes";
    EXPECT_GT(farthestAxis(leafy(posing(Pose::free, GetParam())), way), 0.5);
  }
}

/// How far at the most corners lie off the plane through their place on the limb that is square to their
/// face, and faces off the wall's normal. Of what stands beyond the reach of the floor and the world's ends.
std::pair<double, double> offTheWall(const sim::Growth& growth) {
  double corners = 0.0, faces = 0.0;
  std::size_t count = 0;
  forEachElement(growth, [&](const auto& e, const auto& skeleton) {
    if (e.position_vx.y < 7.0 || e.position_vx.y > 26.0 || std::abs(e.position_vx.x - 24.0) > 20.0) return;
    ++count;
    const double attached_z = attachedAt(e, skeleton).z;
    for (const Vec3 corner : kCorners)
      corners = std::max(corners, std::abs(sim::placed(e, corner).z - attached_z));
    faces = std::max(faces, glm::distance(e.z, Vec3(0, 0, e.position_vx.z > 20.0 ? 1 : -1)));
  });
  EXPECT_GT(count, 20u);
  return {corners, faces};
}

TEST_P(ElementPose, LiesFlatOnTheWallThatIsNear) {
  const auto [corners, faces] = offTheWall(leafy(posing(Pose::surface, GetParam())));
  EXPECT_LT(corners, 1.0);
  EXPECT_LT(faces, 1e-6);
  const auto [free_corners, free_faces] = offTheWall(leafy(posing(Pose::free, GetParam())));
  EXPECT_GT(free_corners, 1.0);
  EXPECT_GT(free_faces, 0.1);
}

TEST_P(ElementPose, OnASurfaceGrowsAlongItsLimb) {
  double farthest_deg = 0.0;
  forEachElement(leafy(posing(Pose::surface, GetParam())), [&](const auto& e, const auto& skeleton) {
    const auto n = static_cast<std::size_t>(e.node);
    Vec3 way = skeleton.position_vx[n] - skeleton.position_vx[static_cast<std::size_t>(skeleton.parent[n])];
    way -= glm::dot(way, e.z) * e.z;
    if (glm::length(way) < 0.1) return;
    farthest_deg = std::max(farthest_deg, 180.0 / std::numbers::pi *
                                              std::acos(std::min(1.0, glm::dot(e.y, glm::normalize(way)))));
  });
  EXPECT_LT(farthest_deg, 60.1);  // as far as late trials sway
  EXPECT_GT(farthest_deg, 0.5) << "they turn about their normals";
}

/// Of all that lie on their segment beside a surface: how many degrees each leaves its limb by, to one side
/// (above 0) or the other.
std::vector<double> asideOf(const sim::Growth& growth) {
  std::vector<double> sides;
  forEachElement(growth, [&](const auto& e, const auto& skeleton) {
    const auto n = static_cast<std::size_t>(e.node);
    Vec3 way = skeleton.position_vx[n] - skeleton.position_vx[static_cast<std::size_t>(skeleton.parent[n])];
    way -= glm::dot(way, e.z) * e.z;
    if (glm::length(way) < 0.5) return;
    way = glm::normalize(way);
    sides.push_back(180.0 / std::numbers::pi *
                    std::atan2(glm::dot(e.z, glm::cross(way, e.y)), glm::dot(way, e.y)));
  });
  return sides;
}

TEST(ElementPoseAside, LeavesItsLimbByThePitchInTwoRowsOnTheSurface) {
  RuleSet rules = posing(Pose::aside, true);
  rules.elements.at(0).phyllotaxis->angle_deg = 180.0;
  rules.elements.at(0).phyllotaxis->pitch_deg = 60.0;
  rules.elements.at(0).crosses = true;  // or many would have to sway
  const std::vector<double> sides = asideOf(leafy(rules));
  ASSERT_GT(sides.size(), 40u);
  std::size_t left = 0, by_pitch = 0;
  for (const double side : sides) {
    left += side > 0.0;
    by_pitch += std::abs(std::abs(side) - 60.0) < 4.1;  // as far as first trials sway
  }
  EXPECT_GT(by_pitch, sides.size() * 9 / 10);
  EXPECT_NEAR(static_cast<double>(left) / static_cast<double>(sides.size()), 0.5, 0.1);
  rules.elements.at(0).pose = Pose::surface;  // which asks for no pitch
  std::size_t along = 0;
  for (const double side : asideOf(leafy(rules))) along += std::abs(side) < 10.0;
  EXPECT_GT(along, sides.size() / 2);
}

/// In a sheet of guide voxels nothing is nearer on one side than on the other, so that the sheet says it.
TEST(ElementPoseAside, InAGuideTheGuideSaysWhichWayIsUp) {
  sim::World world({Vec3(0.0), 0.04, {24, 24, 24}});
  const sim::PartId part = world.addPart({"pane", "pane", sim::PartKind::scene, -1});
  const Vec3 normal = glm::normalize(Vec3(0.2, 0.1, 1.0));
  std::vector<sim::TiledVoxel> pane;
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x) pane.push_back({{x, y, 12}, {part, {}, 1.0f, sim::Vec3f(normal)}});
  world.addGuide(pane);
  world.setLayers(2);
  EXPECT_LT(glm::distance(surfaceNormal(world, {10, 10, 12}), normal), 1e-6);
  EXPECT_LT(glm::distance(surfaceNormal(world, {10, 10, 13}), normal), 1e-6);
  EXPECT_LT(glm::distance(surfaceNormal(world, {10, 10, 11}), -normal), 1e-6) << "of its other side";
  EXPECT_EQ(surfaceNormal(world, {10, 10, 20}), Vec3(0.0));
}

/// A tunnel along x, whose roof goes so far; wholly dark where that is all of it.
sim::World tunnel(int roofed_to) {
  sim::World world({Vec3(0.0), 0.04, {61, 30, 41}});
  tests::addBox(world, "floor", {0, 0, 0}, {60, 0, 40});
  tests::addBox(world, "wall", {0, 1, 0}, {60, 26, 1});
  tests::addBox(world, "wall", {0, 1, 39}, {60, 26, 40});
  tests::addBox(world, "end", {0, 1, 2}, {1, 26, 38});
  if (roofed_to == 60) tests::addBox(world, "other end", {59, 1, 2}, {60, 26, 38});
  tests::addBox(world, "roof", {0, 27, 0}, {roofed_to, 27, 40});
  world.setLayers(4);
  return world;
}

/// Of faces under the roof that see any sky, whose plant stands well inside.
double leastTowardsTheMouth(Pose pose, bool in_order) {
  sim::World world = tunnel(34);
  RuleSet rules = posing(pose, in_order);
  rules.elements.at(0).face = 0.0;  // says nothing of this pose
  double least = 1.0;
  std::size_t under_roof = 0;
  forEachElement(leafy(rules, world), [&](const auto& e, const auto& skeleton) {
    if (attachedAt(e, skeleton).x > 30.0 || e.exposure == 0.0f) return;
    least = std::min(least, e.z.x);
    ++under_roof;
  });
  EXPECT_GT(under_roof, 40u);
  return least;
}

TEST_P(ElementPose, FacesTheLightWhereAnyIsSeen) {
  EXPECT_GT(leastTowardsTheMouth(Pose::light, GetParam()), 0.3);
  EXPECT_LT(leastTowardsTheMouth(Pose::free, GetParam()), -0.5);
}

TEST_P(ElementPose, FacesTheVeryLightThatIsSeen) {
  const RuleSet rules = posing(Pose::light, GetParam());
  Senses senses;
  senses.light = glm::normalize(Vec3(0.3, 0.5, -0.7));
  std::set<double> axes;
  for (int trial = 0; trial < 30; ++trial) {
    sim::Slots slots({7, 0}, sim::Purpose::element, 0, static_cast<unsigned>(trial));
    sim::PlacedElement e;
    stand(e, rules.elements.at(0), {0.5, 30.0, GetParam()}, Vec3(0, 1, 0), Vec3(1, 0, 0), {}, senses,
          Vec3(0.0), trial, slots);
    EXPECT_EQ(e.z, senses.light);
    EXPECT_NEAR(glm::dot(e.y, e.z), 0.0, 1e-12);
    axes.insert(e.y.x);
  }
  EXPECT_EQ(axes.size(), 30u) << "they turn about the light";
}

TEST_P(ElementPose, IsFreeWhereItHasNothingToGoBy) {
  const auto stateOf = [](sim::World world, const RuleSet& rules) {
    const auto growth = leafy(rules, world);
    EXPECT_GT(forEachElement(growth, [](const auto&, const auto&) {}), 20u);
    return sim::stateHash(world, growth);
  };
  RuleSet free = posing(Pose::free, GetParam());
  free.require.proximity_max = {kNoLimit};
  RuleSet dark = free, lost = free;
  dark.elements.at(0).pose = Pose::light;
  lost.elements.at(0).pose = Pose::surface;
  EXPECT_EQ(stateOf(tunnel(60), dark), stateOf(tunnel(60), free));
  EXPECT_NE(stateOf(tunnel(34), dark), stateOf(tunnel(34), free));
  EXPECT_EQ(stateOf(tests::wallPlot({48, 48, 40}, 0), lost), stateOf(tests::wallPlot({48, 48, 40}, 0), free));
  EXPECT_NE(stateOf(tests::wallPlot(), lost), stateOf(tests::wallPlot(), free));
}

TEST_P(ElementPose, IsTheSameOnAnyNumberOfThreads) {
  std::set<std::uint64_t> states;
  for (const Pose pose : {Pose::free, Pose::hang, Pose::stand, Pose::light, Pose::surface}) {
    for (const int threads : {1, 2, 5}) {
      sim::onThreads(threads, [&] {
        sim::World world = tests::wallPlot();
        const auto growth = leafy(posing(pose, GetParam()), world);
        states.insert(sim::stateHash(world, growth));
      });
    }
  }
  EXPECT_EQ(states.size(), 5u);
}

INSTANTIATE_TEST_SUITE_P(Place, ElementPose, testing::Bool(),
                         [](const auto& order) { return order.param ? "in_order" : "by_chance"; });

// Stairs of voxels are not what a slanting wall was modelled as.
TEST(SurfaceNormal, IsThatOfTheMeshWhereItHasOne) {
  const Vec3 slope = glm::normalize(Vec3(0.3, 1.0, -0.2)),
             along = glm::normalize(glm::cross(slope, {1, 0, 0}));
  const Vec3 across = glm::cross(along, slope), middle(20, 12, 20);
  sim::Mesh wall = tests::emptyMesh("wall");
  for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    wall.vertices_m.push_back(middle + 14.0 * (double(a) * along + double(b) * across));
  tests::addTriangle(wall, 0, 1, 2);
  tests::addTriangle(wall, 0, 2, 3);
  const sim::World world = sim::buildWorld({Vec3(0.0), 1.0, sim::Voxel(41)}, {{wall}}, 5);
  double off = 0.0, off_by_distance = 0.0;
  for (const double height : {2.0, 3.3, 4.0, -2.0, -3.3}) {
    for (int i = -6; i <= 6; ++i) {
      const Vec3 place = middle + height * slope + double(i) * along - 0.7 * double(i) * across;
      const Vec3 wanted = height > 0.0 ? slope : -slope;
      off = std::max(off, glm::distance(surfaceNormal(world, place), wanted));
      off_by_distance =
          std::max(off_by_distance, glm::distance(sim::awayFromScene(world, sim::voxelAt(place)), wanted));
    }
  }
  EXPECT_LT(off, 1e-3);
  EXPECT_GT(off_by_distance, 0.05);
  EXPECT_EQ(surfaceNormal(world, middle + 12.0 * slope), Vec3(0.0));
}

Value rising(Over over, double from, double to) {
  Value value;
  value.kind = Value::Kind::curve;
  value.over = over;
  value.curve = {{from, 0.5}, {to, 1.5}};
  return value;
}

/// The farthest that any size is from what its curve says of a place.
template <class At>
double farthestSize(Over over, double from, double to, At at) {
  RuleSet rules = posing(Pose::free);
  rules.elements.at(0).size = rising(over, from, to);
  double farthest = 0.0;
  std::set<double> sizes;
  forEachElement(leafy(rules), [&](const auto& e, const auto& skeleton) {
    const double wanted = 0.5 + std::clamp((at(e, skeleton) - from) / (to - from), 0.0, 1.0);
    farthest = std::max(farthest, std::abs(e.scale - wanted));
    sizes.insert(e.scale);
  });
  EXPECT_GT(sizes.size(), 5u);
  return farthest;
}

TEST(ElementSize, FollowsExposureAgeAndHeight) {
  EXPECT_LT(farthestSize(Over::exposure, 0.0, 1.0,
                         [](const auto& e, const auto&) { return static_cast<double>(e.exposure); }),
            1e-6);
  EXPECT_LT(farthestSize(Over::age, 1.0, 12.0,
                         [](const auto& e, const auto&) { return static_cast<double>(e.born); }),
            1e-9);
  EXPECT_LT(farthestSize(Over::height, 0.1, 1.2,
                         [](const auto& e, const sim::Skeleton& skeleton) {
                           const auto node = static_cast<std::size_t>(e.node);
                           const auto site = static_cast<std::size_t>(skeleton.parent[node]);
                           return 0.04 * skeleton.position_vx[site].y;
                         }),
            1e-9);
}

}  // namespace
}  // namespace espalier::rules
