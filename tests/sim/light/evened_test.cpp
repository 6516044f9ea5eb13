#include "sim/light/evened.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/base/parallel.h"

namespace espalier::sim {
namespace {

/// A floor of 40 x 30 voxels without those that are left out.
struct Floor {
  std::vector<TiledVoxel> surfaces;
  VoxelSet where;

  template <class Keep>
  explicit Floor(Keep keep) : where(bitsOf(keep)) {
    for (const Voxel v : where.voxels()) {
      TiledVoxel tiled;
      tiled.voxel = v;
      tiled.surface.normal = Vec3f(0, 1, 0);
      surfaces.push_back(tiled);
    }
  }
  template <class Value>
  std::vector<float> valued(Value value) const {
    std::vector<float> values;
    for (const TiledVoxel& t : surfaces) values.push_back(value(t.voxel));
    return values;
  }
  std::vector<float> evenedOut(const std::vector<float>& values, double error) const {
    return evened(values, surfaces, where, error);
  }

 private:
  template <class Keep>
  static BitVolume bitsOf(Keep keep) {
    BitVolume bits({40, 3, 30});
    for (int z = 0; z < 30; ++z) {
      for (int x = 0; x < 40; ++x) {
        if (keep(x, z)) bits.set({x, 1, z});
      }
    }
    return bits;
  }
};

bool everywhere(int, int) {
  return true;
}

TEST(Evened, KeepsWhatRisesEvenlyUpToTheEdges) {
  const Floor floor(everywhere);
  const auto ramp = floor.valued([](Voxel v) { return static_cast<float>(3 * v.x + 5 * v.z) / 1024.0f; });
  EXPECT_EQ(floor.evenedOut(ramp, 1.0), ramp);
}

TEST(Evened, LeavesAThirdOfTheNoiseAndTheMean) {
  const Floor floor(everywhere);
  std::mt19937 rng(1);
  std::normal_distribution<float> noise(0.5f, 0.004f);
  const auto noisy = floor.valued([&](Voxel) { return noise(rng); });
  const auto even = floor.evenedOut(noisy, 0.004);
  double before = 0.0, after = 0.0, mean = 0.0;
  int inside = 0;
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    const Voxel v = floor.surfaces[i].voxel;
    if (v.x < 3 || v.z < 3 || v.x > 36 || v.z > 26) continue;
    ++inside;
    mean += static_cast<double>(even[i]);
    before += std::pow(static_cast<double>(noisy[i]) - 0.5, 2);
    after += std::pow(static_cast<double>(even[i]) - 0.5, 2);
  }
  EXPECT_LT(std::sqrt(after), 0.33 * std::sqrt(before));
  EXPECT_NEAR(mean / inside, 0.5, 5e-4);
}

TEST(Evened, LeavesEdgesOfShadows) {
  const Floor floor(everywhere);
  const auto edge = floor.valued([](Voxel v) { return v.x < 20 ? 0.25f : 0.75f; });
  EXPECT_EQ(floor.evenedOut(edge, 0.005), edge);
  EXPECT_NE(floor.evenedOut(edge, 0.2), edge);  // so the bound is what keeps it
}

/// A thin fence has light of its own on each side.
TEST(Evened, DoesNotLookThroughAFence) {
  const Floor fenced([](int x, int) { return x != 20; });
  const auto sides = fenced.valued([](Voxel v) { return v.x < 20 ? 0.25f : 0.75f; });
  EXPECT_EQ(fenced.evenedOut(sides, 1.0), sides);
}

TEST(Evened, OfSurfacesThatFaceElsewhereNoneCounts) {
  Floor floor(everywhere);
  const auto values = floor.valued([](Voxel v) { return v.x == 20 ? 1.0f : 0.0f; });
  for (TiledVoxel& t : floor.surfaces) {
    if (t.voxel.x == 20) t.surface.normal = Vec3f(1, 0, 0);
  }
  EXPECT_EQ(floor.evenedOut(values, 1.0), values);
}

TEST(Evened, IsTheSameOnAnyNumberOfThreads) {
  const Floor floor(everywhere);
  std::mt19937 rng(5);
  const auto values = floor.valued([&](Voxel) { return static_cast<float>(rng() % 1000) / 1000.0f; });
  std::vector<std::vector<float>> answers;
  for (const int threads : {1, 2, 5}) {
    onThreads(threads, [&] { answers.push_back(floor.evenedOut(values, 0.1)); });
  }
  EXPECT_EQ(answers[0], answers[1]);
  EXPECT_EQ(answers[0], answers[2]);
  // And by pairs that are kept.
  EXPECT_EQ(SurfacePairs(floor.surfaces, floor.where).evened(values, 0.1), answers[0]);
}

}  // namespace
}  // namespace espalier::sim
