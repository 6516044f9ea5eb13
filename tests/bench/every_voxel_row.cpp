#include <fmt/format.h>

#include "sim/base/parallel.h"
#include "sim/light/exposure.h"
#include "sim/sweep/lanes.h"
#include "sim/sweep/sweep.h"
#include "tests/bench/rows.h"

namespace espalier::bench {
namespace {

constexpr const char* kEveryVoxel = "2 every voxel";
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

/// The sweep with each of the vector instructions that this processor has.
void benchLevels(const sim::BitVolume& occupied, const sim::DirectionSet& sky, double rays, Report& report) {
  const std::string best = sim::lanes::level();
  for (const std::string& level : sim::lanes::levels()) {
    sim::lanes::useLevel(level);
    sim::ExposureField field;
    const double seconds = medianSeconds([&] { field = sim::sweepExposure(occupied, sky); });
    report.add({kEveryVoxel, "the sweep's rays by " + level, rays / seconds / 1e6, "Mray/s", hashOf(field.values)});
  }
  sim::lanes::useLevel(best);
}

}  // namespace

void benchEveryVoxel(const scenes::Scene& scene, const scenes::Site& site, Report& report) {
  const sim::BitVolume& occupied = site.world.opaque();
  const sim::Voxel size = occupied.size();
  const auto sky = skyOf(128);
  const double rays = static_cast<double>(size.x) * size.y * size.z * static_cast<double>(sky.size());
  report.title(fmt::format("2. Sky exposure of every voxel: {}, {} x {} x {} voxels, {} directions",
                           scene.name, size.x, size.y, size.z, sky.size()));

  const auto places = scattered(size);
  const double sample_rays = static_cast<double>(places.size()) * static_cast<double>(sky.size());
  const sim::Lookout lookout(occupied, sky);
  sim::ExposureField field;
  std::vector<std::uint16_t> plain(places.size()), prepared(places.size());
  const auto cast = [&](std::vector<std::uint16_t>& sums, const auto& look) {
    sim::parallelFor(places.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) sums[i] = look(places[i]).sum;
    });
  };
  const std::vector<double> seconds =
      medianSeconds({[&] { field = sim::sweepExposure(occupied, sky); },
                     [&] { cast(plain, [&](sim::Voxel p) { return sim::lookOut(occupied, p, sky); }); },
                     [&] { cast(prepared, [&](sim::Voxel p) { return lookout.from(occupied, p); }); }});
  const std::uint64_t state = hashOf(field.values);
  const double rate = rays / seconds[0];
  report.add({kEveryVoxel, "the sweep", seconds[0] * 1e3, "ms", state});
  report.add({kEveryVoxel, "  rays", rate / 1e6, "Mray/s", state});
  const auto compare = [&](const std::string& what, double time, const std::vector<std::uint16_t>& sums) {
    std::size_t other = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      other += sums[i] != field.values[field.index(places[i])] ? 1u : 0u;
    report.add({kEveryVoxel, what, sample_rays / time / 1e6, "Mray/s", hashOf(sums)});
    report.note(fmt::format("  {} of {} places differ from the sweep", other, places.size()));
  };
  compare("the plain traversal, ray by ray", seconds[1], plain);
  compare("the prepared traversal of growth, ray by ray", seconds[2], prepared);
  report.add({kEveryVoxel, "the sweep's rays a second over the plain traversal's", rate * seconds[1] / sample_rays,
              "times", state, Target{3000.0}});
  report.add({kEveryVoxel, "over the prepared traversal's", rate * seconds[2] / sample_rays, "times", state});
  benchLevels(occupied, sky, rays, report);
}

}  // namespace espalier::bench
