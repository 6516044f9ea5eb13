#include "render/form/forks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>

#include "render/form/formed.h"
#include "sim/base/parallel.h"
#include "sim/grow/retiled.h"
#include "tests/support/drawn_forks.h"

namespace espalier::render {
namespace {

using sim::NodeId;
using sim::Vec3;

constexpr double kDegrees = 180.0 / std::numbers::pi;
const KeptFree kNothing = [](sim::Voxel) { return false; };

/// Limbs that wander and fork at random, in up to `most` at a node, each limb so many segments long.
sim::Plant wanderer(unsigned seed, int forks, int segments, int most = 2) {
  std::mt19937 random(seed);
  const auto even = [&](double from, double to) {
    return from + (to - from) * (static_cast<double>(random()) / 4294967296.0);
  };
  sim::Plant plant;
  plant.girth.twig_vx = 0.15;
  plant.girth.exponent = 3.0;
  plant.form.forks = sim::StemForm::Forks::murray;
  sim::Skeleton& s = plant.skeleton;
  s.columns["quantity"];
  const auto add = [&](NodeId parent, Vec3 at) {
    s.parent.push_back(parent);
    s.position_vx.push_back(at);
    s.born.push_back(parent == sim::kNoNode ? 0 : s.born[static_cast<std::size_t>(parent)] + 1);
    s.columns["quantity"].push_back(static_cast<float>(s.size()));
    return s.size() - 1;
  };
  const auto grow = [&](NodeId from, Vec3 way) {
    NodeId at = from;
    for (int k = 0; k < segments; ++k) {
      way = glm::normalize(way + 0.3 * Vec3(even(-1, 1), even(-1, 1), even(-1, 1)));
      at = add(at, s.position_vx[static_cast<std::size_t>(at)] + 2.0 * way);
    }
    return at;
  };
  std::vector<NodeId> tips{grow(add(sim::kNoNode, Vec3(100, 5, 100)), Vec3(0, 1, 0))};
  for (int k = 0; k < forks; ++k) {
    const std::size_t one = random() % tips.size();
    const NodeId fork = tips[one];
    const auto f = static_cast<std::size_t>(fork);
    const Vec3 way = glm::normalize(s.position_vx[f] - s.position_vx[static_cast<std::size_t>(s.parent[f])]);
    tips.erase(tips.begin() + static_cast<std::ptrdiff_t>(one));
    const int daughters = 2 + static_cast<int>(random() % static_cast<unsigned>(most - 1));
    for (int d = 0; d < daughters; ++d)
      tips.push_back(grow(fork, way + 0.8 * Vec3(even(-1, 1), even(-1, 1), even(-1, 1))));
  }
  return plant;
}

bool stands(const sim::Plant& plant, Vec3 place) {
  const auto& places = plant.skeleton.position_vx;
  return std::any_of(places.begin(), places.end(), [&](Vec3 p) { return glm::distance(p, place) < 1e-9; });
}

TEST(MurrayForks, AnglesAreThoseOfTheLaw) {
  const double half = std::cbrt(0.5);
  const ForkAngles even = murrayAngles(1.0, half, half);
  EXPECT_NEAR(even.first * kDegrees, 37.467, 1e-3);  // cos = 2^(1/3) / 2^(2/3) ... = 2^(-1/3)
  EXPECT_NEAR(std::cos(even.first), std::pow(2.0, -1.0 / 3.0), 1e-12);
  EXPECT_DOUBLE_EQ(even.first, even.second);
  for (const double r1 : {0.3, 0.6, 0.9}) {
    const double r2 = std::cbrt(1.0 - r1 * r1 * r1);
    const ForkAngles angles = murrayAngles(1.0, r1, r2);
    const double together = (1.0 - std::pow(r1, 4) - std::pow(r2, 4)) / (2.0 * r1 * r1 * r2 * r2);
    EXPECT_NEAR(std::cos(angles.first + angles.second), together, 1e-12);
    EXPECT_NEAR(r1 * r1 * std::sin(angles.first), r2 * r2 * std::sin(angles.second), 1e-12);  // in balance
  }
  EXPECT_GT(murrayAngles(1.0, std::cbrt(1.0 - 1e-6), 1e-2).second * kDegrees, 89.0);  // a twig on a trunk
}

TEST(MurrayForks, DrawnForksHaveThem) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const sim::Plant plant = wanderer(seed, 40, 6);
    const test::DrawnForks before = test::drawnForks(plant);
    const test::DrawnForks after = test::drawnForks(withMurrayForks(plant, kNothing));
    EXPECT_GT(before.meanDeviation(), 10.0);
    EXPECT_EQ(after.drawn_deg.size(), before.drawn_deg.size());
    EXPECT_LT(after.meanDeviation(), 1.0);
  }
}

TEST(MurrayForks, ForksAndTipsOfLongTwigsStayWhereTheyAre) {
  const sim::Plant plant = wanderer(4, 30, 5);
  const sim::Plant after = withMurrayForks(plant, kNothing);
  const sim::Skeleton& s = plant.skeleton;
  std::vector<int> children(s.parent.size(), 0);
  for (const NodeId parent : s.parent) {
    if (parent != sim::kNoNode) ++children[static_cast<std::size_t>(parent)];
  }
  for (std::size_t n = 0; n < children.size(); ++n) {
    EXPECT_TRUE(children[n] == 1 || stands(after, s.position_vx[n])) << n;
  }
  EXPECT_EQ(after.skeleton.columns.at("quantity").size(), after.skeleton.parent.size());
}

TEST(MurrayForks, NoMoreThanTwoDaughtersLeaveANode) {
  const sim::Plant plant = wanderer(5, 25, 12, 5);
  EXPECT_GT(test::drawnForks(plant).crowded, 5u);
  const test::DrawnForks after = test::drawnForks(withMurrayForks(plant, kNothing));
  EXPECT_EQ(after.crowded, 0u);
  EXPECT_LT(after.meanDeviation(), 3.0);
}

TEST(MurrayForks, StayWhereTheyGrewWhereNoOtherRoomIs) {
  const sim::Plant plant = wanderer(6, 20, 5);
  const auto own = sim::stemVoxels(plant.skeleton);
  const KeptFree all_else = [&](sim::Voxel v) {
    return !std::binary_search(own.begin(), own.end(), v, sim::beforeInRows);
  };
  EXPECT_NE(sim::stemVoxels(withMurrayForks(plant, kNothing).skeleton), own);
  for (const sim::Voxel v : sim::stemVoxels(withMurrayForks(plant, all_else).skeleton))
    EXPECT_FALSE(all_else(v));
}

TEST(MurrayForks, AreTheSameOnAnyThreads) {
  const sim::Plant plant = wanderer(7, 60, 4, 3);
  const auto on = [&](int threads) {
    std::vector<Vec3> places;
    sim::onThreads(threads, [&] { places = withMurrayForks(plant, kNothing).skeleton.position_vx; });
    return places;
  };
  EXPECT_EQ(on(1), on(2));
  EXPECT_EQ(on(1), on(5));
}

TEST(MurrayForks, ElementsGoAlong) {
  sim::Plant plant = wanderer(8, 20, 5);
  plant.shapes.push_back({.name = "leaf", .polygons = {}});
  const sim::Skeleton& s = plant.skeleton;
  for (NodeId n = 1; n < s.size(); ++n) {
    const Vec3 from = s.position_vx[static_cast<std::size_t>(s.parent[static_cast<std::size_t>(n)])];
    plant.elements.push_back(
        {.node = n, .position_vx = glm::mix(from, s.position_vx[static_cast<std::size_t>(n)], 0.3)});
  }
  const sim::Plant after = withMurrayForks(plant, kNothing);
  ASSERT_EQ(after.elements.size(), plant.elements.size());
  const sim::Skeleton& now = after.skeleton;
  std::size_t moved = 0;
  for (std::size_t e = 0; e < after.elements.size(); ++e) {
    const auto n = static_cast<std::size_t>(after.elements[e].node);
    const Vec3 a = now.position_vx[static_cast<std::size_t>(now.parent[n])], b = now.position_vx[n];
    const Vec3 p = after.elements[e].position_vx;
    const double share = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    EXPECT_LT(glm::distance(p, glm::mix(a, b, share)), 1e-6) << e;
    if (glm::distance(p, plant.elements[e].position_vx) > 0.05) ++moved;
  }
  EXPECT_GT(moved, 20u);
}

TEST(Formed, LimbsThatMetMeetAgain) {
  sim::Plant plant = wanderer(11, 20, 5);
  plant.form.rough = sim::StemForm::Rough{0.6, 0.5, 4.0, 0.5};
  sim::Skeleton& s = plant.skeleton;
  std::vector<int> children(s.parent.size(), 0);
  for (NodeId n = 1; n < s.size(); ++n)
    ++children[static_cast<std::size_t>(s.parent[static_cast<std::size_t>(n)])];
  // Some tips come to where other limbs pass.
  std::vector<float>& joins = s.columns[sim::kJoinsColumn];
  joins.assign(s.parent.size(), 0.0f);
  std::size_t met = 0;
  for (std::size_t n = 40; n < children.size(); ++n) {
    if (children[n] != 0) continue;
    const std::size_t to = 7 + 3 * met++;
    joins[n] = static_cast<float>(to);
    s.position_vx[n] = s.position_vx[to];
  }
  ASSERT_GT(met, 5u);
  const sim::World world({{0, 0, 0}, 0.1, {200, 200, 200}});
  const sim::Plant after = formed(plant, world, kNothing);
  const std::vector<float>& now = after.skeleton.columns.at(sim::kJoinsColumn);
  std::size_t meet = 0;
  for (std::size_t n = 0; n < now.size(); ++n) {
    if (now[n] == 0.0f) continue;
    ++meet;
    EXPECT_EQ(after.skeleton.position_vx[n], after.skeleton.position_vx[static_cast<std::size_t>(now[n])]);
  }
  EXPECT_EQ(meet, met);
  EXPECT_GT(after.skeleton.size(), 2 * plant.skeleton.size());
}

std::size_t shared(const sim::Plant& one, const sim::Plant& two) {
  const auto a = sim::stemVoxels(one.skeleton), b = sim::stemVoxels(two.skeleton);
  std::vector<sim::Voxel> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both), sim::beforeInRows);
  return both.size();
}

TEST(FormedStand, KeepsPlantsApartAndOutOfTheScene) {
  sim::World world({{0, 0, 0}, 0.1, {200, 120, 200}});
  const sim::PartId wall = world.addPart({"wall", "wall"});
  std::vector<sim::TiledVoxel> slab;
  for (int y = 0; y < 120; ++y) {
    for (int z = 0; z < 200; ++z) slab.push_back({{103, y, z}, {wall}});
  }
  world.occupy(slab);
  const sim::World before = world;
  // Twins, the one a little beside the other, before a wall.
  std::vector<sim::Plant> plants{wanderer(9, 14, 5), wanderer(9, 14, 5)};
  std::vector<sim::TiledVoxel> grown;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    plants[i].name = i == 0 ? "one" : "two";
    plants[i].stem_part = world.addPart({plants[i].name, "stem", sim::PartKind::stem, static_cast<int>(i)});
    for (Vec3& p : plants[i].skeleton.position_vx) {
      p.x = std::clamp(102.0 - std::abs(p.x - 100.0), 0.0, 102.0);
      p.y = std::clamp(p.y, 0.0, 119.0);
      p.z += i == 0 ? 0.0 : 2.5;
    }
    for (const sim::Voxel v : sim::stemVoxels(plants[i].skeleton))
      grown.push_back({v, sim::stemSurface(plants[i])});
  }
  world.occupy(grown);
  const FormedStand stand = formedStand(before, world, plants);
  ASSERT_EQ(stand.plants.size(), 2u);
  EXPECT_LE(shared(stand.plants[0], stand.plants[1]), shared(plants[0], plants[1]));
  sim::BitVolume stems(world.frame().size);
  for (const sim::Plant& plant : stand.plants) {
    EXPECT_GT(plant.skeleton.size(), plants[0].skeleton.size());
    for (const sim::Voxel v : sim::stemVoxels(plant.skeleton)) {
      EXPECT_FALSE(before.solid().at(v));
      stems.set(v);
    }
  }
  // The world's stems are these and no others.
  EXPECT_EQ(stand.world.inPlants().words(), stems.words());
  EXPECT_EQ(stand.world.parts().size(), world.parts().size());
}

}  // namespace
}  // namespace espalier::render
