#include <fmt/format.h>

#include <chrono>

#include "sim/grow.h"
#include "sim/sweep.h"
#include "tests/bench/rows.h"

namespace espalier::bench {

void benchGrowth(scenes::Job& job, Report& report) {
  using Clock = std::chrono::steady_clock;
  constexpr const char* kRow = "4 growth";
  constexpr int kEvery = 10;
  sim::GrowthSettings settings = scenes::growthSettings(job);
  std::vector<double> growing, sweeping;
  auto began = Clock::now();
  const auto lap = [&] {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - began).count();
    began = now;
    return seconds;
  };
  settings.progress = [&](const sim::GrowthProgress& progress) {
    growing.push_back(lap());
    if (progress.iteration % kEvery == 0) {
      sweeping.push_back(medianSeconds([&] {
        sim::sweepExposure(job.world.opaque(), settings.sky);
        sim::sweepExposure(job.world.opaque(), settings.sun);
      }));
    }
    began = Clock::now();
  };
  began = Clock::now();
  const sim::Growth growth = sim::grow(job.world, job.plantings, settings);
  const std::uint64_t state = sim::stateHash(job.world, growth.plants);
  double growth_s = 0.0, sweep_s = 0.0;
  for (const double s : growing) growth_s += s;
  for (const double s : sweeping) sweep_s += s;
  growth_s /= static_cast<double>(growing.size());
  sweep_s /= static_cast<double>(sweeping.size());
  report.title(fmt::format("4. Light while {} grows: {} iterations, sky of {} and sun of {} directions",
                           job.scene.name, growth.iterations, settings.sky.size(), settings.sun.size()));
  report.add({kRow, "an iteration's growth, with the light that it asks for", growth_s * 1e3, "ms", state});
  report.add({kRow, "sweeping sky and sun for every voxel", sweep_s * 1e3, "ms", state});
  report.add({kRow, "the whole world's light over an iteration", sweep_s / growth_s, "times", state,
              Target{1.0, false}});
}

}  // namespace espalier::bench
