#include "sim/sweep.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "sim/parallel.h"
#include "sim/sense/exposure.h"
#include "sim/sky.h"
#include "tests/support/bit_worlds.h"

namespace espalier {
namespace {

using sim::Voxel;

sim::DirectionSet randomDirections(int count, int longest, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> side(-longest, longest), up(1, longest);
  sim::DirectionSet set;
  while (static_cast<int>(set.size()) < count) {
    const Voxel v(side(random), up(random), side(random));
    if (std::gcd(std::gcd(v.x, v.y), v.z) != 1) continue;
    set.push_back({v, sim::crossedVoxels(v), static_cast<std::uint16_t>(1 + random() % 900)});
  }
  set.push_back({{0, 1, 0}, sim::crossedVoxels({0, 1, 0}), 7});
  return set;
}

void expectSameAsRays(const sim::BitVolume& bits, const sim::DirectionSet& set) {
  const sim::ExposureField field = sim::sweepExposure(bits, set);
  const sim::Lookout lookout(bits, set);
  const Voxel size = bits.size();
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        const Voxel p(x, y, z);
        const sim::Outlook plain = sim::lookOut(bits, p, set);
        ASSERT_EQ(field.sums[field.index(p)], plain.sum) << x << ' ' << y << ' ' << z;
        const sim::Outlook prepared = lookout.from(bits, p);
        ASSERT_EQ(prepared.sum, plain.sum) << x << ' ' << y << ' ' << z;
        ASSERT_EQ(prepared.toward, plain.toward);
      }
    }
  }
}

TEST(Sweep, EqualsCastingEachRayBitForBit) {
  unsigned seed = 1;
  for (const Voxel size : {Voxel(1, 1, 1), Voxel(7, 9, 5), Voxel(64, 6, 3), Voxel(65, 12, 9),
                           Voxel(63, 20, 1), Voxel(130, 17, 11), Voxel(1, 30, 20), Voxel(200, 5, 4)}) {
    for (const double chance : {0.0, 0.01, 0.2}) {
      ++seed;
      expectSameAsRays(tests::randomBits(size, chance, seed), randomDirections(20, 7, seed));
    }
  }
}

TEST(Sweep, EqualsRaysForTheLongestDirections) {
  sim::DirectionSet set;
  for (const Voxel v : {Voxel(63, 1, 0), Voxel(-63, 1, 0), Voxel(0, 1, 63), Voxel(0, 1, -63),
                        Voxel(63, 63, 62), Voxel(-62, 63, -61), Voxel(-63, 2, 63), Voxel(1, 63, -1)}) {
    set.push_back({v, sim::crossedVoxels(v), 100});
  }
  expectSameAsRays(tests::randomBits({90, 40, 70}, 0.002, 5), set);
}

TEST(Sweep, DoesNotDependOnTheNumberOfThreads) {
  const auto bits = tests::randomBits({70, 33, 41}, 0.03, 9);
  const auto set = sim::makeSky({.directions = 100}).directions;
  std::vector<std::vector<std::uint16_t>> answers;
  for (const int threads : {1, 2, 5}) {
    sim::onThreads(threads, [&] { answers.push_back(sim::sweepExposure(bits, set).sums); });
  }
  EXPECT_EQ(answers[0], answers[1]);
  EXPECT_EQ(answers[0], answers[2]);
}

TEST(Sweep, SeesNothingWithoutDirections) {
  const auto field = sim::sweepExposure(sim::BitVolume({3, 3, 3}), {});
  EXPECT_EQ(field.at({1, 1, 1}), 0.0f);
}

}  // namespace
}  // namespace espalier
