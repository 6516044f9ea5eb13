#include "scenes/foretell/speed.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <random>

#include "sim/base/bits.h"
#include "sim/base/parallel.h"
#include "sim/world/ray.h"

namespace espalier::scenes {
namespace {

constexpr double kRaysASecond = 1.3e6;  // of one core of the machine of costs.cpp
constexpr std::size_t kBatch = 256;
constexpr std::chrono::milliseconds kWhile(15);

/// Voxels strewn in a cube, and rays through it.
class Rays {
 public:
  Rays() : occupied_(sim::Voxel(kSide)) {
    std::mt19937 random(1989);
    for (int i = 0; i < kSide * kSide; ++i) {
      const auto at = [&] { return static_cast<int>(random() % kSide); };
      occupied_.set({at(), at(), at()});
    }
    bricks_.emplace(occupied_);
  }
  /// How many of a batch meet something.
  std::size_t cast(std::uint32_t seed) const {
    std::minstd_rand random(seed + 1);
    const auto number = [&] { return static_cast<double>(random()) / std::minstd_rand::max(); };
    std::size_t met = 0;
    for (std::size_t i = 0; i < kBatch; ++i) {
      const sim::Vec3 from(number() * kSide, number() * kSide, number() * kSide);
      const sim::Vec3 way = glm::normalize(sim::Vec3(number() - 0.5, number() - 0.5, number() - 0.499));
      met += sim::firstHit(occupied_, *bricks_, from, way).has_value();
    }
    return met;
  }

 private:
  static constexpr int kSide = 64;
  sim::BitVolume occupied_;
  std::optional<sim::Bricks> bricks_;
};

/// Rays a second by so many tasks at once, each of which works for kWhile.
double raysASecond(const Rays& rays, std::size_t tasks) {
  using Clock = std::chrono::steady_clock;
  std::atomic<std::size_t> batches{0}, met{0};
  const auto began = Clock::now();
  sim::parallelForEach(tasks, [&](std::size_t task) {
    std::size_t done = 0, hits = 0;
    do {
      hits += rays.cast(static_cast<std::uint32_t>(1000 * task + ++done));
    } while (Clock::now() - began < kWhile);
    batches += done;
    met += hits;
  });
  const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
  return met > 0 ? static_cast<double>(batches * kBatch) / seconds : kRaysASecond;
}

}  // namespace

Speed measuredSpeed() {
  const Rays rays;
  const auto threads = static_cast<std::size_t>(sim::threadCount());
  const double alone = raysASecond(rays, 1) / kRaysASecond;
  return {alone, threads == 1 ? alone : raysASecond(rays, threads) / kRaysASecond};
}

}  // namespace espalier::scenes
