#include <fmt/format.h>

#include <chrono>
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

/// Passes on to a process, and remembers where it was asked.
class Listening : public sim::Process {
 public:
  explicit Listening(std::shared_ptr<const sim::Process> process) : process_(std::move(process)) {}
  sim::Wants wants() const override { return process_->wants(); }
  sim::Plant seedling() const override { return process_->seedling(); }
  void begin(const sim::StandView& stand, sim::Columns& memory, sim::Commons& commons) const override {
    process_->begin(stand, memory, commons);
  }
  std::vector<sim::Site> due(const sim::StandView& stand, sim::Columns& memory,
                             sim::Commons& commons) const override {
    const auto sites = process_->due(stand, memory, commons);
    for (const sim::Site& site : sites) places_.push_back(sim::voxelAt(site.at_vx));
    return sites;
  }
  sim::Proposal propose(const sim::SiteView& view, const sim::Site& site,
                        const sim::RandomKey& key) const override {
    return process_->propose(view, site, key);
  }
  void settle(const sim::StandView& stand, std::span<const sim::Verdict> verdicts, sim::Columns& memory,
              sim::Commons& commons) const override {
    process_->settle(stand, verdicts, memory, commons);
  }
  std::size_t alive(const sim::Columns& memory, const sim::Commons& commons) const override {
    return process_->alive(memory, commons);
  }
  /// Since the last call.
  std::vector<sim::Voxel> takePlaces() const { return std::exchange(places_, {}); }

 private:
  std::shared_ptr<const sim::Process> process_;
  mutable std::vector<sim::Voxel> places_;  // due() is called serially
};

}  // namespace

void benchGrowth(const scenes::Scene& scene, scenes::Site& site, Report& report) {
  constexpr const char* kRow = "4 growth";
  constexpr int kEvery = 5;  // iterations; the sweeps would take longer than all else
  sim::GrowthSettings settings = scenes::growthSettings(scene, site, scenes::attractorsOf(scene, site));
  std::vector<std::shared_ptr<const Listening>> listeners;
  auto plantings = scenes::makePlantings(scene, site);
  for (auto& planting : plantings) {
    listeners.push_back(std::make_shared<Listening>(planting.process));
    planting.process = listeners.back();
  }
  const sim::LightSensor sensor(site.world.opaque(), settings.light);
  double growing = 0.0, asking = 0.0, casting = 0.0, opening = 0.0, sweeping = 0.0, everywhere = 0.0;
  std::size_t iterations = 0, buds = 0;
  auto began = Clock::now();
  settings.progress = [&](const sim::GrowthProgress& progress) {
    const double seconds = secondsSince(began);
    std::vector<sim::Voxel> places;
    for (const auto& listener : listeners) {
      const auto more = listener->takePlaces();
      places.insert(places.end(), more.begin(), more.end());
    }
    if (progress.iteration % kEvery == 0) {
      growing += seconds;
      const sim::BitVolume& opaque = site.world.opaque();
      const auto medians = medianSeconds({[&] {
                                            sim::ClearAhead anew;  // growth keeps it
                                            sensor.at(opaque, places, anew);
                                          },
                                          [&] { sensor.byRays(opaque, places); },
                                          [&] {
                                            sim::ClearAhead anew;
                                            sensor.byOpenRays(opaque, places, anew);
                                          },
                                          [&] { sensor.bySweep(opaque, places); },
                                          [&] {
                                            sim::sweepExposure(opaque, settings.light.sky);
                                            sim::sweepExposure(opaque, settings.light.sun);
                                          }});
      asking += medians[0];
      casting += medians[1];
      opening += medians[2];
      sweeping += medians[3];
      everywhere += medians[4];
      buds += places.size();
      ++iterations;
    }
    began = Clock::now();
  };
  const sim::Growth growth = sim::grow(site.world, plantings, settings);
  const std::uint64_t state = sim::stateHash(site.world, growth);
  const auto mean = [&](double sum) { return sum / static_cast<double>(iterations); };
  report.title(fmt::format(
      "4. Light while {} grows: sky of {} and sun of {} directions; means over every {}th of {} iterations",
      scene.name, settings.light.sky.size(), settings.light.sun.size(), kEvery, growth.iterations));
  report.add({kRow, "buds that ask", mean(static_cast<double>(buds)), "", state});
  report.add({kRow, "an iteration, with the light that its buds ask for", mean(growing) * 1e3, "ms", state});
  report.add({kRow, "their light, as growth asks for it", mean(asking) * 1e3, "ms", state});
  report.add({kRow, "  by rays", mean(casting) * 1e3, "ms", state});
  report.add({kRow, "  by open rays", mean(opening) * 1e3, "ms", state});
  report.add({kRow, "  by a sweep", mean(sweeping) * 1e3, "ms", state});
  report.add({kRow, "every voxel's light, by sweeps", mean(everywhere) * 1e3, "ms", state});
  report.add({kRow, "the buds' light over the rest of the iteration", asking / (growing - asking), "times",
              state, Target{1.0, false}});
  report.add({kRow, "every voxel's light over the rest of the iteration", everywhere / (growing - asking),
              "times", state});
}

}  // namespace espalier::bench
