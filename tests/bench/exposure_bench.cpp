// What exposure costs: the sweep against casting the same rays one by one, in the same run.
#include <benchmark/benchmark.h>

#include "sim/sense/exposure.h"
#include "sim/sky.h"
#include "sim/sweep.h"
#include "tests/support/bit_worlds.h"

namespace espalier {
namespace {

/// A ground plane and a wall with a return, in a world of Greene's size.
sim::BitVolume yard() {
  sim::BitVolume bits({165, 150, 195});
  tests::addBox(bits, {0, 0, 0}, {164, 4, 194});
  tests::addBox(bits, {5, 5, 80}, {160, 100, 88});
  tests::addBox(bits, {5, 5, 80}, {12, 100, 180});
  return bits;
}

void sweepWholeWorld(benchmark::State& state) {
  const auto bits = yard();
  const auto sky = sim::makeSky({.directions = static_cast<int>(state.range(0))}).directions;
  for (auto _ : state) benchmark::DoNotOptimize(sim::sweepExposure(bits, sky).sums.data());
  const double rays = 165.0 * 150.0 * 195.0 * static_cast<double>(sky.size());
  state.counters["rays/s"] = benchmark::Counter(rays, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(sweepWholeWorld)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond)->UseRealTime();

void castRayByRay(benchmark::State& state) {
  const auto bits = yard();
  const auto sky = sim::makeSky({.directions = static_cast<int>(state.range(0))}).directions;
  int step = 0;
  for (auto _ : state) {
    step = (step + 7919) % (165 * 150 * 195);  // visits the whole world in a scattered order
    const sim::Voxel p(step % 165, step / 165 % 150, step / (165 * 150));
    benchmark::DoNotOptimize(sim::lookOut(bits, p, sky).sum);
  }
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(sky.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(castRayByRay)->Arg(128)->Arg(256);

}  // namespace
}  // namespace espalier
