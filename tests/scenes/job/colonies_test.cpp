#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "scenes/prepare/plantings.h"
#include "scenes/read/read_scene.h"
#include "sim/grow/grow.h"
#include "tests/support/scratch.h"

/// The library's scenes of space colonization show what they say.
namespace espalier::scenes {
namespace {

using sim::Vec3;
using Nodes = std::vector<Vec3>;

struct Colony {
  std::vector<Nodes> nodes_m;  ///< of each plant
  std::vector<std::vector<sim::NodeId>> parent;
};

Colony grown(const std::string& name) {
  auto read = readScene(tests::sourceFolder() / "scenes/library" / (name + ".yaml"));
  if (!read) throw std::runtime_error(format(read.problems()));
  const Scene scene = *read;
  Site site = makeSite(scene);
  const auto plantings = makePlantings(scene, site);
  std::vector<Problem> warnings;
  const auto settings = growthSettings(scene, site, attractorsOf(scene, site, &warnings));
  EXPECT_EQ(format(warnings), "");
  const sim::Growth growth = sim::grow(site.world, plantings, settings);
  Colony colony;
  for (const sim::Plant& plant : growth.plants) {
    colony.parent.push_back(plant.skeleton.parent);
    colony.nodes_m.emplace_back();
    for (const Vec3& at_vx : plant.skeleton.position_vx)
      colony.nodes_m.back().push_back(sim::worldFromVoxel(site.world.frame(), at_vx));
  }
  return colony;
}

/// By how many degrees limbs go aside from the way straight out of their start, seen along an axis: the
/// middle of those that are so far from there and carry at least ten nodes.
double asideOf(const Colony& colony, std::size_t plant, Vec3 axis, double from_m, double to_m) {
  const Nodes& nodes = colony.nodes_m[plant];
  std::vector<int> carried(nodes.size(), 0);
  std::vector<double> aside;
  for (std::size_t i = nodes.size() - 1; i > 0; --i) {
    const auto parent = static_cast<std::size_t>(colony.parent[plant][i]);
    carried[parent] += carried[i] + 1;
    const auto across = [&](Vec3 v) { return v - glm::dot(v, axis) * axis; };
    const Vec3 out = across(nodes[parent] - nodes[0]), way = across(nodes[i] - nodes[parent]);
    const double away = glm::distance(nodes[parent], nodes[0]);
    if (away < from_m || away > to_m || carried[i] < 10) continue;
    aside.push_back(std::atan2(glm::dot(axis, glm::cross(out, way)), glm::dot(out, way)) * 180.0 /
                    std::numbers::pi);
  }
  EXPECT_GT(aside.size(), 50u);
  const auto middle = aside.begin() + static_cast<std::ptrdiff_t>(aside.size() / 2);
  std::nth_element(aside.begin(), middle, aside.end());
  return *middle;
}

/// Figures 7 and 8 of Tanaka et al.: the more angle, the tighter the whorls.
TEST(Colonies, OnBodiesWhorlMoreAndMore) {
  const Colony colony = grown("whorls");
  ASSERT_EQ(colony.nodes_m.size(), 8u);
  for (const std::size_t first : {0u, 4u}) {  // balls, wrens
    std::vector<double> aside;
    for (std::size_t i = first; i < first + 4; ++i) aside.push_back(asideOf(colony, i, {0, 0, 1}, 0.3, 0.45));
    fmt::print("aside by {:.0f} degrees\n", fmt::join(aside, ", "));
    EXPECT_NEAR(aside[0], 0.0, 5.0);
    EXPECT_GT(aside[1], 20.0);
    EXPECT_GT(aside[2], aside[1] + 10.0);
    EXPECT_GT(aside[3], aside[2] + 4.0);
  }
}

/// Figure 9: about an axis, in a volume.
TEST(Colonies, InVolumesWindMoreAndMore) {
  const Colony colony = grown("whorls_volume");
  ASSERT_EQ(colony.nodes_m.size(), 3u);
  std::vector<double> aside;
  for (std::size_t i = 0; i < 3; ++i) aside.push_back(asideOf(colony, i, {0, 1, 0}, 1.8, 2.6));
  fmt::print("aside by {:.0f} degrees\n", fmt::join(aside, ", "));
  EXPECT_NEAR(aside[0], 0.0, 5.0);
  EXPECT_GT(aside[1], 40.0);
  EXPECT_GT(aside[2], aside[1] + 4.0);
}

/// By how many degrees the way of a plant's trunk, to its highest node, turns round the upright below a
/// height.
double turnOf(const Colony& colony, std::size_t plant, double below_m) {
  const Nodes& nodes = colony.nodes_m[plant];
  auto at = static_cast<std::size_t>(
      std::max_element(nodes.begin(), nodes.end(), [](Vec3 a, Vec3 b) { return a.y < b.y; }) - nodes.begin());
  double turn = 0.0;
  Vec3 above(0.0);
  for (; at != 0; at = static_cast<std::size_t>(colony.parent[plant][at])) {
    const Vec3 way = nodes[at] - nodes[static_cast<std::size_t>(colony.parent[plant][at])];
    if (nodes[at].y < below_m)
      turn += std::atan2(above.x * way.z - above.z * way.x, above.x * way.x + above.z * way.z);
    above = way;
  }
  return turn * 180.0 / std::numbers::pi;
}

/// Figure 19 (b): all stems of the pachira wind about its axis, the same way round, and carry a crown.
TEST(Colonies, APachirasStemsWindAboutEachOther) {
  const Colony colony = grown("pachira");
  ASSERT_EQ(colony.nodes_m.size(), 4u);
  for (std::size_t stem = 0; stem < 4; ++stem) {
    const double turn = turnOf(colony, stem, 1.4);
    fmt::print("round by {:.0f} degrees\n", turn);
    EXPECT_GT(std::abs(turn), 300.0);
    EXPECT_GT(turn * turnOf(colony, 0, 1.4), 0.0);
    EXPECT_GT(colony.nodes_m[stem].size(), 100u);
  }
}

/// Figure 18 (d): the tree stands in its mesh's shape, wherever that is thick: beak, head and tail.
TEST(Colonies, ATreeTakesTheShapeOfAWren) {
  const Colony colony = grown("animal_tree");
  const Nodes& tree = colony.nodes_m.at(0);
  Vec3 low(1e9), high(-1e9);
  for (const Vec3 node : tree) {
    if (node.y < 1.4) continue;  // the trunk
    low = glm::min(low, node);
    high = glm::max(high, node);
  }
  // The wren is 4.4 times 1.24 m long, 0.75 m high and 0.55 m wide.
  EXPECT_NEAR(high.x - low.x, 5.47, 0.6);
  EXPECT_NEAR(high.y, 4.48, 0.25);
  EXPECT_NEAR(high.z - low.z, 2.41, 0.35);
}

/// It starts under a roof whose eaves are at z = 1.06, between 2.1 and 2.8 m of height.
TEST(Colonies, ATreeGoesAroundTheEavesToTheLight) {
  const Colony colony = grown("tree_and_wall");
  const Nodes& tree = colony.nodes_m.at(0);
  std::size_t above = 0;
  for (std::size_t i = 1; i < tree.size(); ++i) {
    if (tree[i].y < 2.9) continue;
    ++above;
    auto at = i;
    while (tree[at].y > 2.3) at = static_cast<std::size_t>(colony.parent[0][at]);
    EXPECT_GT(tree[at].z, 0.9) << "node " << i << " came up through the roof";
  }
  EXPECT_LT(tree[0].z, 0.7);
  EXPECT_GT(static_cast<double>(above), 0.8 * static_cast<double>(tree.size()));
  for (std::size_t ivy = 1; ivy < 5; ++ivy) EXPECT_GT(colony.nodes_m.at(ivy).size(), 500u);
}

TEST(Colonies, TreesOfAHedgeShareIt) {
  const Colony colony = grown("hedge");
  std::size_t all = 0;
  for (const Nodes& tree : colony.nodes_m) all += tree.size();
  ASSERT_EQ(colony.nodes_m.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const Nodes& tree = colony.nodes_m[i];
    EXPECT_NEAR(static_cast<double>(tree.size()) / static_cast<double>(all), 1.0 / 6, 0.05);
    double middle = 0.0;
    for (const Vec3& at : tree) middle += at.x / static_cast<double>(tree.size());
    EXPECT_NEAR(middle, tree[0].x, 0.25);
  }
}

TEST(Colonies, RootsGoDownAndACrownUp) {
  const Colony colony = grown("roots");
  ASSERT_EQ(colony.nodes_m.size(), 2u);
  const auto [crown, roots] = std::pair(colony.nodes_m[0], colony.nodes_m[1]);
  const auto lower = [](const Vec3& a, const Vec3& b) { return a.y < b.y; };
  EXPECT_LT(glm::distance(crown[0], roots[0]), 0.1);
  EXPECT_GT(std::min_element(crown.begin(), crown.end(), lower)->y, 0.0);
  EXPECT_GT(std::max_element(crown.begin(), crown.end(), lower)->y, 4.0);
  EXPECT_LT(std::max_element(roots.begin(), roots.end(), lower)->y, 0.05);
  EXPECT_LT(std::min_element(roots.begin(), roots.end(), lower)->y, -1.7);
}

/// How wide a tree is between two heights: the farthest from its axis.
double reachOf(const Nodes& tree, double low_m, double high_m) {
  double reach = 0.0;
  for (const Vec3& at : tree) {
    if (at.y >= low_m && at.y < high_m)
      reach = std::max(reach, std::hypot(at.x - tree[0].x, at.z - tree[0].z));
  }
  return reach;
}

TEST(Colonies, FourCrownsHaveTheirShapes) {
  const Colony colony = grown("four_crowns");
  ASSERT_EQ(colony.nodes_m.size(), 4u);
  const auto& [cone, dome, cylinder, cypress] =
      std::tie(colony.nodes_m[0], colony.nodes_m[1], colony.nodes_m[2], colony.nodes_m[3]);
  constexpr double kNear = 0.5;  // the least of their kill distances
  for (double y = 3.0; y < 12.0; y += 1.0) EXPECT_LT(reachOf(cone, y, y + 1.0), 0.5 * (12.0 - y) + kNear);
  EXPECT_NEAR(reachOf(dome, 2.0, 3.5), 5.8, kNear);
  EXPECT_LT(reachOf(dome, 7.0, 9.0), 2.0);
  for (const double y : {3.0, 5.0, 7.0}) EXPECT_NEAR(reachOf(cylinder, y, y + 2.0), 3.0, kNear);
  EXPECT_GT(reachOf(cypress, 3.0, 6.0), 1.8);
  EXPECT_LT(reachOf(cypress, 11.0, 14.0), 1.5);
}

}  // namespace
}  // namespace espalier::scenes
