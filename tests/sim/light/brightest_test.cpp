#include "sim/light/brightest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "sim/light/exposure.h"
#include "sim/sweep/sweep.h"
#include "sim/world/field.h"
#include "tests/support/bit_worlds.h"
#include "tests/support/messages.h"

namespace espalier {
namespace {

using sim::Vec3;
using sim::Voxel;
using sim::Weighting;

const sim::SkyTable& uniformTable() {
  static const auto table = sim::makeSkyTable(16, 64, sim::backgroundOf(Weighting::uniform));
  return table;
}

const sim::DirectionSet& uniformSky() {
  static const auto sky = sim::makeSky({.directions = 400}).directions;
  return sky;
}

double degreesBetween(Vec3 a, Vec3 b) {
  const double cosine = glm::dot(glm::normalize(a), glm::normalize(b));
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

/// A closed box with walls of one voxel; its inside is 1 .. size - 2.
sim::BitVolume closedBox(Voxel size) {
  sim::BitVolume box(size);
  tests::addBox(box, {0, 0, 0}, size - 1);
  for (int y = 1; y < size.y - 1; ++y) {
    for (int z = 1; z < size.z - 1; ++z) {
      for (int x = 1; x < size.x - 1; ++x) box.clear({x, y, z});
    }
  }
  return box;
}

void cut(sim::BitVolume& bits, Voxel low, Voxel high) {
  for (int y = low.y; y <= high.y; ++y) {
    for (int z = low.z; z <= high.z; ++z) {
      for (int x = low.x; x <= high.x; ++x) bits.clear({x, y, z});
    }
  }
}

TEST(SkyTable, HoldsTheWholeHemisphere) {
  const auto& table = uniformTable();
  ASSERT_EQ(table.cells.size(), 16u * 64u);
  double solid_angle = 0.0;
  for (const auto& cell : table.cells) {
    solid_angle += cell.light;
    // Half of a lattice step, a quarter of the 5.6 degrees of a row.
    EXPECT_LT(degreesBetween(Vec3(cell.centre), Vec3(table.rays[cell.ray].v)), 1.4);
  }
  EXPECT_NEAR(solid_angle, 2.0 * std::numbers::pi, 1e-4);
  const int weights = std::accumulate(table.rays.begin(), table.rays.end(), 0,
                                      [](int sum, const auto& ray) { return sum + ray.weight; });
  EXPECT_EQ(weights, sim::ExposureField::kWhole);
}

TEST(SkyTable, NamesWhatIsWrong) {
  const auto uniform = sim::backgroundOf(Weighting::uniform);
  const auto make = [](int rows, int columns, const sim::Background& background) {
    return tests::messageOf([&] { sim::makeSkyTable(rows, columns, background); });
  };
  EXPECT_NE(make(1, 64, uniform).find("expected 2 to 45 rows"), std::string::npos);
  EXPECT_NE(make(16, 181, uniform).find("4 to 180 columns"), std::string::npos);
  EXPECT_NE(make(4, 8, [](Vec3) { return -1.0; }).find("not below 0"), std::string::npos);
  EXPECT_NE(make(4, 8, [](Vec3) { return std::nan(""); }).find("not below 0"), std::string::npos);
  EXPECT_NE(make(4, 8, [](Vec3) { return 0.0; }).find("without light"), std::string::npos);
}

TEST(Brightest, IsTheZenithInTheOpen) {
  const sim::BitVolume open({9, 9, 9});
  EXPECT_LT(degreesBetween(brightest(uniformTable(), open, {4, 4, 4}), {0, 1, 0}), 0.01);
}

// In front of an endless wall half of the sky is left, x > 0. A surface whose normal lies between the x and y
// axes has all of it in front of it, and receives n . M with M the light's first moment. For a sky alike
// everywhere the integrals of x and of y over that quarter of the sphere are both pi/2: 45 degrees up. For
// 1 + 2 y they are pi/2 + 2 * 2/3 and pi/2 + 2 pi/3: 51.6 degrees up.
TEST(Brightest, BeforeAWallItIsThatOfTheClosedForm) {
  sim::BitVolume wall({70, 70, 70});
  tests::addBox(wall, {0, 0, 0}, {4, 69, 69});
  const Voxel foot(5, 0, 35);
  EXPECT_LT(degreesBetween(brightest(uniformTable(), wall, foot), {1, 1, 0}), 1.0);

  const auto overcast = sim::makeSkyTable(16, 64, sim::backgroundOf(Weighting::cie_overcast));
  const double pi = std::numbers::pi;
  EXPECT_LT(
      degreesBetween(brightest(overcast, wall, foot), {pi / 2.0 + 4.0 / 3.0, pi / 2.0 + 2.0 * pi / 3.0, 0.0}),
      1.0);
}

TEST(Brightest, OfACornerIsItsDiagonal) {
  sim::BitVolume corner({70, 70, 70});
  tests::addBox(corner, {0, 0, 0}, {0, 69, 69});
  tests::addBox(corner, {0, 0, 0}, {69, 69, 0});
  EXPECT_LT(degreesBetween(brightest(uniformTable(), corner, {1, 0, 1}), {1, 1, 1}), 1.0);
}

TEST(Brightest, ASunInTheBackgroundDrawsIt) {
  const Vec3 sun = glm::normalize(Vec3(1, 1, 0.5));
  const auto table =
      sim::makeSkyTable(16, 64, [&](Vec3 unit) { return glm::dot(unit, sun) > 0.99 ? 100.0 : 0.001; });
  EXPECT_LT(degreesBetween(brightest(table, sim::BitVolume({9, 9, 9}), {4, 4, 4}), sun), 3.0);
}

TEST(Brightest, IsNowhereWhereNothingIsOpen) {
  EXPECT_EQ(brightest(uniformTable(), closedBox({9, 9, 9}), {4, 4, 4}), Vec3(0.0));
}

// Whatever is open, no direction receives more than the one that is found. Directions are tried at random,
// and the table's own sum is done anew here.
TEST(Brightest, NoOtherDirectionReceivesMore) {
  const auto table = sim::makeSkyTable(9, 36, sim::backgroundOf(Weighting::cie_overcast));
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int world = 0; world < 40; ++world) {
    // A few round windows.
    std::vector<std::uint64_t> open((table.rays.size() + 63) / 64);
    for (int window = 0; window <= world % 4; ++window) {
      const Vec3 middle = glm::normalize(Vec3(normal(random), std::abs(normal(random)), normal(random)));
      for (std::size_t ray = 0; ray < table.rays.size(); ++ray) {
        if (degreesBetween(Vec3(table.rays[ray].v), middle) < 20.0 + 3.0 * world / 4.0)
          open[ray / 64] |= std::uint64_t{1} << (ray % 64);
      }
    }
    const auto received = [&](Vec3 facing) {
      double sum = 0.0;
      for (const auto& cell : table.cells) {
        if ((open[cell.ray / 64] >> (cell.ray % 64)) & 1u)
          sum += cell.light * std::max(0.0, glm::dot(Vec3(cell.centre), facing));
      }
      return sum;
    };
    const Vec3 way = sim::SkyFilter(table).brightest(open);
    const double most = way == Vec3(0.0) ? 0.0 : received(way);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 other = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
      ASSERT_LE(received(other), 1.0005 * most + 1e-9) << world;
    }
  }
}

TEST(Brightest, ForManyPlacesIsWhatEachSees) {
  const auto bits = tests::randomBits({70, 12, 20}, 0.02, 3);
  sim::BitVolume wanted(bits.size());
  for (const Voxel v : {Voxel(3, 1, 4), Voxel(64, 0, 19), Voxel(69, 11, 0), Voxel(30, 5, 10)}) wanted.set(v);
  const auto where = std::make_shared<const sim::VoxelSet>(wanted);
  const auto table = sim::makeSkyTable(9, 36, sim::backgroundOf(Weighting::uniform));
  const auto ways = brightest(table, sim::sweepOpen(bits, table.rays, where));
  const auto voxels = where->voxels();
  ASSERT_EQ(ways.size(), voxels.size());
  for (std::size_t i = 0; i < ways.size(); ++i)
    EXPECT_EQ(ways[i], sim::Vec3f(brightest(table, bits, voxels[i])));
}

// A table whose lobes are kept, and one that is too large for that; where the sum is done plainly here.
TEST(Brightest, TheFilteredTableIsASumInTheOrderOfTheCells) {
  for (const auto& table : {sim::makeSkyTable(9, 36, sim::backgroundOf(Weighting::cie_overcast)),
                            sim::makeSkyTable(20, 60, sim::backgroundOf(Weighting::uniform))}) {
    std::mt19937_64 random(5);
    std::vector<std::uint64_t> open((table.rays.size() + 63) / 64);
    for (auto& word : open) word = random() | random();
    std::vector<float> expected(table.cells.size());
    for (const auto& from : table.cells) {
      if (((open[from.ray / 64] >> (from.ray % 64)) & 1u) == 0) continue;
      const sim::Vec3f light = from.light * from.centre;
      for (std::size_t i = 0; i < expected.size(); ++i)
        expected[i] += std::max(0.0f, glm::dot(table.cells[i].centre, light));
    }
    EXPECT_EQ(sim::SkyFilter(table).illumination(open), expected);
  }
}

TEST(Brightest, TheSensorFindsWhatEachPlaceSees) {
  const auto bits = tests::randomBits({70, 30, 44}, 0.003, 4);
  const auto table = sim::makeSkyTable(9, 36, sim::backgroundOf(Weighting::uniform));
  const sim::SkySensor sensor(bits, table);
  std::mt19937 random(6);
  std::vector<Voxel> places;
  for (int i = 0; i < 60; ++i)
    places.emplace_back(static_cast<int>(random() % 70), static_cast<int>(random() % 30),
                        static_cast<int>(random() % 44));
  sim::ClearAhead ahead;
  const sim::SkyInside sky(sensor, bits, ahead);
  for (const Voxel place : places) EXPECT_EQ(sky.brightest(place), brightest(table, bits, place));
}

/// Angle between Greene's table and the fast estimate.
double disagreement(const sim::BitVolume& world, Voxel p) {
  return degreesBetween(brightest(uniformTable(), world, p), sim::lookOut(world, p, uniformSky()).toward);
}

TEST(FirstMoment, AgreesWithTheTableWhereLightComesFromOneSide) {
  EXPECT_LT(disagreement(sim::BitVolume({9, 9, 9}), {4, 4, 4}), 1.0);

  sim::BitVolume wall({70, 70, 70});
  tests::addBox(wall, {0, 0, 0}, {4, 69, 69});
  EXPECT_LT(disagreement(wall, {5, 0, 35}), 2.0);
  EXPECT_LT(disagreement(wall, {25, 0, 35}), 4.0);

  sim::BitVolume corner = wall;
  tests::addBox(corner, {0, 0, 0}, {69, 69, 4});
  EXPECT_LT(disagreement(corner, {5, 0, 5}), 2.0);

  sim::BitVolume slot = closedBox({41, 41, 41});
  cut(slot, {40, 24, 10}, {40, 32, 30});
  EXPECT_LT(disagreement(slot, {20, 12, 20}), 4.0);

  sim::BitVolume overhang({70, 70, 70});  // a roof from the wall outwards
  tests::addBox(overhang, {0, 0, 0}, {4, 69, 69});
  tests::addBox(overhang, {0, 30, 0}, {30, 31, 69});
  EXPECT_LT(disagreement(overhang, {10, 5, 35}), 4.0);
}

// Where the estimate fails: a room with windows in opposite walls. The moment points between them, at the
// ceiling; the table picks the larger window.
TEST(FirstMoment, PointsBetweenOppositeWindowsWhereTheTablePicksOne) {
  sim::BitVolume room = closedBox({41, 21, 41});
  cut(room, {0, 8, 14}, {0, 16, 26});
  cut(room, {40, 8, 14}, {40, 16, 27});
  const Voxel middle(20, 5, 20);
  const Vec3 moment = sim::lookOut(room, middle, uniformSky()).toward;
  const Vec3 way = brightest(uniformTable(), room, middle);
  const Vec3 window = glm::normalize(Vec3(20, 7, 0.5));
  EXPECT_LT(degreesBetween(way, window), 4.0);
  EXPECT_GT(degreesBetween(moment, window), 45.0);
  const Voxel between = sim::nearestLatticeVector(glm::normalize(moment), sim::kLongestComponent);
  EXPECT_FALSE(sim::reachesEdge(room, middle, {between, sim::crossedVoxels(between), 1}));
}

}  // namespace
}  // namespace espalier
