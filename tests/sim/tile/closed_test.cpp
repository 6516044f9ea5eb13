#include "sim/tile/closed.h"

#include <gtest/gtest.h>

#include <queue>
#include <set>

#include "sim/base/parallel.h"
#include "sim/base/random.h"
#include "sim/tile/bodies.h"
#include "sim/tile/build_world.h"
#include "tests/support/meshes.h"
#include "tests/support/worlds.h"

namespace espalier::sim {
namespace {

using tests::boxMesh;

/// The world of a mesh that nobody called solid, in voxels of 1 m whose centres lie at whole metres.
World found(const Mesh& mesh, Voxel size, std::vector<FillReport>* fills = nullptr) {
  return buildWorld(tests::unitFrame(size), {{mesh, false, true}}, 0, fills);
}

const Vec3 kLow(4.5, 3.5, 4.5), kHigh(24.5, 17.5, 20.5);
const Voxel kInside(14, 10, 12), kOutside(2, 10, 12), kWorld(30, 24, 26);

TEST(Closed, IsFilledHoweverItIsWound) {
  const Mesh box = boxMesh(kLow, kHigh);
  std::vector<FillReport> asked_fills;
  const World asked = buildWorld(tests::unitFrame(kWorld), {{box, true}}, 0, &asked_fills);
  for (const Mesh& mesh : {box, tests::insideOut(box)}) {
    std::vector<FillReport> fills;
    const World world = found(mesh, kWorld, &fills);
    EXPECT_EQ(world.occupied().words(), asked.occupied().words());
    EXPECT_EQ(world.opaque().words(), asked.opaque().words());
    ASSERT_EQ(fills.size(), 1u);
    EXPECT_TRUE(fills[0].found);
    EXPECT_EQ(fills[0].filled, asked_fills.at(0).filled);
    EXPECT_GT(fills[0].filled, 3000u);
  }
}

TEST(Closed, AHouseWithoutAFloorStandsOnTheGround) {
  const World world = found(tests::without(boxMesh(kLow, kHigh), [](Vec3 p) { return p.y < 4.0; }), kWorld);
  EXPECT_TRUE(world.opaque().at(kInside));
  EXPECT_FALSE(world.opaque().at(kOutside));
  // To the ground, also where that is the world's own floor.
  const World low =
      found(tests::without(boxMesh({4.5, -0.5, 4.5}, kHigh), [](Vec3 p) { return p.y < 0.0; }), kWorld);
  EXPECT_TRUE(low.opaque().at(Voxel(14, 0, 12)));
}

TEST(Closed, WhatIsOpenToTheSkyOrToASideStaysOpen) {
  for (const auto& goes : std::vector<std::function<bool(Vec3)>>{[](Vec3 p) { return p.y > 17.0; },
                                                                 [](Vec3 p) { return p.x < 5.0; },
                                                                 [](Vec3 p) { return p.z > 20.0; }}) {
    for (const bool inside_out : {false, true}) {
      const Mesh mesh = tests::without(boxMesh(kLow, kHigh), goes);
      std::vector<FillReport> fills;
      const World world = found(inside_out ? tests::insideOut(mesh) : mesh, kWorld, &fills);
      EXPECT_FALSE(world.occupied().at(kInside));
      EXPECT_TRUE(fills.empty());
    }
  }
}

/// A gap all around, narrower than a voxel: the upper half stands off by a third.
TEST(Closed, CracksNarrowerThanAVoxelLetNobodyIn) {
  Mesh mesh = tests::without(boxMesh(kLow, Vec3(24.5, 10.4, 20.5)), [](Vec3 p) { return p.y > 10.3; });
  const Mesh lid = tests::without(boxMesh(Vec3(4.5, 10.7, 4.5), kHigh), [](Vec3 p) { return p.y < 10.8; });
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  mesh.vertices_m.insert(mesh.vertices_m.end(), lid.vertices_m.begin(), lid.vertices_m.end());
  for (const auto& t : lid.triangles) tests::addTriangle(mesh, first + t[0], first + t[1], first + t[2]);
  EXPECT_TRUE(found(mesh, kWorld).opaque().at(kInside));
}

/// What lies before a hole is denied by one end of its lines.
TEST(Closed, ABodyWithAHoleIsFilledWhole) {
  const Vec3 middle(14.3, 11.8, 13.1);
  const Mesh ball = tests::sphereMesh(middle, 9.0, 24);
  const Mesh holed =
      tests::without(ball, [&](Vec3 p) { return glm::distance(p, middle + Vec3(0, 0, 9)) < 2.8; });
  const World world = found(holed, kWorld), whole = found(ball, kWorld);
  ASSERT_LT(holed.triangles.size(), ball.triangles.size());
  for (int z = 13; z < 20; ++z) EXPECT_TRUE(world.opaque().at(Voxel(14, 12, z))) << z;
  EXPECT_EQ(world.opaque().at(Voxel(14, 12, 25)), false);
  EXPECT_GT(world.opaque().count(), whole.opaque().count() * 95 / 100);
}

TEST(Closed, SolidsThatOverlapStayFull) {
  Mesh mesh = boxMesh(Vec3(3.5), Vec3(13.5));
  const Mesh other = boxMesh(Vec3(8.5), Vec3(19.5));
  for (const Vec3& v : other.vertices_m) mesh.vertices_m.push_back(v);
  for (const auto& t : other.triangles) tests::addTriangle(mesh, 8 + t[0], 8 + t[1], 8 + t[2]);
  const World world = found(mesh, kWorld);
  for (const int at : {6, 11, 16}) EXPECT_TRUE(world.opaque().at(Voxel(at))) << at;
}

/// Leaves as a cloud of single triangles that face anywhere, above a ground without thickness.
TEST(Closed, ACloudOfLeavesIsNotFilled) {
  Mesh mesh = tests::emptyMesh("leaves");
  const Voxel size(48);
  for (std::uint32_t leaf = 0; leaf < 1500; ++leaf) {
    Draws draws({3, leaf}, Purpose::custom);
    const Vec3 at(draws.uniform(6, 42), draws.uniform(8, 42), draws.uniform(6, 42));
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (int corner = 0; corner < 3; ++corner)
      mesh.vertices_m.push_back(at + Vec3(draws.uniform(-1, 1), draws.uniform(-1, 1), draws.uniform(-1, 1)));
    tests::addTriangle(mesh, first, first + 1, first + 2);
  }
  std::vector<FillReport> fills;
  found(mesh, size, &fills);
  const std::size_t filled = fills.empty() ? 0 : fills[0].filled;
  EXPECT_LT(filled, 100u) << "of " << 36 * 34 * 36;
}

TEST(Closed, DoesNotDependOnThreads) {
  const Mesh mesh =
      tests::without(tests::sphereMesh(Vec3(14.3, 11.8, 13.1), 9.0, 24), [](Vec3 p) { return p.x > 22.0; });
  const World one = found(mesh, kWorld);
  for (const int threads : {1, 2, 5}) {
    onThreads(threads, [&] { EXPECT_EQ(found(mesh, kWorld).opaque().words(), one.opaque().words()); });
  }
}

/// Against a search from voxel to voxel.
TEST(Bodies, AreWhatHangsTogetherByFaces) {
  const Voxel size(150, 7, 9);
  BitVolume voxels(size);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    Draws draws({5, i}, Purpose::custom);
    const Voxel v(draws.whole(0, size.x - 1), draws.whole(0, size.y - 1), draws.whole(0, size.z - 1));
    for (int k = 0; k < 4; ++k) {
      if (v.x + k < size.x) voxels.set(v + Voxel(k, 0, 0));
    }
  }
  sim::Bodies bodies(voxels, BitVolume(size), 1);
  std::vector<int> of_voxel(static_cast<std::size_t>(size.x * size.y * size.z), -1);
  const auto at = [&](Voxel v) -> int& {
    return of_voxel[static_cast<std::size_t>((v.y * size.z + v.z) * size.x + v.x)];
  };
  std::size_t in_runs = 0;
  for (std::size_t i = 0; i < bodies.runs().size(); ++i) {
    const sim::Run& run = bodies.runs()[i];
    ASSERT_GE(run.y, 1);
    in_runs += run.voxels();
    EXPECT_EQ(countIn(voxels, run), run.voxels());
    for (int x = run.first; x <= run.last; ++x) at({x, run.y, run.z}) = static_cast<int>(bodies.bodyOf(i));
  }
  std::size_t set = 0, of_bodies = 0;
  std::vector<bool> met(of_voxel.size());
  for (int y = 1; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        if (!voxels.at({x, y, z})) continue;
        ++set;
        const auto index = [&](Voxel v) {
          return static_cast<std::size_t>((v.y * size.z + v.z) * size.x + v.x);
        };
        if (met[index({x, y, z})]) continue;
        ++of_bodies;
        const int body = at({x, y, z});
        std::queue<Voxel> next({Voxel(x, y, z)});
        met[index({x, y, z})] = true;
        for (; !next.empty(); next.pop()) {
          ASSERT_EQ(at(next.front()), body);
          for (int way = 0; way < 6; ++way) {
            Voxel v = next.front();
            v[way / 2] += way % 2 == 0 ? 1 : -1;
            if (v.y < 1 || !voxels.at(v) || met[index(v)]) continue;
            met[index(v)] = true;
            next.push(v);
          }
        }
      }
    }
  }
  EXPECT_EQ(in_runs, set);
  std::set<std::size_t> numbers;
  for (std::size_t i = 0; i < bodies.runs().size(); ++i) numbers.insert(bodies.bodyOf(i));
  EXPECT_EQ(numbers.size(), of_bodies);
  EXPECT_GT(of_bodies, 20u);
}

}  // namespace
}  // namespace espalier::sim
