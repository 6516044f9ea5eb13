#include <fmt/format.h>

#include "sim/parallel.h"
#include "sim/sense/exposure.h"
#include "sim/sweep.h"
#include "tests/bench/rows.h"

namespace espalier::bench {
namespace {

constexpr const char* kRow = "2 every voxel";
constexpr std::size_t kPlaces = 20'000;

/// Voxels all over the world, in a scattered order.
std::vector<sim::Voxel> scattered(sim::Voxel size) {
  const auto nx = static_cast<std::size_t>(size.x), ny = static_cast<std::size_t>(size.y),
             nz = static_cast<std::size_t>(size.z);
  std::vector<sim::Voxel> places;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const std::size_t n = i * 2'654'435'761u % (nx * ny * nz);
    places.emplace_back(n % nx, n / nx % ny, n / (nx * ny));
  }
  return places;
}

}  // namespace

void benchEveryVoxel(const scenes::Job& job, Report& report) {
  const sim::BitVolume& occupied = job.world.opaque();
  const sim::Voxel size = occupied.size();
  const auto sky = skyOf(128);
  const double rays = static_cast<double>(size.x) * size.y * size.z * static_cast<double>(sky.size());
  report.title(fmt::format("2. Sky exposure of every voxel: {}, {} x {} x {} voxels, {} directions",
                           job.scene.name, size.x, size.y, size.z, sky.size()));

  sim::ExposureField field;
  const double sweep = medianSeconds([&] { field = sim::sweepExposure(occupied, sky); });
  const std::uint64_t state = hashOf(field.sums);
  report.add({kRow, "sweep", sweep * 1e3, "ms", state});
  report.add({kRow, "sweep", rays / sweep / 1e6, "Mray/s", state});

  const auto places = scattered(size);
  std::vector<std::uint16_t> sums(places.size());
  const double sample_rays = static_cast<double>(places.size()) * static_cast<double>(sky.size());
  const auto cast = [&](const std::string& what, const std::function<std::uint16_t(sim::Voxel)>& look) {
    const double seconds = medianSeconds([&] {
      sim::parallelFor(places.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) sums[i] = look(places[i]);
      });
    });
    std::size_t other = 0;
    for (std::size_t i = 0; i < places.size(); ++i) other += sums[i] != field.sums[field.index(places[i])];
    const double rate = sample_rays / seconds;
    report.add({kRow, what, rate / 1e6, "Mray/s", hashOf(sums)});
    report.note(fmt::format("{} of {} places differ from the sweep", other, places.size()));
    return rays / sweep / rate;
  };
  const double plain = cast("the plain traversal, ray by ray",
                            [&](sim::Voxel p) { return sim::lookOut(occupied, p, sky).sum; });
  const sim::Lookout lookout(occupied, sky);
  const double prepared =
      cast("the prepared traversal of growth", [&](sim::Voxel p) { return lookout.from(occupied, p).sum; });
  report.add(
      {kRow, "the sweep's rays a second over the plain traversal's", plain, "times", state, Target{3000.0}});
  report.add({kRow, "over the prepared traversal's", prepared, "times", state});
}

}  // namespace espalier::bench
