#include "sim/sense/company.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace espalier {
namespace {

using sim::Vec3;
using sim::Voxel;
using sim::Whose;

/// Two regions and three plants at random, sparse and dense by turns along x.
sim::World mixed(Voxel size, unsigned seed) {
  sim::World world({Vec3(0.0), 0.1, size});
  std::vector<sim::PartId> parts;
  for (const char* region : {"brick", "soil"})
    parts.push_back(world.addPart({"plot", region, sim::PartKind::scene, -1}));
  for (int plant = 0; plant < 3; ++plant) {
    parts.push_back(world.addPart({"p", "stems", sim::PartKind::stem, plant}));
    parts.push_back(world.addPart({"p", "leaf", sim::PartKind::element, plant}));
  }
  std::mt19937 random(seed);
  std::vector<sim::TiledVoxel> voxels;
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        const std::size_t number = random() % (x % 32 < 16 ? 12u : 300u);
        if (number < parts.size())
          voxels.push_back({{x, y, z}, {parts[number], sim::Colour(0.5f), 1.0f, sim::Vec3f(0.0f)}});
      }
    }
  }
  world.occupy(voxels);
  world.setLayers(2);
  return world;
}

bool isOf(const sim::World& world, const Whose& whose, Voxel v) {
  const sim::PartId id = world.partAt(v);
  if (id == sim::kFree) return false;
  const sim::Part& part = world.part(id);
  const bool scene = part.kind == sim::PartKind::scene;
  switch (whose.kind) {
    case Whose::Kind::everything:
      return true;
    case Whose::Kind::scene:
      return scene;
    case Whose::Kind::plants:
      return !scene;
    case Whose::Kind::own:
      return !scene && part.plant == whose.plant;
    case Whose::Kind::others:
      return !scene && part.plant != whose.plant;
    case Whose::Kind::region:
      return scene && part.region == whose.region;
  }
  return false;
}

/// What every voxel of the cube says, asked one by one.
struct Plain {
  std::int64_t all = 0, those = 0;
  glm::i64vec3 sum{0};
  std::optional<Voxel> nearest;
};

Plain plainly(const sim::World& world, const Whose& whose, Voxel about, double radius_vx) {
  const int reach = static_cast<int>(radius_vx);
  Plain plain;
  int least = std::numeric_limits<int>::max();
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dz = -reach; dz <= reach; ++dz) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const int square = dx * dx + dy * dy + dz * dz;
        if (square > radius_vx * radius_vx) continue;
        ++plain.all;
        const Voxel v = about + Voxel(dx, dy, dz);
        if (!isOf(world, whose, v)) continue;
        ++plain.those;
        plain.sum += glm::i64vec3(dx, dy, dz);
        if (square < least) plain.nearest = v;
        least = std::min(least, square);
      }
    }
  }
  return plain;
}

const std::vector<Whose> kAll{{Whose::Kind::everything, 1, {}}, {Whose::Kind::scene, 1, {}},
                              {Whose::Kind::plants, 1, {}},     {Whose::Kind::own, 1, {}},
                              {Whose::Kind::others, 1, {}},     {Whose::Kind::region, 1, "soil"},
                              {Whose::Kind::region, 1, "none"}};

TEST(Company, IsWhatEveryVoxelInTheBallSays) {
  std::mt19937 random(5);
  for (const Voxel size : {Voxel(140, 20, 24), Voxel(64, 9, 17), Voxel(7, 7, 7), Voxel(1, 30, 12)}) {
    const sim::World world = mixed(size, 3);
    for (const double radius_vx : {0.5, 1.0, 2.9, 6.0, 11.0}) {
      for (int i = 0; i < 8; ++i) {
        const Voxel about(static_cast<int>(random() % static_cast<unsigned>(size.x)),
                          static_cast<int>(random() % static_cast<unsigned>(size.y)),
                          static_cast<int>(random() % static_cast<unsigned>(size.z)));
        for (const Whose& whose : kAll) {
          const Plain plain = plainly(world, whose, about, radius_vx);
          const sim::Crowd crowd = sim::crowdAround(world, whose, about, radius_vx);
          EXPECT_EQ(crowd.density, static_cast<double>(plain.those) / static_cast<double>(plain.all));
          EXPECT_EQ(sim::densityAround(world, whose, about, radius_vx), crowd.density);
          ASSERT_EQ(crowd.centre.has_value(), plain.those > 0);
          if (crowd.centre) {
            EXPECT_EQ(*crowd.centre, Vec3(about) + Vec3(plain.sum) / static_cast<double>(plain.those));
          }
          EXPECT_EQ(sim::nearestOf(world, whose, about, radius_vx), plain.nearest)
              << size.x << ' ' << radius_vx << ' ' << about.x << ' ' << about.y << ' ' << about.z;
        }
      }
    }
  }
}

TEST(Company, GatheredSaysTheSameAtEachPlaceNear) {
  std::mt19937 random(7);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (const Voxel size : {Voxel(140, 20, 24), Voxel(7, 7, 7), Voxel(200, 3, 2)}) {
    const sim::World world = mixed(size, 11);
    for (const double radius_vx : {0.5, 2.9, 6.0, 40.0}) {
      for (int i = 0; i < 6; ++i) {
        const Voxel about(below(size.x), below(size.y), below(size.z));
        for (const Whose& whose : kAll) {
          const int near_vx = 5;
          const sim::Company company(world, whose, about, near_vx + static_cast<int>(radius_vx));
          for (int k = 0; k < 6; ++k) {
            const Voxel off(below(2 * near_vx + 1), below(2 * near_vx + 1), below(2 * near_vx + 1));
            const Voxel place = glm::clamp(about + off - near_vx, Voxel(0), size - 1);
            EXPECT_EQ(company.density(place, radius_vx), sim::densityAround(world, whose, place, radius_vx));
            EXPECT_EQ(company.nearest(place, radius_vx), sim::nearestOf(world, whose, place, radius_vx));
          }
        }
      }
    }
  }
}

TEST(Company, HeightIsDownToTheTopOfTheFirstBelow) {
  sim::World world({Vec3(0.0), 0.1, Voxel(9, 40, 9)});
  const auto add = [&](sim::Part part, int y) {
    const sim::PartId id = world.addPart(std::move(part));
    world.occupy(std::vector<sim::TiledVoxel>{{{4, y, 4}, {id, sim::Colour(0.5f), 1.0f, sim::Vec3f(0.0f)}}});
  };
  add({"plot", "brick", sim::PartKind::scene, -1}, 10);
  add({"p", "stems", sim::PartKind::stem, 0}, 20);
  const Vec3 at(4, 30, 4);
  EXPECT_EQ(sim::heightAbove(world, {Whose::Kind::everything}, at), 9.5);
  EXPECT_EQ(sim::heightAbove(world, {Whose::Kind::scene}, at), 19.5);
  EXPECT_EQ(sim::heightAbove(world, {Whose::Kind::region, -1, "soil"}, at), 30.5);
  EXPECT_EQ(sim::heightAbove(world, {Whose::Kind::others, 0}, at), 30.5);
  EXPECT_NEAR(sim::heightAbove(world, {Whose::Kind::scene}, {4, 10.2, 4}), 10.7, 1e-12)
      << "its own voxel is not below";
  EXPECT_NEAR(sim::heightAbove(world, {Whose::Kind::scene}, {4, 10.6, 4}), 0.1, 1e-12);
}

}  // namespace
}  // namespace espalier
