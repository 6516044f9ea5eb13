#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sim/sweep/sweep.h"
#include "tests/bench/machine.h"
#include "tests/bench/rows.h"
#include "tests/bench/town.h"

namespace espalier::bench {
namespace {

constexpr const char* kLargeWorlds = "3 large worlds";

/// Bits that one direction's sweep and its counting read and write for each voxel: an occupied bit for each
/// voxel crossed in a period, the blocked bit of the next period, its own blocked bit written, and that read
/// again to be counted.
double bitsMoved(const sim::DirectionSet& directions) {
  double crossed = 0.0;
  for (const auto& direction : directions) crossed += static_cast<double>(direction.crossed.size());
  return crossed / static_cast<double>(directions.size()) + 3.0;
}

}  // namespace

void benchLargeWorlds(double most_voxels, Report& report) {
  const auto sky = skyOf(64);
  const auto directions = static_cast<double>(sky.size());
  const double moved_bits = bitsMoved(sky);
  const double copy = copyBandwidth();
  report.title(
      fmt::format("3. Sky exposure of every voxel of large worlds: towns, {} directions", sky.size()));
  report.note(fmt::format(
      "moved: for each voxel and direction {:.1f} bits ({:.1f} occupied bits and one blocked bit read, one",
      moved_bits, moved_bits - 3.0));
  report.note("  written, one read again to be counted); for each voxel its sum written, two bytes");
  report.note("memory, at least: each occupied bit read once, each sum written once");
  report.add({kLargeWorlds, "copying: bytes read and written", copy / 1e9, "GB/s", 0});

  constexpr std::array<sim::Voxel, 5> kSizes = {sim::Voxel(256, 80, 256), sim::Voxel(512, 160, 512),
                                                sim::Voxel(1024, 280, 1024), sim::Voxel(1024, 1024, 1024),
                                                sim::Voxel(2048, 1024, 2048)};
  double cheapest = 0.0, dearest = 0.0, smallest = 0.0, largest = 0.0, moved = 0.0, memory = 0.0;
  std::uint64_t state = 0;
  for (const sim::Voxel size : kSizes) {
    const double voxels = static_cast<double>(size.x) * size.y * size.z;
    if (voxels > most_voxels) continue;
    const sim::BitVolume world = town(size);
    sim::ExposureField field;
    const double seconds = medianSeconds([&] {
      field = {};  // there may not be room for two
      field = sim::sweepExposure(world, sky);
    });
    state = hashOf(field.values);
    const double picoseconds = seconds / voxels / directions * 1e12;
    moved = voxels * (directions * moved_bits / 8.0 + 2.0) / seconds;
    memory = voxels * (1.0 / 8.0 + 2.0) / seconds;
    report.add({kLargeWorlds, fmt::format("{} x {} x {}: a voxel and direction", size.x, size.y, size.z), picoseconds,
                "ps", state});
    report.add({kLargeWorlds, "  moved", moved / 1e9, "GB/s", state});
    report.add({kLargeWorlds, "  memory, at least", memory / 1e9, "GB/s", state});
    cheapest = cheapest == 0.0 ? picoseconds : std::min(cheapest, picoseconds);
    dearest = std::max(dearest, picoseconds);
    if (smallest == 0.0) smallest = picoseconds;
    largest = picoseconds;
  }
  if (cheapest == 0.0) return;
  report.add({kLargeWorlds, "the dearest voxel and direction over the cheapest", dearest / cheapest, "times", state,
              Target{1.5, false}});
  report.add({kLargeWorlds, "the largest world: moved over copying", moved / copy, "times", state, Target{0.5}});
  report.add({kLargeWorlds, "the largest world: memory, at least, over copying", memory / copy, "times", state});
  report.add({kLargeWorlds, "a voxel and direction: the largest world over the smallest", largest / smallest, "times",
              state});
  report.note(largest < 1.25 * smallest
                  ? "No dearer than in the smallest world, which the caches hold: the processor is the bound."
                  : "Dearer than in the smallest world, which the caches hold: memory is the bound.");
}

}  // namespace espalier::bench
