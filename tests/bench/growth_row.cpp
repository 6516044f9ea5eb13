#include <fmt/format.h>

#include <chrono>
#include <mutex>
#include <utility>

#include "sim/grow/grow.h"
#include "sim/sweep/sweep.h"
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

void benchGrowth(const scenes::Scene& scene, scenes::Site& site, Report& report) {
  constexpr const char* kRow = "4 growth";
  constexpr int kEvery = 5;  // iterations; the sweeps would take longer than all else
  sim::GrowthSettings settings = scenes::growthSettings(scene, site);
  std::vector<std::unique_ptr<Listening>> listeners;
  const scenes::Plantings prepared = scenes::makePlantings(scene, site);
  auto plantings = prepared.seeds;
  for (auto& planting : plantings) {
    listeners.push_back(std::make_unique<Listening>(*planting.rule));
    planting.rule = listeners.back().get();
  }
  const sim::LightSensor sensor(site.world.opaque(), settings.sky, settings.sun);
  double growing = 0.0, asking = 0.0, casting = 0.0, sweeping = 0.0, everywhere = 0.0;
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
      const sim::BitVolume& opaque = site.world.opaque();
      const auto medians =
          medianSeconds({[&] { sensor.at(opaque, places); }, [&] { sensor.byRays(opaque, places); },
                         [&] { sensor.bySweep(opaque, places); },
                         [&] {
                           sim::sweepExposure(opaque, settings.sky);
                           sim::sweepExposure(opaque, settings.sun);
                         }});
      asking += medians[0];
      casting += medians[1];
      sweeping += medians[2];
      everywhere += medians[3];
      buds += places.size();
      ++iterations;
    }
    began = Clock::now();
  };
  const sim::Growth growth = sim::grow(site.world, plantings, settings);
  const std::uint64_t state = sim::stateHash(site.world, growth.plants);
  const auto mean = [&](double sum) { return sum / static_cast<double>(iterations); };
  report.title(fmt::format(
      "4. Light while {} grows: sky of {} and sun of {} directions; means over every {}th of {} iterations",
      scene.name, settings.sky.size(), settings.sun.size(), kEvery, growth.iterations));
  report.add({kRow, "buds that ask", mean(static_cast<double>(buds)), "", state});
  report.add({kRow, "an iteration, with the light that its buds ask for", mean(growing) * 1e3, "ms", state});
  report.add({kRow, "their light, as growth asks for it", mean(asking) * 1e3, "ms", state});
  report.add({kRow, "  by rays", mean(casting) * 1e3, "ms", state});
  report.add({kRow, "  by a sweep", mean(sweeping) * 1e3, "ms", state});
  report.add({kRow, "every voxel's light, by sweeps", mean(everywhere) * 1e3, "ms", state});
  report.add({kRow, "the buds' light over the rest of the iteration", asking / (growing - asking), "times",
              state, Target{1.0, false}});
  report.add({kRow, "every voxel's light over the rest of the iteration", everywhere / (growing - asking),
              "times", state});
}

}  // namespace espalier::bench
