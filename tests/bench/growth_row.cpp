#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>

#include "sim/grow.h"
#include "sim/parallel.h"
#include "sim/sense/exposure.h"
#include "sim/sweep.h"
#include "tests/bench/rows.h"

namespace espalier::bench {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point began) {
  return std::chrono::duration<double>(Clock::now() - began).count();
}

/// Passes on to a rule, and remembers where it was asked.
class Listening : public sim::Rule {
 public:
  explicit Listening(const sim::Rule& rule) : rule_(rule) {}
  sim::Plant seedling() const override { return rule_.seedling(); }
  sim::Proposal propose(const sim::GrowthView& view, const sim::Bud& bud,
                        const sim::RandomKey& key) const override {
    const sim::Voxel voxel =
        sim::voxelAt(view.plant.skeleton.position_vx[static_cast<std::size_t>(bud.node)]);
    {
      const std::lock_guard lock(mutex_);
      places_.push_back(voxel);
    }
    return rule_.propose(view, bud, key);
  }
  /// Since the last call.
  std::vector<sim::Voxel> takePlaces() { return std::exchange(places_, {}); }

 private:
  const sim::Rule& rule_;
  mutable std::mutex mutex_;
  mutable std::vector<sim::Voxel> places_;
};

}  // namespace

void benchGrowth(scenes::Job& job, Report& report) {
  constexpr const char* kRow = "4 growth";
  constexpr int kEvery = 5;  // iterations; the sweeps would take longer than all else
  sim::GrowthSettings settings = scenes::growthSettings(job);
  std::vector<std::unique_ptr<Listening>> listeners;
  auto plantings = job.plantings;
  for (auto& planting : plantings) {
    listeners.push_back(std::make_unique<Listening>(*planting.rule));
    planting.rule = listeners.back().get();
  }
  const sim::Lookout sky(job.world.opaque(), settings.sky), sun(job.world.opaque(), settings.sun);
  double growing = 0.0, casting = 0.0, sweeping = 0.0;
  std::size_t iterations = 0, buds = 0;
  auto began = Clock::now();
  settings.progress = [&](const sim::GrowthProgress& progress) {
    const double seconds = secondsSince(began);
    std::vector<sim::Voxel> places;
    for (auto& listener : listeners) {
      const auto more = listener->takePlaces();
      places.insert(places.end(), more.begin(), more.end());
    }
    if (progress.iteration % kEvery == 0) {
      growing += seconds;
      casting += medianSeconds([&] {
        sim::parallelFor(places.size(), 4, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) {
            sky.from(job.world.opaque(), places[i]);
            sun.from(job.world.opaque(), places[i]);
          }
        });
      });
      sweeping += medianSeconds([&] {
        sim::sweepExposure(job.world.opaque(), settings.sky);
        sim::sweepExposure(job.world.opaque(), settings.sun);
      });
      buds += places.size();
      ++iterations;
    }
    began = Clock::now();
  };
  const sim::Growth growth = sim::grow(job.world, plantings, settings);
  const std::uint64_t state = sim::stateHash(job.world, growth.plants);
  const auto mean = [&](double sum) { return sum / static_cast<double>(iterations); };
  report.title(fmt::format(
      "4. Light while {} grows: sky of {} and sun of {} directions; means over every {}th of {} iterations",
      job.scene.name, settings.sky.size(), settings.sun.size(), kEvery, growth.iterations));
  report.add({kRow, "buds that ask", mean(static_cast<double>(buds)), "", state});
  report.add({kRow, "an iteration, with the light that its buds ask for", mean(growing) * 1e3, "ms", state});
  report.add({kRow, "their light, ray by ray", mean(casting) * 1e3, "ms", state});
  report.add({kRow, "light of every voxel, by the sweep", mean(sweeping) * 1e3, "ms", state});
  const double light = std::min(casting, sweeping);
  report.add({kRow, "the cheaper of both over the rest of the iteration", light / (growing - light), "times",
              state, Target{1.0, false}});
}

}  // namespace espalier::bench
