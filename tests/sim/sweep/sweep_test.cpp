#include "sim/sweep/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>

#include "sim/base/parallel.h"
#include "sim/light/exposure.h"
#include "sim/light/sky.h"
#include "sim/sweep/lanes.h"
#include "tests/support/bit_worlds.h"
#include "tests/support/levels.h"

namespace espalier {
namespace {

using sim::Voxel;

/// Directions in every octant, the six axes and the level ones among them.
sim::DirectionSet randomDirections(int count, int longest, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> side(-longest, longest);
  std::vector<Voxel> vectors{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  while (static_cast<int>(vectors.size()) < count) {
    const Voxel v(side(random), vectors.size() % 4 == 0 ? 0 : side(random), side(random));
    if (std::gcd(std::gcd(v.x, v.y), v.z) == 1) vectors.push_back(v);
  }
  std::shuffle(vectors.begin(), vectors.end(), random);
  sim::DirectionSet set;
  for (const Voxel v : vectors)
    set.push_back({v, sim::crossedVoxels(v), static_cast<std::uint16_t>(random() % 900)});
  return set;
}

std::shared_ptr<const sim::VoxelSet> somewhere(Voxel size, double chance, unsigned seed) {
  return std::make_shared<const sim::VoxelSet>(tests::randomBits(size, chance, seed));
}

/// What rays that are cast one by one say of a volume: of each voxel, and of those somewhere in it.
struct Rays {
  const sim::BitVolume bits;
  const sim::DirectionSet set;
  const std::shared_ptr<const sim::VoxelSet> where;
  std::vector<sim::Outlook> outlooks;
  std::vector<bool> open;  ///< of each place somewhere, each direction
};

Rays raysOf(const sim::BitVolume& bits, const sim::DirectionSet& set) {
  Rays rays{bits, set, somewhere(bits.size(), 0.3, static_cast<unsigned>(set.size())), {}, {}};
  const Voxel size = bits.size();
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        const Voxel p(x, y, z);
        rays.outlooks.push_back(sim::lookOut(bits, p, set));
        if (!rays.where->has(p)) continue;
        for (const sim::LatticeDirection& direction : set)
          rays.open.push_back(sim::reachesEdge(bits, p, direction));
      }
    }
  }
  return rays;
}

void expectSameAs(const Rays& rays) {
  const auto& [bits, set, where, outlooks, open] = rays;
  const sim::ExposureField field = sim::sweepExposure(bits, set);
  const sim::ExposureField there = sim::sweepExposure(bits, set, where);
  const sim::OpenTable table = sim::sweepOpen(bits, set, where);
  const sim::Lookout lookout(bits, set);
  ASSERT_EQ(there.values.size(), where->count());
  const Voxel size = bits.size();
  std::size_t place = 0, voxel = 0;
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x, ++voxel) {
        const Voxel p(x, y, z);
        const sim::Outlook &plain = outlooks[voxel], prepared = lookout.from(bits, p);
        ASSERT_EQ(field.values[field.index(p)], plain.sum) << x << ' ' << y << ' ' << z;
        ASSERT_EQ(prepared.sum, plain.sum) << x << ' ' << y << ' ' << z;
        ASSERT_EQ(prepared.toward, plain.toward);
        if (!where->has(p)) continue;
        ASSERT_EQ(where->number(p), place);
        ASSERT_EQ(there.values[place], plain.sum) << x << ' ' << y << ' ' << z;
        for (std::size_t d = 0; d < set.size(); ++d) {
          ASSERT_EQ(table.open(place, d), open[place * set.size() + d])
              << x << ' ' << y << ' ' << z << " along " << set[d].v.x << ' ' << set[d].v.y << ' '
              << set[d].v.z;
        }
        ++place;
      }
    }
  }
  EXPECT_EQ(place, where->count());
}

TEST(Sweep, EqualsCastingEachRayBitForBit) {
  std::vector<Rays> all;
  unsigned seed = 1;
  for (const Voxel size : {Voxel(1, 1, 1), Voxel(7, 9, 5), Voxel(64, 6, 3), Voxel(65, 12, 9),
                           Voxel(63, 20, 1), Voxel(130, 7, 11), Voxel(1, 30, 20), Voxel(300, 3, 9)}) {
    for (const double chance : {0.0, 0.01, 0.2}) {
      ++seed;
      all.push_back(raysOf(tests::randomBits(size, chance, seed), randomDirections(30, 7, seed)));
    }
  }
  tests::onEveryLevel([&] {
    for (const Rays& rays : all) expectSameAs(rays);
  });
}

TEST(Sweep, EqualsRaysWhereSlicesAreAlike) {
  sim::BitVolume town({150, 30, 40});
  tests::addBox(town, {0, 0, 0}, {149, 1, 39});
  tests::addBox(town, {20, 2, 5}, {24, 17, 30});  // walls, which are the same in many slices
  tests::addBox(town, {20, 2, 20}, {140, 25, 23});
  tests::addBox(town, {90, 9, 0}, {99, 9, 39});  // a floor that juts out
  tests::addBox(town, {63, 2, 35}, {64, 28, 36});
  const Rays rays = raysOf(town, randomDirections(40, 6, 8));
  tests::onEveryLevel([&] { expectSameAs(rays); });
}

TEST(Sweep, EqualsRaysForMoreDirectionsThanAWordHolds) {
  expectSameAs(raysOf(tests::randomBits({70, 9, 19}, 0.02, 3), randomDirections(150, 9, 4)));
}

TEST(Sweep, EqualsRaysForTheLongestDirections) {
  sim::DirectionSet set;
  for (const Voxel v :
       {Voxel(63, 1, 0), Voxel(-63, 1, 0), Voxel(0, 1, 63), Voxel(0, -1, -63), Voxel(63, 63, 62),
        Voxel(-62, 63, -61), Voxel(-63, 2, 63), Voxel(1, -63, -1), Voxel(63, 0, -62)}) {
    set.push_back({v, sim::crossedVoxels(v), 100});
  }
  expectSameAs(raysOf(tests::randomBits({90, 40, 70}, 0.002, 5), set));
}

TEST(Sweep, AddsUpToTheLargestSum) {
  sim::DirectionSet set = randomDirections(40, 5, 6);
  for (auto& direction : set) direction.weight = 1638;  // 40 times that and 15 are 65,535
  set.front().weight = 1653;
  const auto field = sim::sweepExposure(sim::BitVolume({5, 5, 5}), set);
  EXPECT_EQ(field.at({2, 2, 2}), 1.0f);
  sim::BitVolume full({5, 5, 5});
  tests::addBox(full, {0, 0, 0}, {4, 4, 4});
  EXPECT_EQ(sim::sweepExposure(full, set).at({2, 2, 2}), 0.0f);
}

TEST(Sweep, DoesNotDependOnTheNumberOfThreads) {
  auto bits = tests::randomBits({70, 33, 41}, 0.03, 9);
  const auto set = sim::makeSky({.directions = 100}).directions;
  std::vector<std::vector<std::uint16_t>> answers;
  for (const int threads : {1, 2, 5}) {
    sim::onThreads(threads, [&] { answers.push_back(sim::sweepExposure(bits, set).values); });
  }
  EXPECT_EQ(answers[0], answers[1]);
  EXPECT_EQ(answers[0], answers[2]);
  const Voxel free = [&] {  // one voxel more is another answer
    Voxel v(35, 20, 20);
    while (bits.at(v)) ++v.x;
    return v;
  }();
  bits.set(free);
  EXPECT_NE(answers[0], sim::sweepExposure(bits, set).values);
}

TEST(Sweep, SeesNothingWithoutDirections) {
  const auto field = sim::sweepExposure(sim::BitVolume({3, 3, 3}), {});
  EXPECT_EQ(field.at({1, 1, 1}), 0.0f);
}

}  // namespace
}  // namespace espalier
